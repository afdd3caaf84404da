#pragma once
// What every rasterizer must agree on, each rule once: the console's kernels are set up by it or held against
// it by tests, the canvas carries it over to finer positions, and whoever explains a picture asks it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "gpu/primitive.h"

namespace gpu {

/// Vertices of a triangle or line further apart: it is not drawn at all. [docs/hardware.md#size-rule]
inline constexpr int max_distance_x = 1023, max_distance_y = 511;
constexpr bool is_too_large(int width, int height) {
  return width > max_distance_x || height > max_distance_y;
}

/// Which of three corners attributes are counted from, by their x: the leftmost, ties as the hardware has
/// them. [docs/hardware.md#core-vertex]
template <class X>
constexpr std::size_t core_vertex(X a, X b, X c) {
  if (b <= a) return c <= b ? 2 : 1;
  return c < a ? 2 : 0;
}

/// Added to 8-bit channels before the cut to 5 bits, by y & 3 and x & 3. [docs/hardware.md#dither-matrix]
inline constexpr std::array<std::array<std::int8_t, 4>, 4> dither_matrix{
    {{-4, 0, -3, 1}, {2, -2, 3, -1}, {-3, 1, -4, 0}, {3, -1, 2, -2}}};

/// Lines always; polygons where a colour varies or lights a texel; no other. [docs/hardware.md#dither-matrix]
inline bool is_dithered(const Primitive& p) {
  if (!p.state.dithers()) return false;
  if (p.kind == Kind::line) return true;
  return p.kind == Kind::polygon && !p.is_raw() && (p.is_gouraud() || p.is_textured());
}

/// How a primitive is mixed with what is there; of a textured one, its texels with bit 15.
inline Blend blend_of(const Primitive& p) {
  return p.is_semi_transparent() ? p.state.blend() : Blend::opaque;
}

/// One channel, `most` its largest value: 31 on the console. [docs/hardware.md#semi-transparency]
constexpr int blend_channel(Blend how, int back, int front, int most = 31) {
  switch (how) {
    case Blend::opaque:
      return front;
    case Blend::average:
      return (back + front) >> 1;
    case Blend::add:
      return std::min(most, back + front);
    case Blend::subtract:
      return std::max(0, back - front);
    case Blend::add_quarter:
      break;
  }
  return std::min(most, back + (front >> 2));
}

/// 8-bit channels cut to a pixel of 15 bits.
constexpr std::uint16_t to_pixel(unsigned r, unsigned g, unsigned b) {
  return static_cast<std::uint16_t>(r >> 3 | g >> 3 << 5 | b >> 3 << 10);
}

/// All channels of a pixel; the result has bit 15 of `front`, that of `back` takes no part.
constexpr std::uint16_t blend_pixel(Blend how, std::uint16_t back, std::uint16_t front) {
  int result = front & 0x8000;
  for (int shift = 0; shift < 15; shift += 5) {
    result |= blend_channel(how, back >> shift & 31, front >> shift & 31) << shift;
  }
  return static_cast<std::uint16_t>(result);
}

/// The texels of a rectangle: of its top left pixel, and the steps to the right and down. A flip along x
/// starts at an odd texel. [docs/hardware.md#rectangles]
struct SpriteTexels {
  int u, v, u_step, v_step;
};
inline SpriteTexels sprite_texels(const Primitive& p) {
  const bool flips_x = p.state.flips_x(), flips_y = p.state.flips_y();
  const Vertex& corner = p.vertices[0];
  return {flips_x ? corner.u | 1 : corner.u, corner.v, flips_x ? -1 : 1, flips_y ? -1 : 1};
}

/// A line segment from its left end: a step of one pixel along the longer axis, both ends drawn.
/// [docs/hardware.md#lines]
struct LinePath {
  std::int64_t x, y, step_x, step_y;           ///< 32.32
  std::array<std::int32_t, 3> colour, step_c;  ///< 8.12
  int steps;

  void advance() {
    x += step_x;
    y += step_y;
    for (std::size_t i = 0; i < 3; ++i) colour[i] += step_c[i];
  }
};

/// Quotients by the number of a line's steps, one division for all of it. Half a unit is added to the
/// numerator's magnitude first: numerators are below 2^43 and there are at most 1023 steps, so no error of
/// the doubles reaches an integer.
class PerStep {
 public:
  explicit PerStep(int steps) : factor_(steps == 0 ? 0 : 1.0 / steps), away_(std::max(steps - 1, 0)) {}
  /// 32.32, rounded away from zero so that the last step arrives.
  [[nodiscard]] std::int64_t distance(int pixels) const {
    return divide(pixels * 4294967296.0, pixels == 0 ? 0 : away_);
  }
  /// 8.12, rounded towards zero.
  [[nodiscard]] std::int32_t colour(int difference) const {
    return static_cast<std::int32_t>(divide(difference * 4096.0, 0));
  }

 private:
  [[nodiscard]] std::int64_t divide(double numerator, double more) const {
    return static_cast<std::int64_t>((numerator + std::copysign(more + 0.5, numerator)) * factor_);
  }
  double factor_, away_;
};

/// False where the size rule refuses it. Filled in place: a copy costs as much as a short line.
[[nodiscard]] inline bool put_line_path(LinePath& path, const Primitive& p) {
  const Vertex *a = &p.vertices[0], *b = &p.vertices[1];
  const int width = std::abs(b->x - a->x), height = std::abs(b->y - a->y);
  if (is_too_large(width, height)) return false;
  const int steps = std::max(width, height);
  if (steps > 0 && a->x >= b->x) std::swap(a, b);
  constexpr std::int64_t one = std::int64_t{1} << 32;
  const auto start = [](std::uint8_t c) { return std::int32_t{c} * 4096 + 2048; };
  const PerStep per_step(steps);
  const std::int64_t step_x = per_step.distance(b->x - a->x), step_y = per_step.distance(b->y - a->y);
  path.x = a->x * one + one / 2 - 1024;
  path.y = a->y * one + one / 2 - (step_y < 0 ? 1024 : 0);
  path.step_x = step_x;
  path.step_y = step_y;
  path.colour = {start(a->r), start(a->g), start(a->b)};
  path.step_c = {};
  path.steps = steps;
  if (p.is_gouraud()) {
    path.step_c = {per_step.colour(b->r - a->r), per_step.colour(b->g - a->g), per_step.colour(b->b - a->b)};
  }
  return true;
}

}  // namespace gpu
