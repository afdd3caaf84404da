#pragma once
// Just enough of the dump format to feed a GPU: 16 bytes of magic, then packets
// {bits 0-23 words, 24-31 type}.

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

namespace tests {

inline std::vector<char> read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Replays GP0 (type 0), GP1 (1) and discarded reads (3) into anything with gp0(span), gp1(word) and read().
template <class Gpu>
void replay(const std::filesystem::path& path, Gpu& gpu) {
  const std::vector<char> bytes = read_bytes(path);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  for (std::size_t at = 4; at < words.size();) {
    const std::uint32_t type = words[at] >> 24;
    const auto data = std::span(words).subspan(at + 1, words[at] & 0xffffff);
    at += 1 + data.size();
    if (type == 0) gpu.gp0(std::span<const std::uint32_t>(data));
    if (type == 1) {
      for (const std::uint32_t word : data) gpu.gp1(word);
    }
    if (type == 3) {
      for (std::uint32_t n = data.empty() ? 1 : data[0]; n > 0; --n) gpu.read();
    }
  }
}

}  // namespace tests
