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
double hyperbolic(const DepthConstants& c, std::uint32_t z_20_12) {
  const double z = z_20_12 / 4096.0;
  return c.factor * (z - c.zero) / (z * c.range) * c.scale;
}
double affine_quantity(const DepthConstants& c, std::uint32_t z_20_12) {
  const std::uint32_t z = std::max(z_20_12, 1U);
  return c.is_linear ? 1 / (z / 4096.0) : hyperbolic(c, z);
}

/// 32.32 serves where every covered pixel lies between the vertices (whole-pixel positions), every vertex
/// between near and far, and no slope exceeds 2^30. A vertex's depth is cut to 18 bits of fraction, from
/// which the slopes' numerators follow exactly; a slope is then wrong by less than 2^-21 steps a pixel, so
/// that the depth stays within 2^-10 of a step across the largest triangle, however thin it is.
bool put_fixed(DepthJob& depth, const DepthConstants& c, const Primitive& primitive,
               const std::array<const Vertex*, 3>& t, const Vertex& core) {
  // Without a branch that would depend on which vertex is nearer.
  const auto is_within = [&c](const Vertex& v) {
    return static_cast<unsigned>(v.z >= c.nearest) & static_cast<unsigned>(v.z <= c.farthest);
  };
  if (primitive.has_fractions || (is_within(*t[0]) & is_within(*t[1]) & is_within(*t[2])) == 0) return false;
  const auto with_18_bits = [&c](const Vertex& v) {
    return static_cast<std::int64_t>(hyperbolic(c, v.z) * (1 << 18));
  };
  const std::int64_t q0 = with_18_bits(*t[0]), q1 = with_18_bits(*t[1]), q2 = with_18_bits(*t[2]);
  const std::int64_t core_q = &core == t[0] ? q0 : &core == t[1] ? q1 : q2;
  const std::int64_t q10 = q1 - q0, q21 = q2 - q1;
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
  if (!c.is_reversed) return true;
  const std::uint64_t largest = std::uint64_t{c.largest} << 32 | 0xffffffff;
  depth.fixed = {.start = largest - depth.fixed.start, .dx = 0 - depth.fixed.dx, .dy = 0 - depth.fixed.dy};
  return true;
}

/// Everything else is computed pixel by pixel.
void put_computed(DepthJob& depth, const DepthConstants& c, const Primitive& primitive,
                  const std::array<const Vertex*, 3>& triangle, const Vertex& core) {
  // Fractions may turn a sliver into a line; its whole-pixel positions never do, or it would not be drawn.
  Positions at(triangle, core, primitive.has_fractions);
  if (at.doubled_area() == 0) at = Positions(triangle, core, false);
  const double area = at.doubled_area();

  depth.fixed = {};
  depth.slope = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
    depth.weight[i] = affine_quantity(c, triangle[i]->z) / area;
    depth.edge_start[i] = at.x[j] * at.y[k] - at.x[k] * at.y[j];
    depth.edge_dx[i] = (at.y[j] - at.y[k]) * 256;
    depth.edge_dy[i] = (at.x[k] - at.x[j]) * 256;
    depth.slope += depth.edge_dx[i] * depth.weight[i];
  }
}

}  // namespace

void put_depth(DepthJob& depth, DepthPlane& plane, const Primitive& primitive,
               const std::array<const Vertex*, 3>& triangle, const Vertex& core, Pass pass) {
  depth.keys = plane.keys();
  depth.constants = &plane.constants();
  depth.is_fixed = put_fixed(depth, *depth.constants, primitive, triangle, core);
  if (!depth.is_fixed) put_computed(depth, *depth.constants, primitive, triangle, core);
  depth.writes = pass == Pass::opaque;
  const bool texels_decide = primitive.is_textured() && primitive.is_semi_transparent();
  depth.texel_mask = texels_decide ? 0x8000 : 0;
  depth.texel_value = texels_decide && pass == Pass::semi_transparent ? 0x8000 : 0;
}

}  // namespace gpu
