#include "gpu/canvas/setup.h"

#include <algorithm>
#include <bit>

#include "gpu/rules.h"

namespace gpu::canvas {
namespace {

std::array<int, 5> attributes(const Vertex& v) { return {v.r, v.g, v.b, v.u, v.v}; }

/// The same with texture coordinates in eighths.
constexpr int rest_bits = 3;
std::array<int, 5> exact_attributes(const Vertex& v) {
  return {v.r, v.g, v.b, (v.u << rest_bits) + v.du, (v.v << rest_bits) + v.dv};
}

double inverse_depth(const Vertex& v) { return 4096.0 / static_cast<double>(std::max(v.z, 1U)); }

/// Differences of an attribute across the triangle, before the division by its area.
template <class T>
struct Slope {
  T x, y;
  Slope(T f0, T f1, T f2, const std::array<Point, 3>& p)
      : x((f1 - f0) * static_cast<T>(p[2].y - p[1].y) - (f2 - f1) * static_cast<T>(p[1].y - p[0].y)),
        y(static_cast<T>(p[1].x - p[0].x) * (f2 - f1) - static_cast<T>(p[2].x - p[1].x) * (f1 - f0)) {}
};

/// 5.2 with finer positions: the gradient per VRAM pixel keeps the console's 12 fractional bits, so that with
/// integer positions every bit is the console's. `bits`: fractional bits of f. |slope| <= 2^33, unit <= 2^11:
/// the product fits.
IntegerPlane integer_plane(const std::array<int, 3>& f, std::size_t core, const std::array<Point, 3>& corners,
                           std::int64_t area, std::int64_t unit, int bits) {
  const Slope<std::int64_t> slope(f[0], f[1], f[2], corners);
  const auto gradient = [&](std::int64_t n) {
    return static_cast<std::uint64_t>(n * unit * 4096 / area) << (12 - bits);
  };
  return {(static_cast<std::uint64_t>(f[core]) << (24 - bits)) * static_cast<std::uint64_t>(unit),
          gradient(slope.x), gradient(slope.y)};
}

RealPlane real_plane(const std::array<double, 3>& f, std::size_t core, const std::array<Point, 3>& corners,
                     double area) {
  const Slope<double> slope(f[0], f[1], f[2], corners);
  return {f[core], slope.x / area, slope.y / area};
}

}  // namespace

Point Grid::place(const Vertex& vertex, bool has_fractions) const {
  const int keep = has_fractions ? 0xff00 >> fraction_bits & 0xff : 0;
  return {((vertex.x - x) * units_per_pixel + (vertex.fx & keep)) * scale,
          ((vertex.y - y) * units_per_pixel + (vertex.fy & keep)) * scale};
}

int Grid::unit_log2() const { return unit_bits + std::countr_zero(static_cast<unsigned>(scale)); }

Planes make_planes(const Grid& grid, const Triangle& triangle, const std::array<Point, 3>& corners,
                   const Paint& paint, bool with_inverse_z) {
  Planes planes;
  const std::size_t core = core_vertex(corners[0].x, corners[1].x, corners[2].x);
  const auto area = doubled_area(corners[0], corners[1], corners[2]);
  const auto real_area = static_cast<double>(area);
  const auto of = paint.is_exact ? exact_attributes : attributes;
  const std::array<std::array<int, 5>, 3> f{of(*triangle[0]), of(*triangle[1]), of(*triangle[2])};
  std::array<double, 3> inverse{};
  planes.origin = corners[core];
  planes.shift = 24 + grid.unit_log2();
  if (with_inverse_z) {
    inverse = {inverse_depth(*triangle[0]), inverse_depth(*triangle[1]), inverse_depth(*triangle[2])};
    planes.inverse_z = real_plane(inverse, core, corners, real_area);
  }
  const bool textured = paint.mode.texture != TexelFormat::none;
  for (std::size_t a = 0; a < 5; ++a) {
    const bool is_colour = a < 3;
    const std::array<int, 3> values{f[0][a], f[1][a], f[2][a]};
    const int bits = paint.is_exact && !is_colour ? rest_bits : 0;
    if (is_colour && !paint.gouraud) {
      planes.integer[a].core =
          (static_cast<std::uint64_t>(values[0]) << 24) * static_cast<std::uint64_t>(grid.unit());
    } else if (!is_colour && !textured) {
      continue;
    } else if (paint.perspective) {
      const double scale = 1.0 / (1 << bits);
      planes.over_z[a] = real_plane(
          {values[0] * scale * inverse[0], values[1] * scale * inverse[1], values[2] * scale * inverse[2]},
          core, corners, real_area);
    } else {
      planes.integer[a] = integer_plane(values, core, corners, area, grid.unit(), bits);
    }
  }
  return planes;
}

Planes make_flat_planes(const Grid& grid, const Vertex& vertex, Point corner, int u, int u_step, int v_step) {
  Planes planes;
  planes.origin = corner;
  planes.shift = 24 + grid.unit_log2();
  const auto unit = static_cast<std::uint64_t>(grid.unit());
  const auto f = attributes(vertex);
  for (std::size_t a = 0; a < 3; ++a)
    planes.integer[a].core = (static_cast<std::uint64_t>(f[a]) << 24) * unit;
  // Half a texel down (or as much up, less one 8.8 step) makes rounding to the nearest texel a floor: all
  // canvas pixels of one VRAM pixel read the same texel.
  const auto walk = [&](int start, int step) {
    const auto half = static_cast<std::uint64_t>(step > 0 ? -128 : 127) << 16;
    const auto first = (static_cast<std::uint64_t>(start) << 24) + half;
    return IntegerPlane{first * unit, 0, 0};
  };
  planes.integer[3] = walk(u, u_step);
  planes.integer[4] = walk(vertex.v, v_step);
  planes.integer[3].per_x = static_cast<std::uint64_t>(u_step) << 24;
  planes.integer[4].per_y = static_cast<std::uint64_t>(v_step) << 24;
  return planes;
}

}  // namespace gpu::canvas
