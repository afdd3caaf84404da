#include "gpu/canvas/mip.h"

#include <algorithm>

#include "gpu/canvas/texel.h"

namespace gpu::canvas {
namespace {

/// Mean of the solid texels among four, halves up.
Pixel mean(const std::array<Pixel, 4>& four) {
  unsigned solid = 0;
  unsigned semi = 0;
  std::array<unsigned, 3> sums{};
  for (const Pixel texel : four) {
    if ((texel & texel_solid) == 0) continue;
    ++solid;
    semi += (texel & texel_semi) != 0 ? 1 : 0;
    for (unsigned c = 0; c < 3; ++c) sums[c] += texel >> (8 * c) & 0xff;
  }
  if (solid < 2) return 0;
  Pixel result = texel_solid | (2 * semi > solid ? texel_semi : 0);
  for (unsigned c = 0; c < 3; ++c) result |= (sums[c] + solid / 2) / solid << (8 * c);
  return result;
}

}  // namespace

Pixel fetch(const TextureView& view, TexelFormat format, int u, int v) {
  switch (format) {
    case TexelFormat::clut4:
      return fetch_texel<Texturing::clut4>(view, u, v);
    case TexelFormat::clut8:
      return fetch_texel<Texturing::clut8>(view, u, v);
    case TexelFormat::direct15:
      break;
  }
  return fetch_texel<Texturing::direct15>(view, u, v);
}

MipChain::MipChain(const TextureView& view, TexelFormat format) {
  std::size_t total = 0;
  for (int level = 0; level < levels; ++level) {
    begins_[static_cast<std::size_t>(level)] = total;
    total += (std::size_t{256} >> level) * (std::size_t{256} >> level);
  }
  texels_.reserve(total);
  for (int v = 0; v < 256; ++v) {
    for (int u = 0; u < 256; ++u) texels_.push_back(fetch(view, format, u, v));
  }
  for (int level = 1; level < levels; ++level) {
    const int size = 256 >> level;
    for (int v = 0; v < size; ++v) {
      for (int u = 0; u < size; ++u) {
        texels_.push_back(mean({at(level - 1, 2 * u, 2 * v), at(level - 1, 2 * u + 1, 2 * v),
                                at(level - 1, 2 * u, 2 * v + 1), at(level - 1, 2 * u + 1, 2 * v + 1)}));
      }
    }
  }
}

const MipChain& MipCache::chain(const TextureView& view, const DrawState& state, std::uint16_t clut_word) {
  const bool paletted = state.texel_format() != TexelFormat::direct15;
  const std::uint64_t key = (state.draw_mode & 0x19f) | std::uint64_t{state.texture_window} << 12 |
                            (paletted ? std::uint64_t{clut_word} << 32 : 0);
  const auto found = std::ranges::find(chains_, key, &Entry::key);
  if (found != chains_.end()) {
    chains_.splice(chains_.begin(), chains_, found);
  } else {
    chains_.push_front({key, MipChain(view, state.texel_format())});
  }
  return chains_.front().chain;
}

std::uint64_t MipCache::bytes() const {
  std::uint64_t total = 0;
  for (const auto& entry : chains_) total += entry.chain.bytes();
  return total;
}

}  // namespace gpu::canvas
