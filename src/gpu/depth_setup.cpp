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
/// between near and far, and no slope exceeds 2^30. A vertex's depth is cut to 18 bits of fraction, from
/// which the slopes' numerators follow exactly; a slope is then wrong by less than 2^-21 steps a pixel, so
/// that the depth stays within 2^-10 of a step across the largest triangle, however thin it is.
bool put_fixed(DepthJob& depth, const DepthOptions& o, const Primitive& primitive,
               const std::array<const Vertex*, 3>& t, const Vertex& core) {
  if (o.mapping != DepthMapping::hyperbolic || o.format == DepthFormat::float32 || primitive.has_fractions)
    return false;
  std::array<std::int64_t, 3> q;
  std::int64_t core_q = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double z = t[i]->z / 4096.0;
    if (z < o.near_z || z > o.far_z) return false;
    q[i] = static_cast<std::int64_t>(affine_quantity(o, t[i]->z) * (1 << 18));
    if (t[i] == &core) core_q = q[i];
  }
  const std::int64_t q10 = q[1] - q[0], q21 = q[2] - q[1];
  const int y10 = t[1]->y - t[0]->y, y21 = t[2]->y - t[1]->y;
  const int x10 = t[1]->x - t[0]->x, x21 = t[2]->x - t[1]->x;
  const double step = (1 << 14) / static_cast<double>(x10 * y21 - x21 * y10);  // of the doubled area
  const double dx = static_cast<double>(q10 * y21 - q21 * y10) * step;
  const double dy = static_cast<double>(x10 * q21 - x21 * q10) * step;
  constexpr double steepest = static_cast<double>(std::int64_t{1} << 62);
  if (std::abs(dx) > steepest || std::abs(dy) > steepest) return false;
  depth.fixed = {.start = (static_cast<std::uint64_t>(core_q) << 14) + (std::uint64_t{1} << 31),
                 .dx = static_cast<std::uint64_t>(static_cast<std::int64_t>(dx)),
                 .dy = static_cast<std::uint64_t>(static_cast<std::int64_t>(dy))};
  if (!o.reversed) return true;
  const std::uint64_t largest = std::uint64_t{largest_code(o.format)} << 32 | 0xffffffff;
  depth.fixed = {.start = largest - depth.fixed.start, .dx = 0 - depth.fixed.dx, .dy = 0 - depth.fixed.dy};
  return true;
}

/// Everything else is computed pixel by pixel.
void put_computed(DepthJob& depth, const DepthOptions& o, const Primitive& primitive,
                  const std::array<const Vertex*, 3>& triangle, const Vertex& core) {
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
  const double scale = depth_scale(o.format), range = o.far_z - o.near_z;
  depth.is_linear = o.mapping == DepthMapping::linear;
  depth.low = depth.is_linear ? 1 / o.far_z : 0;
  depth.high = depth.is_linear ? 1 / o.near_z : scale;
  depth.scale = o.reversed ? -scale / range : scale / range;
  depth.offset = o.reversed ? o.far_z / range * scale : -o.near_z / range * scale;
  depth.largest = scale;
  depth.is_float = o.format == DepthFormat::float32;
  depth.flip = o.reversed ? ~std::uint32_t{0} : 0;
  depth.add = o.reversed ? largest_code(o.format) + 1 : 0;
}

}  // namespace

void put_depth(DepthJob& depth, DepthPlane& plane, const Primitive& primitive,
               const std::array<const Vertex*, 3>& triangle, const Vertex& core, Pass pass) {
  const DepthOptions& o = plane.options();
  depth.is_fixed = put_fixed(depth, o, primitive, triangle, core);
  if (!depth.is_fixed) put_computed(depth, o, primitive, triangle, core);
  depth.keys = plane.keys();
  depth.equal_wins = o.test == DepthTest::lequal;
  depth.writes = pass == Pass::opaque;
  const bool texels_decide = primitive.is_textured() && primitive.is_semi_transparent();
  depth.texel_mask = texels_decide ? 0x8000 : 0;
  depth.texel_value = texels_decide && pass == Pass::semi_transparent ? 0x8000 : 0;
}

}  // namespace gpu
