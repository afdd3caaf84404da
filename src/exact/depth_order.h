#pragma once
// Which of two triangles is nearer at a sample, decided exactly.
//
// 1/z is affine on the screen. For a triangle with corners (x_i, y_i, z_i) and a sample p it is
//     1/z(p) = (w0/z0 + w1/z1 + w2/z2) / D
// with w_i the doubled area of p and the edge opposite corner i, D = w0 + w1 + w2: all integers. So two
// depths compare as two products of integers, and nothing is ever rounded. A comparison in double with a
// proven error bound goes first; only what it cannot decide pays for the wide integers.

#include <array>
#include <compare>
#include <cstdint>

namespace exact {

/// A corner on the screen.
struct Corner {
  std::int32_t x = 0, y = 0;  ///< 1/256 pixel, |x|, |y| <= corner_limit
  std::uint32_t z = 0;  ///< view-space depth, unsigned 20.12; 0 counts as 1/4096, the smallest depth [ours]
  bool operator==(const Corner&) const = default;
};

inline constexpr std::int32_t corner_limit = 1 << 20;

/// How comparisons were decided: the price of exactness.
struct DecisionCounts {
  std::uint64_t filtered = 0;  ///< by the floating-point filter, or because both are one triangle drawn twice
  std::uint64_t exact = 0;     ///< by wide integers
  DecisionCounts& operator+=(const DecisionCounts& other) {
    filtered += other.filtered;
    exact += other.exact;
    return *this;
  }
};

/// The plane of 1/z through three corners, over the whole screen: outside the triangle it goes on, and may be
/// negative there.
class InversePlane {
 public:
  InversePlane() = default;

  /// Corners within corner_limit. Three corners on one line make a plane that is_degenerate().
  explicit InversePlane(const std::array<Corner, 3>& corners);

  /// It has no plane; do not compare it.
  [[nodiscard]] bool is_degenerate() const { return area_ == 0; }

  /// Both have the same three corners, in whatever order: 1/z is the same everywhere.
  [[nodiscard]] bool has_corners_of(const InversePlane& other) const { return corners_ == other.corners_; }

  /// 1/z at pixel x, y in double: units of 4096 / z(20.12), off by at most `slack`.
  struct Estimate {
    double value = 0, slack = 0;
  };
  [[nodiscard]] Estimate estimate(int x, int y) const;

  /// 1/z of a at pixel ax, ay against 1/z of b at pixel bx, by. See the free functions.
  friend std::strong_ordering compare_nearness(const InversePlane& a, int ax, int ay, const InversePlane& b,
                                               int bx, int by, DecisionCounts& counts);
  friend std::strong_ordering compare_nearness_exactly(const InversePlane& a, int ax, int ay,
                                                       const InversePlane& b, int bx, int by);

 private:
  [[nodiscard]] std::array<std::int64_t, 3> weights(int x, int y) const;

  std::array<Corner, 3> corners_{};
  std::array<double, 3> inverse_z_{};
  std::int64_t area_ = 0;  ///< D > 0 unless degenerate: the corners are put in that order, the least first
};

/// greater: a at pixel ax, ay is nearer than b at pixel bx, by (usually the same: they differ where VRAM
/// wraps); equal: the very same depth. Pixel coordinates within +-4096; neither plane is degenerate.
std::strong_ordering compare_nearness(const InversePlane& a, int ax, int ay, const InversePlane& b, int bx,
                                      int by, DecisionCounts& counts);

/// The same without the filter: what the filter is tested against.
std::strong_ordering compare_nearness_exactly(const InversePlane& a, int ax, int ay, const InversePlane& b,
                                              int bx, int by);

inline std::strong_ordering compare_nearness(const InversePlane& a, const InversePlane& b, int x, int y,
                                             DecisionCounts& counts) {
  return compare_nearness(a, x, y, b, x, y, counts);
}
inline std::strong_ordering compare_nearness_exactly(const InversePlane& a, const InversePlane& b, int x,
                                                     int y) {
  return compare_nearness_exactly(a, x, y, b, x, y);
}

}  // namespace exact
