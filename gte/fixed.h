#pragma once
// Fixed point numbers by name. A coprocessor register has no type of its own; the format
// says what its bits are worth.

#include <compare>
#include <concepts>
#include <cstdint>

namespace gte {

/// A signed number of `Frac` fraction bits: value = raw / 2^Frac. Arithmetic of the coprocessor works on
/// `raw`, because every command says itself where it shifts and what it saturates; this type only keeps
/// formats from being mixed up. No conversion is implicit, and no floating point survives to run time except
/// where to_double is written out.
template <std::signed_integral Rep, int Frac>
struct Fixed {
  static_assert(Frac >= 0 && Frac < 63);
  using rep = Rep;
  static constexpr int fraction_bits = Frac;
  static constexpr std::int64_t one = std::int64_t{1} << Frac;  ///< raw value of 1.0; may not fit into Rep

  Rep raw = 0;

  /// A literal, rounded to the nearest raw value, halves away from zero. One that
  /// does not fit does not compile.
  static consteval Fixed of(double value) {
    const double scaled = value * static_cast<double>(one) + (value < 0 ? -0.5 : 0.5);
    const auto rounded = static_cast<std::int64_t>(scaled);
    if (static_cast<Rep>(rounded) != rounded) throw "the literal does not fit into this format";
    return {static_cast<Rep>(rounded)};
  }

  /// The integer part, rounded toward minus infinity, as the coprocessor's own shifts do.
  [[nodiscard]] constexpr Rep floor() const { return static_cast<Rep>(raw >> Frac); }

  /// The value, for display and for measuring error; exact for every format below.
  [[nodiscard]] constexpr double to_double() const {
    return static_cast<double>(raw) / static_cast<double>(one);
  }

  friend constexpr auto operator<=>(const Fixed&, const Fixed&) = default;
};

// sI_F: sign, I integer bits, F fraction bits.
using S3_12 = Fixed<std::int16_t, 12>;   ///< matrix elements, ZSF3/4, IR0: 1.0 = 1000h
using S7_8 = Fixed<std::int16_t, 8>;     ///< DQA: 1.0 = 100h
using S15_16 = Fixed<std::int32_t, 16>;  ///< OFX, OFY: 1.0 = one pixel = 10000h
using S19_12 = Fixed<std::int32_t, 12>;  ///< background colour: 1.0 = 1000h
using S27_4 = Fixed<std::int32_t, 4>;    ///< far colour: FFh << 4 is the brightest
using S7_24 = Fixed<std::int32_t, 24>;   ///< DQB: 1.0 = 1000000h

}  // namespace gte
