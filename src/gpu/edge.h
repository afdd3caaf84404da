#pragma once
// An edge stepped down row by row, without a division.

#include <array>
#include <cstddef>
#include <cstdint>

#include "gpu/columns.h"

namespace gpu {

/// floor(2^32 / height). An edge of slope dx / height then goes wrong by at most 1023 * 511 /
/// 2^32 < 2^-12 pixel, less than the 2^-11 that separate it from the next column; tests/gpu holds
/// it to the exact rule for every slope.
inline constexpr auto reciprocals = [] {
  std::array<std::int64_t, 512> table{};
  for (std::int64_t height = 1; height < 512; ++height) {
    table[static_cast<std::size_t>(height)] = (std::int64_t{1} << 32) / height;
  }
  return table;
}();

/// ceil(x) of an edge, row by row, in 32.32.
struct Edge {
  std::int64_t x, step;
  Edge(Point top, Point bottom)
      : x(std::int64_t{top.x} * (std::int64_t{1} << 32) + (std::int64_t{1} << 32) - (std::int64_t{1} << 21)),
        step((bottom.x - top.x) * reciprocals[static_cast<std::size_t>(bottom.y - top.y)]) {}
  [[nodiscard]] int column() const { return static_cast<int>(x >> 32); }
};

}  // namespace gpu
