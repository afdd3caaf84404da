#include "gpu/depth.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gpu {

namespace {

constexpr std::uint32_t largest_code(DepthFormat format) {
  switch (format) {
    case DepthFormat::bits16:
      return 0xffff;
    case DepthFormat::bits24:
      return 0xffffff;
    case DepthFormat::bits32:
      return 0xffffffff;
    default:
      return std::bit_cast<std::uint32_t>(1.0F);
  }
}

/// 0 at near, 1 at far; the other way round when reversed, computed so that small
/// results keep their precision.
double unit_depth(const DepthOptions& o, double z) {
  const double range = o.far_z - o.near_z;
  if (o.mapping == DepthMapping::linear) return (o.reversed ? o.far_z - z : z - o.near_z) / range;
  return o.reversed ? o.near_z * (o.far_z - z) / (z * range) : o.far_z * (z - o.near_z) / (z * range);
}

}  // namespace

double depth_scale(DepthFormat format) {
  return format == DepthFormat::float32 ? 1.0 : static_cast<double>(largest_code(format));
}

std::uint32_t stored_depth(const DepthOptions& options, double z) {
  const double unit = std::clamp(unit_depth(options, std::clamp(z, options.near_z, options.far_z)), 0.0, 1.0);
  if (options.format == DepthFormat::float32) return std::bit_cast<std::uint32_t>(static_cast<float>(unit));
  return static_cast<std::uint32_t>(std::floor(unit * depth_scale(options.format) + 0.5));
}

std::uint32_t depth_key(const DepthOptions& options, std::uint32_t stored) {
  return options.reversed ? largest_code(options.format) - stored : stored;
}

std::uint32_t DepthPlane::stored(int x, int y) const {
  const std::uint32_t key = keys_[Vram::offset(x, y)];
  return depth_key(options_, std::min(key, largest_code(options_.format)));
}

void DepthPlane::clear() { std::fill(keys_.begin(), keys_.end(), empty); }

}  // namespace gpu
