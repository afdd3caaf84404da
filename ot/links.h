#pragma once
// How the 24 link bits of a tag find a word of memory. Tables and walkers take this as a template parameter.

#include <cstddef>
#include <cstdint>

#include "ot/field.h"

namespace ot {

/// The console's: byte addresses. Bits 0-1 are ignored, addresses below bit 23 are mirrored into a smaller
/// RAM, bit 23 is outside RAM.   [psx-spx, Linked List DMA]
struct ByteLinks {
  static constexpr std::uint32_t unit = 4;  ///< link units per word
  /// `words` is a power of two.
  static constexpr std::size_t index(std::uint32_t link, std::size_t words) {
    return (link >> 2) & (words - 1);
  }
  static constexpr bool is_outside(std::uint32_t link, std::size_t) { return (link & 0x800000) != 0; }
};

/// Word numbers: reaches 64 MiB where the console's bytes end at 8. For tables of a million primitives.
struct WordLinks {
  static constexpr std::uint32_t unit = 1;
  static constexpr std::size_t index(std::uint32_t link, std::size_t) { return link; }
  static constexpr bool is_outside(std::uint32_t link, std::size_t words) { return link >= words; }
};

}  // namespace ot
