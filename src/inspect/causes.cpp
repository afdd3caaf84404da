#include "inspect/causes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "exact/order_graph.h"

namespace inspect {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Pixels on which each draw of some wrong pair has fragments, in ascending order.
struct Occurrence {
  std::uint32_t pixel, fragment;  // number of the fragment
};
using Occurrences = std::map<std::uint32_t, std::vector<Occurrence>>;

Occurrences find_occurrences(const std::map<Pair, bool>& pairs, const gpu::Trace& trace,
                             const Fragments& fragments) {
  std::vector<std::uint32_t> counts(trace.draws.size());
  for (std::uint32_t f = 0; f < fragments.size(); ++f) ++counts[fragments[f].draw];
  std::vector<std::vector<Occurrence>*> of_draw(trace.draws.size());
  Occurrences found;
  for (const auto& [pair, crossing] : pairs) {
    for (const std::uint32_t draw : {pair.first, pair.second}) {
      of_draw[draw] = &found[draw];
      of_draw[draw]->reserve(counts[draw]);
    }
  }
  for (std::uint32_t pixel = 0; pixel < gpu::Vram::size; ++pixel) {
    const auto first = fragments.first(pixel);
    for (std::uint32_t f = first; f < first + fragments.at(pixel).size(); ++f) {
      if (auto* list = of_draw[fragments[f].draw]) list->push_back({pixel, f});
    }
  }
  return found;
}

// Both signs of the depth difference of two draws over the pixels they share. 1/z is affine along a row, so
// that of a run of pixels side by side the ends tell all.
class Crossing {
 public:
  Crossing(const Fragments& fragments, Surfaces& surfaces) : fragments_(fragments), surfaces_(surfaces) {}

  // Walks the shorter list, and the longer one in strides that double.
  bool of(const std::vector<Occurrence>* a, const std::vector<Occurrence>* b) {
    if (a->size() > b->size()) std::swap(a, b);
    nearer_ = farther_ = has_last_ = false;
    std::size_t from = 0;
    for (const Occurrence& one : *a) {
      from = first_from(*b, from, one.pixel);
      for (std::size_t other = from; other < b->size() && (*b)[other].pixel == one.pixel; ++other) {
        visit(one, (*b)[other]);
      }
      if (nearer_ && farther_) return true;
    }
    end_run();
    return nearer_ && farther_;
  }

 private:
  static std::size_t first_from(const std::vector<Occurrence>& list, std::size_t from, std::uint32_t pixel) {
    std::size_t stride = 1;
    while (from + stride < list.size() && list[from + stride].pixel < pixel) {
      from += stride;
      stride *= 2;
    }
    const auto begin = list.begin() + static_cast<std::ptrdiff_t>(from),
               end = list.begin() + static_cast<std::ptrdiff_t>(std::min(from + stride + 1, list.size()));
    return static_cast<std::size_t>(
        std::lower_bound(begin, end, pixel,
                         [](const Occurrence& o, std::uint32_t p) { return o.pixel < p; }) -
        list.begin());
  }

  void visit(const Occurrence& one, const Occurrence& other) {
    const Fragment &f = fragments_[one.fragment], &g = fragments_[other.fragment];
    if (!has_last_ || !continues(f, g, one.pixel)) {
      end_run();
      compare(f, g, one.pixel);
    }
    last_ = {f, g, one.pixel};
    has_last_ = true;
  }
  [[nodiscard]] bool continues(const Fragment& f, const Fragment& g, std::uint32_t pixel) const {
    return pixel == last_.pixel + 1 && pixel % gpu::Vram::width != 0 && f.half == last_.f.half &&
           g.half == last_.g.half && !surfaces_.begins_at(f, pixel) && !surfaces_.begins_at(g, pixel);
  }
  void end_run() {
    if (has_last_) compare(last_.f, last_.g, last_.pixel);
    has_last_ = false;
  }
  void compare(const Fragment& f, const Fragment& g, std::uint32_t pixel) {
    const auto nearness = surfaces_.compare(f, g, pixel);
    nearer_ = nearer_ || nearness > 0;
    farther_ = farther_ || nearness < 0;
  }

  struct Last {
    Fragment f, g;
    std::uint32_t pixel = 0;
  };
  const Fragments& fragments_;
  Surfaces& surfaces_;
  Last last_;
  bool has_last_ = false, nearer_ = false, farther_ = false;
};

// Far to near. A painter's list is nearly sorted already: looking is cheaper than sorting.
void sort_far_to_near(std::vector<Fragment>& stack, std::uint32_t pixel, Surfaces& surfaces) {
  const auto is_before = [&](const Fragment& a, const Fragment& b) {
    return surfaces.compare(a, b, pixel) < 0;
  };
  constexpr std::size_t few = 8;
  if (stack.size() > few) {
    if (!std::is_sorted(stack.begin(), stack.end(), is_before)) {
      std::stable_sort(stack.begin(), stack.end(), is_before);
    }
    return;
  }
  for (std::size_t i = 1; i < stack.size(); ++i) {
    for (std::size_t k = i; k > 0 && is_before(stack[k], stack[k - 1]); --k)
      std::swap(stack[k], stack[k - 1]);
  }
}

// The graph of "must be drawn before": edges from each depth of a pixel to the next nearer one, which by
// transitivity stand for all pairs. Draws of one depth before draws of another: where both are several the
// edges lead through a node of their own, so that there are as many as draws and not as their product.
class OrderGraph {
 public:
  explicit OrderGraph(std::size_t draws) : nodes_(static_cast<std::uint32_t>(draws)) {}

  void add(std::span<const Fragment> farther, std::span<const Fragment> nearer) {
    if (farther.size() == 1 || nearer.size() == 1) {
      for (const Fragment& f : farther) {
        for (const Fragment& n : nearer) edge(f.draw, n.draw);
      }
      return;
    }
    names_.assign(1, static_cast<std::uint32_t>(farther.size()));
    for (const Fragment& f : farther) names_.push_back(f.draw);
    for (const Fragment& n : nearer) names_.push_back(n.draw);
    if (const auto& last = between_[names_[1] % between_.size()]; last == names_) return;
    between_[names_[1] % between_.size()] = names_;
    if (!hubs_.insert(names_).second) return;
    const std::uint32_t hub = nodes_++;
    for (const Fragment& f : farther) edge(f.draw, hub);
    for (const Fragment& n : nearer) edge(hub, n.draw);
  }
  [[nodiscard]] std::uint32_t nodes() const { return nodes_; }
  [[nodiscard]] std::vector<exact::Edge> take() {
    thin_out();
    hubs_.clear();
    std::vector<exact::Edge> edges;
    edges.reserve(keys_.size());
    for (const std::uint64_t key : keys_) {
      edges.emplace_back(static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key));
    }
    keys_ = {};
    return edges;
  }

 private:
  // Neighbouring pixels mostly have the same edges: those seen last are not kept again. The others are kept
  // twice until there are many; no table of hashes, which a list of draws could be made to flood.
  void edge(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t key = std::uint64_t{from} << 32 | to;
    std::uint64_t& recent = recent_[(key * 0x9e3779b97f4a7c15U) >> 54];  // Fibonacci hashing to 10 bits
    if (from == to || recent == key) return;
    recent = key;
    keys_.push_back(key);
    if (keys_.size() >= most_keys_) {
      thin_out();
      most_keys_ = std::max(most_keys_, 2 * keys_.size());
    }
  }
  void thin_out() {
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }

  std::uint32_t nodes_;
  std::vector<std::uint64_t> keys_;
  std::size_t most_keys_ = std::size_t{1} << 20;
  std::array<std::uint64_t, 1024> recent_{};   // 0 would be an edge from draw 0 to itself, which is none
  std::set<std::vector<std::uint32_t>> hubs_;  // how many are farther, those, and the nearer ones
  std::array<std::vector<std::uint32_t>, 16> between_;  // the hubs seen last
  std::vector<std::uint32_t> names_;
};

OrderGraph must_be_drawn_before(std::size_t draws, const Fragments& fragments, Surfaces& surfaces) {
  OrderGraph graph(draws);
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
      if (begin > farther) {
        graph.add(std::span(stack).subspan(farther, begin - farther),
                  std::span(stack).subspan(begin, end - begin));
      }
      farther = begin;
      begin = end;
    }
  }
  return graph;
}

std::vector<std::uint32_t> component_of_draws(std::size_t draws, const Fragments& fragments,
                                              Surfaces& surfaces) {
  auto graph = must_be_drawn_before(draws, fragments, surfaces);
  const auto components = exact::components_in_order(graph.nodes(), graph.take());
  std::vector<std::uint32_t> component(graph.nodes());
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
  {
    const auto occurrences = find_occurrences(pairs, trace, fragments);
    Crossing check(fragments, surfaces);
    for (auto& [pair, crossing] : pairs) {
      crossing = check.of(&occurrences.at(pair.first), &occurrences.at(pair.second));
    }
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
