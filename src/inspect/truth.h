#pragma once
// Truth: at a sample, among the fragments of polygons with depth that cover it and would write, the opaque
// one with the largest 1/z, and over it the nearer semi-transparent ones from far to near. Equal depths: any
// of them is right. What a fill, copy or upload erased, or an opaque layer covers, takes no part.

#include <cstdint>
#include <vector>

#include "inspect/fragments.h"

namespace inspect {

/// One pixel, judged. Winner: what is seen; owner: what should be.
struct Verdict {
  Fragment winner;           ///< the last opaque one written; of nobody: the background
  Fragment owner;            ///< the nearest opaque one; of equal ones the first drawn
  bool shows_owner = true;   ///< the winner is as near as the owner
  bool layers_right = true;  ///< the semi-transparent fragments over the owner are the right ones in the
                             ///< right order; judged only where it shows
  /// layers_right false: `over` was drawn on top of `under`, which is nearer.
  Fragment over, under;

  [[nodiscard]] bool is_right() const { return shows_owner && layers_right; }
};

/// Judges one pixel from its fragments in drawing order. Covered ones take no part, and neither does what
/// lies behind them: their depth is still in the z-buffer.
Verdict judge(std::span<const Fragment> fragments, std::uint32_t pixel, Surfaces& surfaces);

/// The fragments that make up the true pixel, far to near: the owner, if there is one, then its layers. Equal
/// depths keep the order drawn.
std::vector<Fragment> true_stack(std::span<const Fragment> fragments, std::uint32_t pixel,
                                 Surfaces& surfaces);

}  // namespace inspect
