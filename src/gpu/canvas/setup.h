#pragma once
// From a decoded triangle to corners and attribute planes on the canvas.

#include <array>

#include "gpu/canvas/brush.h"
#include "gpu/primitive.h"

namespace gpu::canvas {

/// Where the canvas lies in VRAM and how finely it sees positions.
struct Grid {
  int x = 0, y = 0;       ///< VRAM pixel of the canvas' top left corner
  int scale = 1;          ///< canvas pixels per VRAM pixel
  int fraction_bits = 0;  ///< leading bits of a vertex' fractions that count

  [[nodiscard]] Point place(const Vertex& vertex, bool has_fractions) const;
  /// Canvas units per VRAM pixel, and its logarithm.
  [[nodiscard]] std::int64_t unit() const { return units_per_pixel * scale; }
  [[nodiscard]] int unit_log2() const;
};

using Triangle = std::array<const Vertex*, 3>;

/// Attribute planes of a triangle with `doubled_area(corners)` != 0. Which ones are filled follows `paint`.
Planes make_planes(const Grid& grid, const Triangle& triangle, const std::array<Point, 3>& corners,
                   const Paint& paint, bool with_inverse_z);

/// Constant attributes, as rectangles and lines have them: colour of `vertex`, u and v walking one texel per
/// VRAM pixel to the right and down (or against it) from the corner.
Planes make_flat_planes(const Grid& grid, const Vertex& vertex, Point corner, int u, int u_step, int v_step);

}  // namespace gpu::canvas
