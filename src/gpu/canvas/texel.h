#pragma once
// Texels: from VRAM by address, format, CLUT and window (6.1), and filtered. Texel i covers u in [i - 1/2, i
// + 1/2): that is how the console's rounding samples, so a bilinear tap at u = i is texel i alone, and
// filters do not shift the picture.
//
// Coordinates are 8.8 fixed point and already inside the primitive's TexelBox up to rounding.

#include <algorithm>
#include <array>

#include "gpu/canvas/brush.h"
#include "gpu/canvas/mip.h"

namespace gpu::canvas {

/// A 15-bit pixel of VRAM in canvas form; `expand` chooses how 5 bits become 8. No flags.
constexpr Pixel widen(std::uint16_t pixel, bool expand) {
  const Pixel r = pixel & 31U;
  const Pixel g = pixel >> 5 & 31U;
  const Pixel b = pixel >> 10 & 31U;
  const Pixel five = r << 3 | g << 11 | b << 19;
  return expand ? five | (five >> 5 & 0x070707U) : five;
}

/// u, v: taken modulo 256. A transparent texel (0000h) is 0.
template <TexelFormat T>
inline Pixel fetch_texel(const TextureView& view, int u, int v) {
  const int su = (u & view.keep_u) | view.set_u;
  const int sv = (v & view.keep_v) | view.set_v;
  const int y = view.page_y + sv;
  std::uint16_t texel = 0;
  if constexpr (T == TexelFormat::clut4) {
    texel = view.clut[view.vram->at(view.page_x + (su >> 2), y) >> 4 * (su & 3) & 15];
  } else if constexpr (T == TexelFormat::clut8) {
    texel = view.clut[view.vram->at(view.page_x + (su >> 1), y) >> 8 * (su & 1) & 255];
  } else {
    texel = view.vram->at(view.page_x + su, y);
  }
  if (texel == 0) return 0;
  return widen(texel, view.expand) | texel_solid | ((texel & 0x8000) != 0 ? texel_semi : 0);
}

/// Nearest texel, with the console's eight-bit wrap.
template <TexelFormat T>
inline Pixel sample_nearest(const TextureView& view, int u, int v) {
  return fetch_texel<T>(view, (u + 128) >> 8 & 255, (v + 128) >> 8 & 255);
}

/// Nearest texel, kept in the box: a picture shows none of its opposite edge.
template <TexelFormat T>
inline Pixel sample_inside(const TextureView& view, const TexelBox& box, int u, int v) {
  return fetch_texel<T>(view, std::clamp((u + 128) >> 8, box.u_min, box.u_max),
                        std::clamp((v + 128) >> 8, box.v_min, box.v_max));
}

/// Two texels mixed byte by byte, `weight` of `b` in 0..256. Flags are dropped.
constexpr Pixel mix(Pixel a, Pixel b, unsigned weight) {
  const Pixel odd =
      ((a & 0xff00ffU) * (256 - weight) + (b & 0xff00ffU) * weight + 0x800080U) >> 8 & 0xff00ffU;
  const Pixel even = ((a >> 8 & 0xffU) * (256 - weight) + (b >> 8 & 0xffU) * weight + 0x80U) & 0xff00U;
  return odd | even;
}

/// Four taps. The nearest one decides whether the result is solid and whether it is semi-transparent, so
/// cut-outs keep the outline that `nearest` gives them; a transparent tap lends the nearest one's colour
/// instead of its own.
inline Pixel bilinear(const std::array<Pixel, 4>& taps, unsigned fu, unsigned fv) {
  const Pixel nearest = taps[(fu >= 128 ? 1U : 0U) + (fv >= 128 ? 2U : 0U)];
  if ((nearest & texel_solid) == 0) return 0;
  const auto colour = [&](std::size_t i) { return (taps[i] & texel_solid) != 0 ? taps[i] : nearest; };
  const Pixel top = mix(colour(0), colour(1), fu);
  const Pixel bottom = mix(colour(2), colour(3), fu);
  return mix(top, bottom, fv) | (nearest & (texel_solid | texel_semi));
}

template <TexelFormat T>
inline Pixel sample_bilinear(const TextureView& view, const TexelBox& box, int u, int v) {
  const int u0 = std::clamp(u >> 8, box.u_min, box.u_max);
  const int v0 = std::clamp(v >> 8, box.v_min, box.v_max);
  const int u1 = std::clamp((u >> 8) + 1, box.u_min, box.u_max);
  const int v1 = std::clamp((v >> 8) + 1, box.v_min, box.v_max);
  return bilinear({fetch_texel<T>(view, u0, v0), fetch_texel<T>(view, u1, v0), fetch_texel<T>(view, u0, v1),
                   fetch_texel<T>(view, u1, v1)},
                  static_cast<unsigned>(u & 255), static_cast<unsigned>(v & 255));
}

/// Bilinear inside one level. The centre of texel j of level n is at u = j * 2^n + (2^n - 1) / 2.
inline Pixel sample_level(const MipChain& mips, const TexelBox& box, int level, int u, int v) {
  const int lu = ((u + 128) >> level) - 128;
  const int lv = ((v + 128) >> level) - 128;
  const auto tap = [level](int at, int low, int high) { return std::clamp(at, low >> level, high >> level); };
  const int u0 = tap(lu >> 8, box.u_min, box.u_max);
  const int u1 = tap((lu >> 8) + 1, box.u_min, box.u_max);
  const int v0 = tap(lv >> 8, box.v_min, box.v_max);
  const int v1 = tap((lv >> 8) + 1, box.v_min, box.v_max);
  return bilinear(
      {mips.at(level, u0, v0), mips.at(level, u1, v0), mips.at(level, u0, v1), mips.at(level, u1, v1)},
      static_cast<unsigned>(lu & 255), static_cast<unsigned>(lv & 255));
}

/// `level` is 8.8; below 0 the texture is magnified.
inline Pixel sample_mips(const MipChain& mips, const TexelBox& box, bool mix_levels, int level, int u,
                         int v) {
  const int clamped = std::clamp(level, 0, box.coarsest_level << 8);
  if (!mix_levels) return sample_level(mips, box, (clamped + 128) >> 8, u, v);
  const int fine = clamped >> 8;
  const Pixel near = sample_level(mips, box, fine, u, v);
  const auto weight = static_cast<unsigned>(clamped & 255);
  if (weight == 0 || (near & texel_solid) == 0) return near;
  const Pixel far = sample_level(mips, box, fine + 1, u, v);
  if ((far & texel_solid) == 0) return near;
  return mix(near, far, weight) | (near & (texel_solid | texel_semi));
}

}  // namespace gpu::canvas
