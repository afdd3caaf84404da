#include "gpu/depth_setup.h"

#include <algorithm>
#include <cmath>

namespace gpu {

namespace {

/// Positions relative to the core vertex, in 1/256 pixel: whole numbers, exact in double.
struct Positions {
  std::array<double, 3> x, y;
  Positions(const std::array<const Vertex*, 3>& triangle, const Vertex& core, bool with_fractions) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex& v = *triangle[i];
      x[i] = (v.x - core.x) * 256 + (with_fractions ? v.fx : 0);
      y[i] = (v.y - core.y) * 256 + (with_fractions ? v.fy : 0);
    }
  }
  [[nodiscard]] double doubled_area() const {
    return (x[1] - x[0]) * (y[2] - y[1]) - (x[2] - x[1]) * (y[1] - y[0]);
  }
};

/// What is affine on the screen: the hyperbolic depth itself, or 1/z. Not saturated:
/// that is for each pixel to do.
double affine_quantity(const DepthOptions& o, std::uint32_t z_20_12) {
  const double z = std::max(z_20_12, 1U) / 4096.0, range = o.far_z - o.near_z;
  if (o.mapping == DepthMapping::linear) return 1 / z;
  const double unit =
      o.reversed ? o.near_z * (o.far_z - z) / (z * range) : o.far_z * (z - o.near_z) / (z * range);
  return unit * depth_scale(o.format);
}

/// 32.32 serves where every covered pixel lies between the vertices (whole-pixel positions), every vertex
/// between near and far, and the slopes are small enough for their error to stay below 2^-11 of a step across
/// the largest triangle.
void put_fixed(DepthJob& depth, const DepthOptions& o, const Primitive& primitive,
               const std::array<const Vertex*, 3>& triangle, const Vertex& core) {
  depth.is_fixed = false;
  if (o.mapping != DepthMapping::hyperbolic || o.format == DepthFormat::float32 || primitive.has_fractions)
    return;
  double slope_y = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double z = triangle[i]->z / 4096.0;
    if (z < o.near_z || z > o.far_z) return;
    slope_y += depth.edge_dy[i] * depth.weight[i];
  }
  constexpr double steepest = 1 << 30, one = 4294967296.0;
  if (std::abs(depth.slope) > steepest || std::abs(slope_y) > steepest) return;
  depth.is_fixed = true;
  depth.fixed = {.start = static_cast<std::uint64_t>((affine_quantity(o, core.z) + 0.5) * one),
                 .dx = static_cast<std::uint64_t>(static_cast<std::int64_t>(depth.slope * one)),
                 .dy = static_cast<std::uint64_t>(static_cast<std::int64_t>(slope_y * one))};
}

}  // namespace

void put_depth(DepthJob& depth, DepthPlane& plane, const Primitive& primitive,
               const std::array<const Vertex*, 3>& triangle, const Vertex& core, Pass pass) {
  const DepthOptions& o = plane.options();
  // Fractions may turn a sliver into a line; its whole-pixel positions never do, or it would not be drawn.
  Positions at(triangle, core, primitive.has_fractions);
  if (at.doubled_area() == 0) at = Positions(triangle, core, false);
  const double area = at.doubled_area();

  depth.slope = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    depth.weight[i] = affine_quantity(o, triangle[i]->z) / area;
    depth.edge_start[i] = at.x[j] * at.y[k] - at.x[k] * at.y[j];
    depth.edge_dx[i] = (at.y[j] - at.y[k]) * 256;
    depth.edge_dy[i] = (at.x[k] - at.x[j]) * 256;
    depth.slope += depth.edge_dx[i] * depth.weight[i];
  }

  put_fixed(depth, o, primitive, triangle, core);
  const double scale = depth_scale(o.format), range = o.far_z - o.near_z;
  depth.is_linear = o.mapping == DepthMapping::linear;
  depth.low = depth.is_linear ? 1 / o.far_z : 0;
  depth.high = depth.is_linear ? 1 / o.near_z : scale;
  depth.scale = o.reversed ? -scale / range : scale / range;
  depth.offset = o.reversed ? o.far_z / range * scale : -o.near_z / range * scale;
  depth.largest = scale;
  depth.is_float = o.format == DepthFormat::float32;

  depth.keys = plane.keys();
  depth.flip = o.reversed ? ~std::uint32_t{0} : 0;
  depth.add = o.reversed ? depth_key(o, 0) + 1 : 0;
  depth.equal_wins = o.test == DepthTest::lequal;
  depth.writes = pass == Pass::opaque;
  const bool texels_decide = primitive.is_textured() && primitive.is_semi_transparent();
  depth.texel_mask = texels_decide ? 0x8000 : 0;
  depth.texel_value = texels_decide && pass == Pass::semi_transparent ? 0x8000 : 0;
}

}  // namespace gpu
