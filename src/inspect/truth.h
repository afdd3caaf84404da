#pragma once
// Truth: at a sample, among the fragments of polygons with depth that cover it and would write, the opaque
// one with the largest 1/z, and over it the nearer semi-transparent ones from far to near. Equal depths: any
// of them is right.

#include <cstdint>
#include <vector>

#include "inspect/fragments.h"

namespace inspect {

/// One pixel, judged. Winner: what is seen; owner: what should be.
struct Verdict {
  std::uint32_t winner = nobody;  ///< draw of the last opaque fragment written; nobody: the background
  std::uint32_t owner = nobody;   ///< draw of the nearest opaque fragment; of equal ones the first drawn
  bool shows_owner = true;        ///< the winner is as near as the owner
  bool layers_right = true;       ///< the semi-transparent fragments over the owner are the right ones in the
                                  ///< right order; judged only where it shows
  /// layers_right false: `over` was drawn on top of `under`, which is nearer.
  std::uint32_t over = nobody, under = nobody;

  [[nodiscard]] bool is_right() const { return shows_owner && layers_right; }
};

/// Judges one pixel from its fragments in drawing order.
Verdict judge(std::span<const Fragment> fragments, std::uint32_t pixel, Surfaces& surfaces);

/// The fragments that make up the true pixel, far to near: the owner, if there is one, then its layers. Equal
/// depths keep the order drawn.
std::vector<Fragment> true_stack(std::span<const Fragment> fragments, std::uint32_t pixel,
                                 Surfaces& surfaces);

}  // namespace inspect
