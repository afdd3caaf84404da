#pragma once
// Colours become the console's: 15-bit halfwords, and tables of 16 or 256 of them.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/world.h"

namespace scene {

/// A texel halfword: 5 bits a channel, rounded to nearest; bit 15 set for alpha 1..254. Alpha 0 is 0000h, the
/// one value that is never drawn. Opaque black is not: it becomes 0400h, the darkest colour that is drawn
/// (blue 1 of 31).
[[nodiscard]] std::uint16_t texel_of(Rgba8 colour);

/// A picture as indices into a table of halfwords.
struct Indexed {
  std::vector<std::uint8_t> index;     ///< one per texel
  std::vector<std::uint16_t> palette;  ///< at most the number asked for; no two equal
};

/// Chooses at most `colours` (2..256) halfwords for these texels, and the nearest of them for each. Exact
/// if there are not more different ones. Otherwise 0000h keeps an entry of its own, opaque and
/// semi-transparent texels share the rest (bit 15 of no texel changes), each by variance cut and three
/// rounds of refinement. Integers only.
[[nodiscard]] Indexed quantise(std::span<const std::uint16_t> texels, int colours);

}  // namespace scene
