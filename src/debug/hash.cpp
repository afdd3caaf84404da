#include "debug/hash.h"

#include <array>
#include <bit>

namespace debug {
namespace {

constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 / golden ratio

std::uint64_t mixed(std::uint64_t value) {
  value ^= value >> 32;
  value *= odd;
  return value ^ value >> 29;
}

/// `word(n)`: 8 bytes from 8n on. `rest`: what is left behind the last whole word.
template <class Word>
std::uint64_t hash(std::size_t words, Word&& word, std::uint64_t rest, std::size_t bytes) {
  std::array<std::uint64_t, 4> sums{1, 2, 3, 4};
  for (std::size_t n = 0; n < words; ++n) {
    std::uint64_t& sum = sums[n % 4];
    sum = std::rotl((sum ^ word(n)) * odd, 31);
  }
  std::uint64_t value = mixed(bytes) ^ mixed(rest + odd);
  for (const std::uint64_t sum : sums) value = mixed(value * 31 + sum);
  return value;
}

}  // namespace

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  const auto load = [&](std::size_t from, std::size_t count) {
    std::uint64_t word = 0;
    for (std::size_t n = 0; n < count; ++n)
      word |= std::to_integer<std::uint64_t>(bytes[from + n]) << (8 * n);
    return word;
  };
  const std::size_t words = bytes.size() / 8;
  return hash(
      words, [&](std::size_t n) { return load(8 * n, 8); }, load(8 * words, bytes.size() % 8), bytes.size());
}

std::uint64_t hash_of(std::span<const std::uint16_t> pixels) {
  const auto load = [&](std::size_t from, std::size_t count) {
    std::uint64_t word = 0;
    for (std::size_t n = 0; n < count; ++n) word |= std::uint64_t{pixels[from + n]} << (16 * n);
    return word;
  };
  const std::size_t words = pixels.size() / 4;
  return hash(
      words, [&](std::size_t n) { return load(4 * n, 4); }, load(4 * words, pixels.size() % 4),
      2 * pixels.size());
}

}  // namespace debug
