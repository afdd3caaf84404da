#pragma once
// Visibility bsp: collects the primitives of a frame and puts them in an order that is right at every pixel,
// splitting polygons where there is none (exact/split.h).
//
// Lines have no depth, so they have no place in that order: each comes after the last polygon that is farther
// by its key. [ours]

#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "exact/split.h"
#include "scene/submit.h"

namespace scene {

/// A triangle or line at its place in the list.
struct OrderedPrimitive {
  Primitive primitive;
  bool is_whole = true;  ///< it is drawn without limits
  exact::Rows rows;      ///< otherwise only these samples of it, before the drawing offset
};

/// A sink of Submitter, and then the order.
class SplitOrder {
 public:
  /// Forgets the frame before.
  void begin();
  void operator()(const Primitive& p);
  /// Orders what was collected, for a picture of width x height pixels, `scale` samples to a pixel and axis:
  /// 1, 2 or 4. `fraction_mask`: the bits of fraction_x and fraction_y that the corners are drawn with; 0 for
  /// whole pixels.
  /// Error: it would take too much memory.
  base::Result<void> finish(int width, int height, std::uint8_t fraction_mask, int scale,
                            const std::function<bool(double)>& keep_going = {});

  /// After finish(): puts whole triangles in the place of pieces (scene/snap.h). Returns the number of
  /// pieces.
  std::uint32_t snap_pieces();

  [[nodiscard]] const std::vector<OrderedPrimitive>& far_to_near() const { return ordered_; }
  [[nodiscard]] std::uint32_t splits() const { return splits_; }
  /// `keep_going` said no: the order is not right everywhere.
  [[nodiscard]] bool was_stopped() const { return was_stopped_; }

 private:
  void place_lines();

  std::vector<Primitive> triangles_, lines_;  // quads as the two triangles the GPU makes of them
  std::vector<OrderedPrimitive> ordered_;
  std::uint32_t splits_ = 0;
  bool was_stopped_ = false;
};

}  // namespace scene
