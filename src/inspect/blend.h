#pragma once
// The four semi-transparency modes on whole pixels: what the rasterizer does, for
// pictures of what it should have done.

#include <algorithm>
#include <cstdint>

#include "gpu/state.h"

namespace inspect {

/// B = `back`, F = `front`, per 5-bit channel; bit 15 is the front's. [psx-spx, Semi Transparency]
inline std::uint16_t blend(gpu::Blend mode, std::uint16_t back, std::uint16_t front) {
  int result = front & 0x8000;
  for (int shift = 0; shift < 15; shift += 5) {
    const int b = back >> shift & 31, f = front >> shift & 31;
    const int mixed = mode == gpu::Blend::average    ? (b + f) >> 1
                      : mode == gpu::Blend::add      ? std::min(31, b + f)
                      : mode == gpu::Blend::subtract ? std::max(0, b - f)
                                                     : std::min(31, b + (f >> 2));
    result |= mixed << shift;
  }
  return static_cast<std::uint16_t>(result);
}

}  // namespace inspect
