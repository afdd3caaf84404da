#pragma once
// 1/z to a depth key, per sample: the formulas of gpu/depth.h arranged so that the pixel loop multiplies and
// adds only. 1/z is what is affine on the screen.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "gpu/depth.h"

namespace gpu::canvas {

class DepthCode {
 public:
  static constexpr std::uint32_t empty = DepthPlane::empty;  ///< loses to every fragment

  DepthCode() = default;
  explicit DepthCode(const DepthOptions& options)
      : linear_(options.mapping == DepthMapping::linear),
        float_(options.format == DepthFormat::float32),
        reversed_(options.reversed),
        accepts_equal_(options.test == DepthTest::lequal),
        scale_(depth_scale(options.format)) {
    const double near = options.near_z;
    const double range = options.far_z - near;
    // t = constant + slope * (z or 1/z); reversed formats store 1 - t, whose own
    // formula keeps float32 precise.
    if (linear_) {
      constant_ = reversed_ ? options.far_z / range : -near / range;
      slope_ = (reversed_ ? -1 : 1) / range;
    } else {
      constant_ = reversed_ ? -near / range : options.far_z / range;
      slope_ = (reversed_ ? 1 : -1) * near * options.far_z / range;
    }
  }

  /// `inverse_z` > 0; anything else, NaN included, reads as an end of the range.
  [[nodiscard]] std::uint32_t key(double inverse_z) const {
    const double t = constant_ + slope_ * (linear_ ? 1 / inverse_z : inverse_z);
    const double saturated = t > 0 ? (t < 1 ? t : 1) : 0;  // NaN becomes 0
    if (float_) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(saturated));
      return reversed_ ? one_as_float - bits : bits;
    }
    const auto code = static_cast<std::uint32_t>(saturated * scale_ + 0.5);
    return std::min(reversed_ ? static_cast<std::uint32_t>(scale_) - code : code, DepthPlane::farthest);
  }

  [[nodiscard]] bool passes(std::uint32_t key, std::uint32_t stored) const {
    return key < stored || (accepts_equal_ && key == stored);
  }

 private:
  static constexpr std::uint32_t one_as_float = 0x3f800000;
  bool linear_ = false, float_ = false, reversed_ = false, accepts_equal_ = false;
  double scale_ = 1, constant_ = 0, slope_ = 1;
};

}  // namespace gpu::canvas
