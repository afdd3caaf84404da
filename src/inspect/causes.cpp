#include "inspect/causes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <unordered_set>
#include <utility>

#include "exact/order_graph.h"

namespace inspect {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Pixels on which each draw of some wrong pair has fragments, in ascending order.
struct Occurrence {
  std::uint32_t pixel;
  const Fragment* fragment;
};
using Occurrences = std::map<std::uint32_t, std::vector<Occurrence>>;

Occurrences find_occurrences(const std::map<Pair, bool>& pairs, const Fragments& fragments) {
  Occurrences found;
  for (const auto& [pair, crossing] : pairs) {
    found[pair.first];
    found[pair.second];
  }
  for (std::uint32_t pixel = 0; pixel < gpu::Vram::size; ++pixel) {
    for (const Fragment& f : fragments.at(pixel)) {
      if (const auto list = found.find(f.draw); list != found.end()) list->second.push_back({pixel, &f});
    }
  }
  return found;
}

// Do both signs of the depth difference occur over the pixels the two share? Walks the shorter list.
bool interpenetrate(const std::vector<Occurrence>* a, const std::vector<Occurrence>* b, Surfaces& surfaces) {
  if (a->size() > b->size()) std::swap(a, b);
  bool nearer = false, farther = false;
  auto from = b->begin();
  for (const Occurrence& one : *a) {
    from = std::lower_bound(from, b->end(), one.pixel,
                            [](const Occurrence& o, std::uint32_t pixel) { return o.pixel < pixel; });
    for (auto other = from; other != b->end() && other->pixel == one.pixel; ++other) {
      const auto nearness = surfaces.compare(*one.fragment, *other->fragment, one.pixel);
      nearer = nearer || nearness > 0;
      farther = farther || nearness < 0;
    }
    if (nearer && farther) return true;
  }
  return false;
}

// Far to near. A painter's list is nearly sorted already, so insertion compares each with its neighbour and
// little more.
void sort_far_to_near(std::vector<Fragment>& stack, std::uint32_t pixel, Surfaces& surfaces) {
  const auto is_before = [&](const Fragment& a, const Fragment& b) {
    return surfaces.compare(a, b, pixel) < 0;
  };
  constexpr std::size_t few = 48;
  if (stack.size() > few) return std::stable_sort(stack.begin(), stack.end(), is_before);
  for (std::size_t i = 1; i < stack.size(); ++i) {
    for (std::size_t k = i; k > 0 && is_before(stack[k], stack[k - 1]); --k)
      std::swap(stack[k], stack[k - 1]);
  }
}

// Edges, each once. Neighbouring pixels mostly have the same ones: those seen last are found without the set.
class EdgeList {
 public:
  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t key = std::uint64_t{from} << 32 | to;
    std::uint64_t& recent = recent_[(key * 0x9e3779b97f4a7c15U) >> 54];  // Fibonacci hashing to 10 bits
    if (from == to || recent == key) return;
    recent = key;
    if (seen_.insert(key).second) edges_.emplace_back(from, to);
  }
  [[nodiscard]] std::vector<exact::Edge> take() { return std::move(edges_); }

 private:
  std::vector<exact::Edge> edges_;
  std::unordered_set<std::uint64_t> seen_;
  std::array<std::uint64_t, 1024> recent_{};  // 0 would be an edge from draw 0 to itself, which is none
};

// Edges from each depth of a pixel to the next nearer one; by transitivity they stand for all pairs.
std::vector<exact::Edge> must_be_drawn_before(const Fragments& fragments, Surfaces& surfaces) {
  EdgeList edges;
  std::vector<Fragment> stack;
  for (std::uint32_t pixel = 0; pixel < gpu::Vram::size; ++pixel) {
    const auto here = fragments.at(pixel);
    if (here.size() < 2) continue;
    stack.assign(here.begin(), here.end());
    sort_far_to_near(stack, pixel, surfaces);
    std::size_t farther = 0, begin = 0;  // stack[farther..begin) is the depth before the one at begin
    while (begin < stack.size()) {
      std::size_t end = begin + 1;
      while (end < stack.size() && surfaces.compare(stack[begin], stack[end], pixel) == 0) ++end;
      for (std::size_t i = farther; i < begin; ++i) {
        for (std::size_t k = begin; k < end; ++k) edges.add(stack[i].draw, stack[k].draw);
      }
      farther = begin;
      begin = end;
    }
  }
  return edges.take();
}

std::vector<std::uint32_t> component_of_draws(std::size_t draws, const Fragments& fragments,
                                              Surfaces& surfaces) {
  const auto edges = must_be_drawn_before(fragments, surfaces);
  const auto components = exact::components_in_order(static_cast<std::uint32_t>(draws), edges);
  std::vector<std::uint32_t> component(draws);
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    for (const std::uint32_t draw : components[c]) component[draw] = c;
  }
  return component;
}

void find_list_causes(std::vector<WrongPixel>& wrong, const gpu::Trace& trace, const Fragments& fragments,
                      Surfaces& surfaces) {
  std::map<Pair, bool> pairs;  // winner, owner -> they interpenetrate
  for (const WrongPixel& pixel : wrong) {
    assert(pixel.winner != nobody || pixel.is_blend);  // a list rejects nothing
    if (!pixel.is_blend) pairs.emplace(Pair{pixel.winner, pixel.owner}, false);
  }
  if (pairs.empty()) return;
  const auto occurrences = find_occurrences(pairs, fragments);
  for (auto& [pair, crossing] : pairs) {
    crossing = interpenetrate(&occurrences.at(pair.first), &occurrences.at(pair.second), surfaces);
  }
  const auto component = component_of_draws(trace.draws.size(), fragments, surfaces);
  for (WrongPixel& pixel : wrong) {
    if (pixel.is_blend) continue;
    if (pairs.at({pixel.winner, pixel.owner})) pixel.causes.add(Cause::interpenetration);
    if (component[pixel.winner] == component[pixel.owner]) pixel.causes.add(Cause::cyclic_overlap);
    const std::uint32_t winner_key = trace.draws[pixel.winner].bucket,
                        owner_key = trace.draws[pixel.owner].bucket;
    if (winner_key == gpu::no_bucket || owner_key == gpu::no_bucket) {
      pixel.causes.add(Cause::list_order);
    } else {
      pixel.causes.add(winner_key == owner_key ? Cause::bucket_tie : Cause::key_inversion);
    }
  }
}

// Nobody's key is that of an empty depth plane, the farthest of all.
std::uint32_t depth_key(std::span<const Fragment> fragments, std::uint32_t draw, Surfaces& surfaces,
                        std::uint32_t pixel) {
  const Fragment* nearest = nullptr;
  for (const Fragment& f : fragments) {
    if (f.draw != draw || f.blends) continue;
    if (nearest == nullptr || surfaces.compare(f, *nearest, pixel) > 0) nearest = &f;
  }
  return nearest == nullptr ? 0xffffffff : nearest->depth;
}

}  // namespace

std::optional<Cause> CauseSet::first() const {
  for (std::size_t c = 0; c < cause_count; ++c) {
    if (contains(static_cast<Cause>(c))) return static_cast<Cause>(c);
  }
  return std::nullopt;
}

void find_causes(std::vector<WrongPixel>& wrong, const gpu::Trace& trace, const Fragments& fragments,
                 Surfaces& surfaces, Order order) {
  if (order == Order::exact) return;
  for (WrongPixel& pixel : wrong) {
    if (pixel.is_blend) {
      pixel.causes.add(Cause::blend_order);
    } else if (order == Order::depth) {
      const auto here = fragments.at(pixel.pixel);
      const bool is_tie = depth_key(here, pixel.winner, surfaces, pixel.pixel) ==
                          depth_key(here, pixel.owner, surfaces, pixel.pixel);
      pixel.causes.add(is_tie ? Cause::depth_tie : Cause::depth_precision);
    }
  }
  if (order == Order::list) find_list_causes(wrong, trace, fragments, surfaces);
}

}  // namespace inspect
