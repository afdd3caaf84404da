#pragma once
// Mip levels of a texture page as one polygon reads it: through its CLUT and its texture window.

#include <array>
#include <cstdint>
#include <list>
#include <vector>

#include "gpu/canvas/brush.h"

namespace gpu::canvas {

/// Levels 0 (256 x 256) to 8 (1 x 1), row by row. A texel of level n is the mean of the solid ones of its
/// four texels of level n - 1; it is solid if at least two of them are, and semi-transparent if most of the
/// solid ones are.
class MipChain {
 public:
  static constexpr int levels = 9;

  MipChain(const TextureView& view, TexelFormat format);

  [[nodiscard]] Pixel at(int level, int u, int v) const {
    const int width = 256 >> level;  // coordinates are taken modulo this
    return texels_[begins_[static_cast<std::size_t>(level)] +
                   static_cast<std::size_t>((v & (width - 1)) * width + (u & (width - 1)))];
  }
  [[nodiscard]] std::uint64_t bytes() const { return texels_.size() * sizeof(Pixel); }

 private:
  std::array<std::size_t, levels> begins_{};
  std::vector<Pixel> texels_;
};

/// A rectangle of VRAM, which wraps at both edges.
struct Area {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The chains of the pages in use, at most `most`. One lives until what it was made from is written to: its
/// page (`forget`); palettes are compared.
class MipCache {
 public:
  static constexpr std::size_t most = 64;

  /// The chain of a page as `view` and `state` read it; stays where it is until the next call.
  const MipChain& chain(const TextureView& view, const DrawState& state);
  /// VRAM was changed inside `written`.
  void forget(const Area& written);
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Entry {
    std::uint32_t key;  // page, format and window
    std::vector<std::uint16_t> clut;
    Area page;
    MipChain chain;
  };
  std::list<Entry> chains_;  // most recently used first; a list, so that chains do not move
};

/// One texel of VRAM through CLUT and window, without filter.
Pixel fetch(const TextureView& view, TexelFormat format, int u, int v);

}  // namespace gpu::canvas
