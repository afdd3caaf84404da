#include "exact/depth_order.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

namespace exact {
namespace {

// |x|, |y| <= 2^20, so differences are at most 2^21, a weight and D at most 2^43; z is below
// 2^32. A side of the comparison, (w0 z1 z2 + w1 z0 z2 + w2 z0 z1) * D' z0' z1' z2', stays
// below 3 * 2^43+64 * 2^43+96 < 2^248.
using Wide = boost::multiprecision::int256_t;
static_assert(corner_limit == 1 << 20 && 2 + (43 + 64) + (43 + 96) < 256);

std::int64_t doubled_area(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t cx,
                          std::int64_t cy) {
  return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
}

// Unit of rounding of double.
constexpr double unit = 0x1p-53;

// value = (sum of w_i * (1/z_i)) / D: w_i and D are exact in double (below 2^53); the reciprocal, the
// product, two sums and the quotient round once each, so the error is below 6 units of sum |w_i| / z_i / D
// (magnitude), itself computed with as small an error. 16 units also cover the sum of two slacks and the
// difference of two values.
constexpr double slack_units = 16 * unit;

}  // namespace

InversePlane::InversePlane(const std::array<Corner, 3>& corners) : corners_(corners) {
  for (Corner& corner : corners_) {
    assert(std::abs(corner.x) <= corner_limit && std::abs(corner.y) <= corner_limit);
    corner.z = std::max(corner.z, 1U);
  }
  auto& [a, b, c] = corners_;
  area_ = doubled_area(a.x, a.y, b.x, b.y, c.x, c.y);
  if (area_ < 0) {
    std::swap(b, c);
    area_ = -area_;
  }
  const auto least =
      std::min_element(corners_.begin(), corners_.end(), [](const Corner& one, const Corner& other) {
        return std::tie(one.x, one.y) < std::tie(other.x, other.y);
      });
  std::rotate(corners_.begin(), least, corners_.end());
  for (std::size_t i = 0; i < 3; ++i) inverse_z_[i] = 4096.0 / corners_[i].z;
}

std::array<std::int64_t, 3> InversePlane::weights(int x, int y) const {
  const std::int64_t px = std::int64_t{x} * 256, py = std::int64_t{y} * 256;
  const auto& [a, b, c] = corners_;
  return {doubled_area(px, py, b.x, b.y, c.x, c.y), doubled_area(a.x, a.y, px, py, c.x, c.y),
          doubled_area(a.x, a.y, b.x, b.y, px, py)};
}

InversePlane::Estimate InversePlane::estimate(int x, int y) const {
  const auto w = weights(x, y);
  double sum = 0, magnitude = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double term = static_cast<double>(w[i]) * inverse_z_[i];
    sum += term;
    magnitude += std::abs(term);
  }
  const auto area = static_cast<double>(area_);
  return {sum / area, magnitude / area * slack_units};
}

std::strong_ordering compare_nearness_exactly(const InversePlane& a, int ax, int ay, const InversePlane& b,
                                              int bx, int by) {
  assert(!a.is_degenerate() && !b.is_degenerate());
  const auto numerator = [](const InversePlane& plane, int x, int y) {
    const auto w = plane.weights(x, y);
    const auto& [c0, c1, c2] = plane.corners_;
    return Wide{w[0]} * c1.z * c2.z + Wide{w[1]} * c0.z * c2.z + Wide{w[2]} * c0.z * c1.z;
  };
  const auto denominator = [](const InversePlane& plane) {
    const auto& [c0, c1, c2] = plane.corners_;
    return Wide{plane.area_} * c0.z * c1.z * c2.z;
  };
  const Wide left = numerator(a, ax, ay) * denominator(b), right = numerator(b, bx, by) * denominator(a);
  return left < right ? std::strong_ordering::less
                      : (left == right ? std::strong_ordering::equal : std::strong_ordering::greater);
}

std::strong_ordering compare_nearness(const InversePlane& a, int ax, int ay, const InversePlane& b, int bx,
                                      int by, DecisionCounts& counts) {
  if (ax == bx && ay == by && a.has_corners_of(b)) {
    ++counts.filtered;
    return std::strong_ordering::equal;
  }
  const auto near_a = a.estimate(ax, ay), near_b = b.estimate(bx, by);
  const double difference = near_a.value - near_b.value;
  if (std::abs(difference) > near_a.slack + near_b.slack) {
    ++counts.filtered;
    return difference < 0 ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  ++counts.exact;
  return compare_nearness_exactly(a, ax, ay, b, bx, by);
}

}  // namespace exact
