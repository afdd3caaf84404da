#include "inspect/truth.h"

#include <algorithm>

namespace inspect {
namespace {

const Fragment* nearest_opaque(std::span<const Fragment> fragments, std::uint32_t pixel, Surfaces& surfaces) {
  const Fragment* nearest = nullptr;
  for (const Fragment& f : fragments) {
    if (!f.blends && (nearest == nullptr || surfaces.compare(f, *nearest, pixel) > 0)) nearest = &f;
  }
  return nearest;
}

const Fragment* last_written_opaque(std::span<const Fragment> fragments) {
  const auto last = std::find_if(fragments.rbegin(), fragments.rend(),
                                 [](const Fragment& f) { return !f.blends && !f.rejected; });
  return last == fragments.rend() ? nullptr : &*last;
}

// Every layer nearer than the base is seen, none that is farther, and they come from far to near.
void judge_layers(Verdict& verdict, std::span<const Fragment> fragments, const Fragment* base,
                  std::uint32_t pixel, Surfaces& surfaces) {
  const auto complain = [&](const Fragment& over, const Fragment& under) {
    if (!verdict.layers_right) return;
    verdict.layers_right = false;
    verdict.over = over;
    verdict.under = under;
  };
  const Fragment* below = nullptr;  // the layer seen last
  for (const Fragment& f : fragments) {
    if (!f.blends) continue;
    const bool is_seen = !f.rejected && (base == nullptr || &f > base);
    if (base != nullptr) {
      const auto nearness = surfaces.compare(f, *base, pixel);
      if (nearness > 0 && !is_seen) complain(*base, f);
      if (nearness < 0 && is_seen) complain(f, *base);
    } else if (!is_seen) {
      complain({}, f);
    }
    if (!is_seen) continue;
    if (below != nullptr && surfaces.compare(f, *below, pixel) < 0) complain(f, *below);
    below = &f;
  }
}

// What an opaque layer left to be judged: the fragments after it that lie before all that it covers.
std::vector<Fragment> uncovered(std::span<const Fragment> fragments, std::uint32_t pixel,
                                Surfaces& surfaces) {
  const auto end_of_covered = std::ranges::find_if_not(fragments, &Fragment::covered);
  const std::span covered(fragments.begin(), end_of_covered);
  const Fragment* hidden = nearest_opaque(covered, pixel, surfaces);
  std::vector<Fragment> rest(end_of_covered, fragments.end());
  if (hidden != nullptr) {
    std::erase_if(rest, [&](const Fragment& f) { return surfaces.compare(f, *hidden, pixel) <= 0; });
  }
  return rest;
}

bool has_covered(std::span<const Fragment> fragments) {
  return !fragments.empty() && fragments.front().covered;
}

}  // namespace

Verdict judge(std::span<const Fragment> fragments, std::uint32_t pixel, Surfaces& surfaces) {
  if (has_covered(fragments)) return judge(uncovered(fragments, pixel, surfaces), pixel, surfaces);
  Verdict verdict;
  const Fragment* winner = last_written_opaque(fragments);
  const Fragment* owner = nearest_opaque(fragments, pixel, surfaces);
  if (winner != nullptr) verdict.winner = *winner;
  if (owner != nullptr) verdict.owner = *owner;
  if (winner != owner) {
    verdict.shows_owner = winner != nullptr && surfaces.compare(*winner, *owner, pixel) == 0;
  }
  if (verdict.shows_owner) judge_layers(verdict, fragments, winner, pixel, surfaces);
  return verdict;
}

std::vector<Fragment> true_stack(std::span<const Fragment> fragments, std::uint32_t pixel,
                                 Surfaces& surfaces) {
  if (has_covered(fragments)) return true_stack(uncovered(fragments, pixel, surfaces), pixel, surfaces);
  std::vector<Fragment> stack;
  const Fragment* owner = nearest_opaque(fragments, pixel, surfaces);
  for (const Fragment& f : fragments) {
    if (f.blends && (owner == nullptr || surfaces.compare(f, *owner, pixel) > 0)) stack.push_back(f);
  }
  std::stable_sort(stack.begin(), stack.end(),
                   [&](const Fragment& a, const Fragment& b) { return surfaces.compare(a, b, pixel) < 0; });
  if (owner != nullptr) stack.insert(stack.begin(), *owner);
  return stack;
}

}  // namespace inspect
