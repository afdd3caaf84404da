#include "gpu/depth.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gpu {

namespace {

/// 0 at near, 1 at far; the other way round when reversed, computed so that small
/// results keep their precision.
double unit_depth(const DepthOptions& o, double z) {
  const double range = o.far_z - o.near_z;
  if (o.mapping == DepthMapping::linear) return (o.reversed ? o.far_z - z : z - o.near_z) / range;
  return o.reversed ? o.near_z * (o.far_z - z) / (z * range) : o.far_z * (z - o.near_z) / (z * range);
}

}  // namespace

std::uint32_t largest_code(DepthFormat format) {
  constexpr std::uint32_t codes[] = {0xffff, 0xffffff, 0xffffffff, std::bit_cast<std::uint32_t>(1.0F)};
  return codes[static_cast<std::size_t>(format)];
}

double depth_scale(DepthFormat format) {
  return format == DepthFormat::float32 ? 1.0 : static_cast<double>(largest_code(format));
}

std::uint32_t stored_depth(const DepthOptions& options, double z) {
  const double unit = std::clamp(unit_depth(options, std::clamp(z, options.near_z, options.far_z)), 0.0, 1.0);
  if (options.format == DepthFormat::float32) return std::bit_cast<std::uint32_t>(static_cast<float>(unit));
  return static_cast<std::uint32_t>(std::floor(unit * depth_scale(options.format) + 0.5));
}

std::uint32_t depth_key(const DepthOptions& options, std::uint32_t stored) {
  const std::uint32_t key = options.reversed ? largest_code(options.format) - stored : stored;
  return std::min(key, DepthPlane::farthest);
}

std::uint32_t depth_of_key(const DepthOptions& options, std::uint32_t key) {
  const std::uint32_t largest = largest_code(options.format);
  const std::uint32_t distance = key >= DepthPlane::farthest ? largest : std::min(key, largest);
  return options.reversed ? largest - distance : distance;
}

DepthConstants::DepthConstants(const DepthOptions& o)
    : factor(o.reversed ? -o.near_z : o.far_z),
      zero(o.reversed ? o.far_z : o.near_z),
      range(o.far_z - o.near_z),
      scale(depth_scale(o.format)),
      at_infinity(factor / range * scale),
      per_inverse_z(-factor * zero / range * scale),
      equal_wins(o.test == DepthTest::lequal),
      is_linear(o.mapping == DepthMapping::linear),
      is_float(o.format == DepthFormat::float32),
      is_reversed(o.reversed),
      largest(largest_code(o.format)) {
  if (!is_linear && !is_float) {
    constexpr double end = 4294967296.0;
    if (o.near_z * 4096 < end) nearest = static_cast<std::uint32_t>(std::ceil(o.near_z * 4096));
    farthest = static_cast<std::uint32_t>(std::min(std::floor(o.far_z * 4096), end - 1));
  }
  // A little beyond near and far, so that what lies outside is cut after the division, to 0 and `scale`.
  constexpr double little = 1.0 / (1LL << 48);
  low = is_linear ? 1 / o.far_z * (1 - little) : 0;
  high = is_linear ? 1 / o.near_z * (1 + little) : scale;
  linear_scale = is_reversed ? -scale / range : scale / range;
  linear_offset = is_reversed ? o.far_z / range * scale : -o.near_z / range * scale;
  flip = is_reversed ? ~std::uint32_t{0} : 0;
  add = is_reversed ? largest + 1 : 0;
}

std::uint32_t DepthPlane::stored(int x, int y) const { return depth_of_key(options_, keys_[offset(x, y)]); }

std::uint64_t DepthPlane::touched_bytes() const {
  if (is_untouched()) return 0;
  return static_cast<std::uint64_t>(touched_.right - touched_.left + 1) *
         static_cast<std::uint64_t>(touched_.bottom - touched_.top + 1) * sizeof(std::uint32_t);
}

void DepthPlane::clear() {
  for (int y = touched_.top; y <= touched_.bottom; ++y) {
    std::fill_n(keys_.begin() + static_cast<std::ptrdiff_t>(offset(touched_.left, y)),
                touched_.right - touched_.left + 1, empty);
  }
  touched_ = {};
}

void DepthPlane::clear(int x, int y, int width, int height) {
  if (is_untouched()) return;
  x &= Vram::width - 1;
  const auto clear_columns = [this](int row, int begin, int end) {
    const int from = std::max(begin, touched_.left), to = std::min(end, touched_.right + 1);
    if (from < to)
      std::fill_n(keys_.begin() + static_cast<std::ptrdiff_t>(offset(from, row)), to - from, empty);
  };
  for (int i = 0; i < height; ++i) {
    const int row = (y + i) & (Vram::height - 1);
    if (row < touched_.top || row > touched_.bottom) continue;
    clear_columns(row, x, std::min(x + width, Vram::width));
    clear_columns(row, 0, x + width - Vram::width);
  }
}

}  // namespace gpu
