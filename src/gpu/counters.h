#pragma once
// How often each kind of command ran: one increment per primitive, nothing per pixel.

#include <array>
#include <cstdint>

#include "gpu/mode.h"
#include "gpu/primitive.h"

namespace gpu {

struct Counters {
  std::array<std::uint64_t, kind_count> primitives{};  ///< by Kind; a polyline counts its segments
  std::uint64_t triangles = 0;                         ///< rasterised: a quad has up to two
  std::uint64_t discarded = 0;                         ///< triangles and segments refused by the size rule
  std::uint64_t words = 0;                             ///< GP0 words taken
  std::array<std::uint64_t, Mode::count> kernels{};    ///< by Mode::index(): triangles and rectangles drawn
  std::uint64_t drawn_in_order = 0;  ///< of these, one pixel at a time: they sample what they draw

  [[nodiscard]] std::uint64_t of(Kind kind) const { return primitives[static_cast<std::size_t>(kind)]; }
};

}  // namespace gpu
