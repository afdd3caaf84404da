#include "exact/order_graph.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace exact {
namespace {

// Successors of node n: targets[first[n]] .. targets[first[n + 1]].
struct Successors {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> targets;

  Successors(std::uint32_t node_count, std::span<const Edge> edges)
      : first(std::size_t{node_count} + 1), targets(edges.size()) {
    for (const auto& [from, to] : edges) ++first[from + 1];
    for (std::size_t n = 0; n < node_count; ++n) first[n + 1] += first[n];
    auto next = first;
    for (const auto& [from, to] : edges) targets[next[from]++] = to;
  }
};

constexpr std::uint32_t unvisited = 0;

struct Search {
  const Successors& graph;
  std::vector<std::uint32_t> number, low;  // order of discovery from 1; the lowest number reachable
  std::vector<bool> on_stack;
  std::vector<std::uint32_t> stack;
  std::vector<std::pair<std::uint32_t, std::size_t>> path;  // node, its next successor
  std::vector<std::vector<std::uint32_t>> found;
  std::uint32_t discovered = 0;

  Search(const Successors& successors, std::size_t count)
      : graph(successors), number(count, unvisited), low(count), on_stack(count) {}

  void enter(std::uint32_t node) {
    number[node] = low[node] = ++discovered;
    stack.push_back(node);
    on_stack[node] = true;
    path.emplace_back(node, graph.first[node]);
  }

  void leave(std::uint32_t node) {
    path.pop_back();
    if (!path.empty()) low[path.back().first] = std::min(low[path.back().first], low[node]);
    if (low[node] != number[node]) return;
    const auto begin = std::find(stack.rbegin(), stack.rend(), node).base() - 1;
    found.emplace_back(begin, stack.end());
    std::sort(found.back().begin(), found.back().end());
    for (const std::uint32_t member : found.back()) on_stack[member] = false;
    stack.erase(begin, stack.end());
  }

  void from(std::uint32_t root) {
    enter(root);
    while (!path.empty()) {
      auto& [node, next] = path.back();
      if (next == graph.first[node + 1]) {
        leave(node);
        continue;
      }
      const std::uint32_t to = graph.targets[next++];
      if (number[to] == unvisited) {
        enter(to);
      } else if (on_stack[to]) {
        low[node] = std::min(low[node], number[to]);
      }
    }
  }
};

}  // namespace

std::vector<std::vector<std::uint32_t>> components_in_order(std::uint32_t node_count,
                                                            std::span<const Edge> edges) {
  const Successors successors(node_count, edges);
  Search search(successors, node_count);
  // From the last node down, so that after the reversal nodes without edges keep their order.
  for (std::uint32_t root = node_count; root-- > 0;) {
    if (search.number[root] == unvisited) search.from(root);
  }
  std::reverse(search.found.begin(), search.found.end());
  return std::move(search.found);
}

}  // namespace exact
