#pragma once
// How the 24 link bits of a tag find a word of memory: byte addresses, of which bits 0-1 are ignored, those
// below bit 23 are mirrored into a smaller RAM, and bit 23 is outside RAM. [docs/hardware.md#linked-list-dma]

#include <cstddef>
#include <cstdint>

namespace ot::links {

inline constexpr std::uint32_t unit = 4;  ///< link units per word

/// `words`, the size of the memory, is a power of two.
constexpr std::size_t index(std::uint32_t link, std::size_t words) { return (link >> 2) & (words - 1); }
constexpr bool is_outside(std::uint32_t link) { return (link & 0x800000) != 0; }

}  // namespace ot::links
