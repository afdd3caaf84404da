#pragma once
// One name packs and unpacks a bit-field, so that the writer and the reader of a word cannot disagree.

#include <cstdint>

namespace ot {

/// Bits lo .. lo+width-1 of a 32-bit word.
///     Field<24, 8>::put(4) == 04000000h        Field<24, 8>::get(04123456h) == 4
/// `put` keeps the low `width` bits of the value, as storing into a register would.
template <int lo, int width>
struct Field {
  static_assert(lo >= 0 && width > 0 && lo + width <= 32);
  static constexpr std::uint32_t max = ~std::uint32_t{0} >> (32 - width);  ///< the largest value it holds
  static constexpr std::uint32_t mask = max << lo;                         ///< the bits it takes in the word

  static constexpr std::uint32_t get(std::uint32_t word) { return (word >> lo) & max; }
  static constexpr std::uint32_t put(std::uint32_t value) { return (value & max) << lo; }

  /// The same bits as a two's complement number.
  static constexpr std::int32_t get_signed(std::uint32_t word) {
    constexpr std::uint32_t sign = std::uint32_t{1} << (width - 1);
    return static_cast<std::int32_t>((get(word) ^ sign) - sign);
  }
  static constexpr std::uint32_t put_signed(std::int32_t value) {
    return put(static_cast<std::uint32_t>(value));
  }

  /// The word with this field replaced.
  static constexpr std::uint32_t set(std::uint32_t word, std::uint32_t value) {
    return (word & ~mask) | put(value);
  }
};

/// The first word of every packet. [docs/hardware.md#linked-list-dma]
namespace tag {
using Next = Field<0, 24>;    ///< link to the next tag: a byte address in RAM
using Length = Field<24, 8>;  ///< payload words after this tag, 0..255

inline constexpr std::uint32_t end = 0xffffff;  ///< the link that ends a list

constexpr std::uint32_t make(std::uint32_t next, std::uint32_t length) {
  return Next::put(next) | Length::put(length);
}
}  // namespace tag

}  // namespace ot
