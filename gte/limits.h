#pragma once
// The limits of the coprocessor's adders and registers, and the FLAG bits that record when one was met. Names
// are those of the sums they guard: mac1..mac3 have 44 bits, mac0 and the registers fewer.

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "gte/registers.h"

namespace gte {

/// The FLAG of the command that is running. Bits are only added; finish() makes bit 31.
struct Limits {
  std::uint32_t bits = 0;

  [[nodiscard]] std::uint32_t finish() const { return flag::with_error(bits); }

  /// A running sum of MAC1..3, `component` 1..3: beyond 44 bits it says so and wraps, and the wrapped sum
  /// goes on into the next addition. [docs/hardware.md#44-bit-accumulators]
  std::int64_t mac(int component, std::int64_t sum) {
    constexpr std::int64_t limit = std::int64_t{1} << 43;
    if (sum >= limit) [[unlikely]] {
      bits |= flag::mac1_positive >> (component - 1);
    } else if (sum < -limit) [[unlikely]] {
      bits |= flag::mac1_negative >> (component - 1);
    }
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) << 20) >> 20;
  }

  /// The exact value of MAC0; only its low 32 bits are kept, only FLAG knows of the rest.
  std::int32_t mac0(std::int64_t sum) {
    const auto kept = static_cast<std::int32_t>(sum);
    if (kept != sum) [[unlikely]]
      bits |= sum > 0 ? flag::mac0_positive : flag::mac0_negative;
    return kept;
  }

  /// MAC1..3 into IR1..3: `lowest` is 0 where the command says lm, else -8000h.
  std::int16_t ir(int component, std::int32_t mac_value, std::int32_t lowest) {
    const std::int32_t raised = mac_value < lowest ? lowest : mac_value;
    const std::int32_t kept = raised > 0x7fff ? 0x7fff : raised;
    bits |= static_cast<std::uint32_t>(kept != mac_value) * (flag::ir1_saturated >> (component - 1));
    return static_cast<std::int16_t>(kept);
  }

  std::uint16_t depth(std::int64_t z) {
    return limited<std::uint16_t>(z, 0, 0xffff, flag::sz3_or_otz_saturated);
  }
  std::int16_t screen_x(std::int64_t x) {
    return limited<std::int16_t>(x, -0x400, 0x3ff, flag::sx2_saturated);
  }
  std::int16_t screen_y(std::int64_t y) {
    return limited<std::int16_t>(y, -0x400, 0x3ff, flag::sy2_saturated);
  }
  std::int16_t ir0(std::int64_t p) { return limited<std::int16_t>(p, 0, 0x1000, flag::ir0_saturated); }

  /// A colour: MACi >> 4, toward minus infinity. `component` 1..3: r, g, b. [docs/hardware.md#colour-fifo]
  std::uint8_t colour(int component, std::int32_t mac_value) {
    return limited<std::uint8_t>(mac_value >> 4, 0, 0xff, flag::red_saturated >> (component - 1));
  }

 private:
  /// The usual case, nothing lost, is one comparison; which way it goes changes seldom in a scene.
  template <class To, class From>
  To limited(From value, std::type_identity_t<From> lowest, std::type_identity_t<From> highest,
             std::uint32_t bit) {
    using Unsigned = std::make_unsigned_t<From>;
    if (static_cast<Unsigned>(value) - static_cast<Unsigned>(lowest) <=
        static_cast<Unsigned>(highest) - static_cast<Unsigned>(lowest)) [[likely]] {
      return static_cast<To>(value);
    }
    bits |= bit;
    return static_cast<To>(value < lowest ? lowest : highest);
  }
};

}  // namespace gte
