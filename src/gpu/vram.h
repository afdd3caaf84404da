#pragma once
// The console's video memory: 1024 x 512 halfwords, one block. Pictures, textures and palettes share it.
//   15-bit pixel: bits 0-4 red, 5-9 green, 10-14 blue; bit 15 is the mask bit of a frame buffer and the
//   semi-transparency flag of a texel.
// Not modelled: the second megabyte of arcade boards.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gpu {

class Vram {
 public:
  static constexpr int width = 1024, height = 512;
  static constexpr std::size_t size = std::size_t{width} * height;

  /// All zero.
  Vram() : pixels_(size + padding) {}

  /// The pixel at x, y; both wrap, negative ones too. [psx-spx, VRAM addressing]
  [[nodiscard]] std::uint16_t& at(int x, int y) { return pixels_[offset(x, y)]; }
  [[nodiscard]] std::uint16_t at(int x, int y) const { return pixels_[offset(x, y)]; }

  /// Row by row from the top, 1024 pixels a row.
  [[nodiscard]] std::span<std::uint16_t> pixels() { return {pixels_.data(), size}; }
  [[nodiscard]] std::span<const std::uint16_t> pixels() const { return {pixels_.data(), size}; }

  [[nodiscard]] static constexpr std::size_t offset(int x, int y) {
    return (static_cast<std::size_t>(y) & (height - 1)) * width + (static_cast<std::size_t>(x) & (width - 1));
  }

  /// Readable and writable halfwords behind the last pixel: a vector that starts on a pixel may end here.
  /// What they hold is nobody's.
  static constexpr std::size_t padding = 64;

 private:
  std::vector<std::uint16_t> pixels_;
};

}  // namespace gpu
