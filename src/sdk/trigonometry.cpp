// Sines by a polynomial of the fourth order, and square roots: what programs get on the console, to the bit.

#include <cstdint>

#include "sdk/include/psxgte.h"

namespace {

/// sin(a) in 1.3.12; a quarter of a turn is 2^quarter. cos(x) is about 1 - x^2 * (c1 - c2 * x^2), x in
/// quarters.
int sine(int a, int quarter) {
  constexpr int c1 = 19900, c2 = 3516;
  const auto shift = [](int value, int by) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(value) << by);
  };
  const int sign = shift(a, 30 - quarter);  // bit 31: the half of the turn where the sine is negative
  const auto from_peak = static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - (1U << quarter));
  const int x = shift(from_peak, 31 - quarter) >> (31 - quarter);
  const int squared = (x * x) >> (2 * quarter - 14);
  const int y = ONE - ((squared * (c1 - ((squared * c2) >> 14))) >> 16);
  return sign >= 0 ? y : -y;
}

/// The largest integer whose square is not above `value`.
std::uint32_t root(std::uint64_t value) {
  std::uint64_t found = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 31; bit != 0; bit >>= 1) {
    if ((found | bit) * (found | bit) <= value) found |= bit;
  }
  return static_cast<std::uint32_t>(found);
}

int add(int a, int b) {
  return static_cast<int>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

}  // namespace

extern "C" {

int isin(int a) { return sine(a, 10); }
int icos(int a) { return sine(add(a, 1 << 10), 10); }
int hisin(int a) { return sine(a, 15); }
int hicos(int a) { return sine(add(a, 1 << 15), 15); }

int SquareRoot0(int v) { return v <= 0 ? 0 : static_cast<int>(root(static_cast<std::uint64_t>(v))); }
int SquareRoot12(int v) { return v <= 0 ? 0 : static_cast<int>(root(static_cast<std::uint64_t>(v) << 12)); }

}  // extern "C"
