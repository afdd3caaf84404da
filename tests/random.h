#pragma once
// The random numbers of all tests that need more than a shuffle.

#include <cstdint>
#include <iterator>

namespace tests {

/// SplitMix64: small, well mixed, and the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(next() >> 32); }
  /// 0..n-1.
  std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>((std::uint64_t{word()} * n) >> 32);
  }
  /// low..high, both included.
  std::int32_t between(std::int32_t low, std::int32_t high) {
    return static_cast<std::int32_t>(
        low + static_cast<std::int64_t>(
                  below(static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low) + 1)));
  }

  /// low..high, evenly.
  double real(double low, double high) { return low + (high - low) * word() / 4294967295.0; }

  /// A 32-bit word of which many are limits of some width, and the rest have any magnitude.
  std::uint32_t hostile_word() {
    static constexpr std::uint32_t limits[] = {0,          1,          0xffffffff, 0x7fffffff, 0x80000000,
                                               0x80000001, 0x7fff,     0x8000,     0xffff8000, 0x7fff7fff,
                                               0x80008000, 0x80007fff, 0x7fff8000, 0x00010000, 0x0000ffff,
                                               0xffff0000, 0x1000,     0xfffff000};
    if (below(3) == 0) return limits[below(std::size(limits))];
    const std::uint32_t w = word();
    return below(2) == 0 ? w : static_cast<std::uint32_t>(static_cast<std::int32_t>(w) >> below(32));
  }

 private:
  std::uint64_t state_;
};

}  // namespace tests
