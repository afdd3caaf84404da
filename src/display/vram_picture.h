#pragma once
// VRAM as it is read: as colours, as indices of a palette, or as the display's packed 24 bits.

#include <array>
#include <cstdint>
#include <span>

#include "base/picture.h"

namespace display {

enum class VramFormat : std::uint8_t { bits15, bits8, bits4, bits24 };
inline constexpr std::array vram_format_names{"15 bits", "8 bits, CLUT", "4 bits, CLUT", "24 bits"};

/// Where a palette begins in VRAM; x is a multiple of 16.
struct Palette {
  int x = 0, y = 0;
  bool operator==(const Palette&) const = default;
};

/// All of `vram` (1024 x 512 pixels), 512 rows high and, by format, 1024, 2048, 4096 or 682 wide. Indices
/// show the colours of `palette`, whose entries wrap at the right edge. [docs/hardware.md#clut]
[[nodiscard]] base::Picture vram_picture(std::span<const std::uint16_t> vram, VramFormat format,
                                         const Palette& palette);

}  // namespace display
