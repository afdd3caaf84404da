#include "gpu/pixel_counts.h"

#include "gpu/raster.h"

namespace gpu {

void PixelCounts::add(const Primitive& primitive) {
  const std::size_t index = (primitive.is_gouraud() && primitive.kind != Kind::rectangle ? gouraud : 0) +
                            (primitive.is_textured() ? textured : 0) +
                            (primitive.is_semi_transparent() ? semi_transparent : 0);
  const auto area =
      static_cast<std::uint64_t>(primitive.width) * static_cast<std::uint64_t>(primitive.height);
  switch (primitive.kind) {
    case Kind::polygon:
      polygons[index] += polygon_pixels(primitive);
      break;
    case Kind::rectangle:
      rectangles[index] += rectangle_pixels(primitive);
      break;
    case Kind::line:
      lines[index] += line_pixels(primitive);
      break;
    case Kind::fill:
      fills += area;
      break;
    case Kind::copy:
      copies += area;
      break;
    case Kind::upload:
      uploads += area;
      break;
  }
}

}  // namespace gpu
