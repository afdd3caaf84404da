#pragma once
// The console's video memory: 1024 x 512 halfwords, one block. Pictures, textures and palettes share it.
//   15-bit pixel: bits 0-4 red, 5-9 green, 10-14 blue; bit 15 is the mask bit of a frame buffer and the
//   semi-transparency flag of a texel.
// Not modelled: the second megabyte of arcade boards.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

namespace gpu {

/// Memory that begins a line of the caches: a vector at a multiple of its length then lies in one line, not
/// in two.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};

  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {
  }  // NOLINT(google-explicit-constructor): what allocators have to offer
  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), line));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, line); }
  bool operator==(const LineAllocator&) const = default;
};

class Vram {
 public:
  static constexpr int width = 1024, height = 512;
  static constexpr std::size_t size = std::size_t{width} * height;

  /// All zero.
  Vram() : pixels_(size + padding) {}

  /// The pixel at x, y; both wrap, negative ones too. [docs/hardware.md#vram]
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
  std::vector<std::uint16_t, LineAllocator<std::uint16_t>> pixels_;
};

}  // namespace gpu
