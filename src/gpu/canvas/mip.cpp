#include "gpu/canvas/mip.h"

#include <algorithm>

#include "gpu/canvas/texel.h"
#include "gpu/texture_page.h"

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

/// Do `a` and the `a_length` after it meet `b` and the `b_length` after it, on a ring of `size` (a power of
/// two) places?
constexpr bool overlap(int a, int a_length, int b, int b_length, int size) {
  return ((b - a) & (size - 1)) < a_length || ((a - b) & (size - 1)) < b_length;
}

constexpr bool overlap(const Area& a, const Area& b) {
  return overlap(a.x, a.width, b.x, b.width, Vram::width) &&
         overlap(a.y, a.height, b.y, b.height, Vram::height);
}

}  // namespace

Pixel fetch(const TextureView& view, TexelFormat format, int u, int v) {
  switch (format) {
    case TexelFormat::clut4:
      return fetch_texel<TexelFormat::clut4>(view, u, v);
    case TexelFormat::clut8:
      return fetch_texel<TexelFormat::clut8>(view, u, v);
    default:
      break;
  }
  return fetch_texel<TexelFormat::direct15>(view, u, v);
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

const MipChain& MipCache::chain(const TextureView& view, const DrawState& state) {
  const auto format = state.texel_format();
  const auto colours = palette_size(format);
  const std::uint32_t key = (state.draw_mode & 0x19f) | state.texture_window << 12;
  const auto found = std::ranges::find_if(chains_, [&](const Entry& entry) {
    return entry.key == key && std::equal(entry.clut.begin(), entry.clut.end(), view.clut);
  });
  if (found != chains_.end()) {
    chains_.splice(chains_.begin(), chains_, found);
  } else {
    if (chains_.size() == most) chains_.pop_back();
    chains_.push_front({key,
                        {view.clut, view.clut + colours},
                        {view.page_x, view.page_y, page_width(format), 256},
                        MipChain(view, format)});
  }
  return chains_.front().chain;
}

void MipCache::forget(const Area& written) {
  std::erase_if(chains_, [&](const Entry& entry) { return overlap(entry.page, written); });
}

std::uint64_t MipCache::bytes() const {
  std::uint64_t total = 0;
  for (const auto& entry : chains_) total += entry.chain.bytes();
  return total;
}

}  // namespace gpu::canvas
