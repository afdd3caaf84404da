#pragma once
// The unsigned division of RTPS and RTPT: a 257-entry reciprocal table and one Newton-Raphson step.

#include <array>
#include <bit>
#include <cstdint>

namespace gte {

/// T[k] = max(0, ((40000h / (k + 100h)) + 1) / 2 - 101h), k = 0..100h: the reciprocal of 1.k, less 101h.
inline constexpr auto reciprocal_table = [] {
  std::array<std::uint8_t, 257> table{};
  for (int k = 0; k <= 0x100; ++k) {
    const int entry = (0x40000 / (k + 0x100) + 1) / 2 - 0x101;
    table[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(entry < 0 ? 0 : entry);
  }
  return table;
}();

struct Quotient {
  std::uint32_t value = 0;  ///< H / SZ3 as 1.16, 0..1FFFFh
  bool overflow = false;    ///< H >= 2 * SZ3: FLAG bit 17
};

/// The quotient that every RTPS and RTPT multiplies the screen coordinates with.
///     H >= 2*SZ3:  1FFFFh, overflow
///     otherwise    z = leading zeros of SZ3 (of 16);  n = H << z;  d = SZ3 << z
///                  u = T[(d - 7FC0h) >> 7] + 101h
///                  e = (2000080h - d*u) >> 8;  f = (80h + e*u) >> 8
///                  min(1FFFFh, (n*f + 8000h) >> 16)      a limit that no flag tells of
/// The result is within -3..+2 of the rounded quotient. `h` and `sz3` are the registers, unsigned, eye units.
/// [docs/hardware.md#unr-table]
constexpr Quotient divide(std::uint16_t h, std::uint16_t sz3) {
  if (h >= 2u * sz3) return {0x1ffff, true};
  const int zeros = std::countl_zero(sz3);
  const std::uint32_t n = std::uint32_t{h} << zeros;    // < 2*d, so below 1FFFFh
  const std::uint32_t d = std::uint32_t{sz3} << zeros;  // 8000h..FFFFh
  const std::uint32_t u = reciprocal_table[(d - 0x7fc0u) >> 7] + 0x101u;
  const std::uint32_t e = (0x2000080u - d * u) >> 8;
  const std::uint32_t f = (0x80u + e * u) >> 8;
  const std::uint64_t q = (std::uint64_t{n} * f + 0x8000u) >> 16;
  return {static_cast<std::uint32_t>(q < 0x1ffff ? q : 0x1ffff), false};
}

}  // namespace gte
