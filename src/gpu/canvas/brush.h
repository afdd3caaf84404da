#pragma once
// What a kernel needs to know of the primitive it draws and of the picture it draws
// into. Set up once per primitive.

#include <array>
#include <cstdint>
#include <span>

#include "gpu/canvas/options.h"
#include "gpu/canvas/samples.h"
#include "gpu/state.h"
#include "gpu/vram.h"
#include "gpu/watch.h"

namespace gpu::canvas {

/// A canvas colour or texel: bytes r, g, b from the low end. In a frame bit 24 is the mask bit; in a texel
/// bit 24 says "not transparent" and bit 25 is the semi-transparency flag. 15-bit colours have the low 3 bits
/// of each byte 0.
using Pixel = std::uint32_t;
inline constexpr Pixel mask_bit = 1U << 24;
inline constexpr Pixel texel_solid = 1U << 24, texel_semi = 1U << 25;

/// In the 16 bits of a console pixel.
constexpr std::uint16_t to_16_bits(Pixel p) {
  return static_cast<std::uint16_t>((p >> 3 & 31) | (p >> 11 & 31) << 5 | (p >> 19 & 31) << 10 |
                                    ((p & mask_bit) != 0 ? 0x8000U : 0U));
}

/// What the accurate kernels are specialised on. Everything else is a branch per span.
struct Mode {
  TexelFormat texture = TexelFormat::none;
  Blend blend = Blend::opaque;
  bool depth = false;
  bool trace = false;

  static constexpr std::size_t count = 4 * 5 * 2 * 2;
  [[nodiscard]] constexpr std::size_t index() const {
    return ((static_cast<std::size_t>(texture) * 5 + static_cast<std::size_t>(blend)) * 2 +
            (depth ? 1U : 0U)) *
               2 +
           (trace ? 1U : 0U);
  }
  static constexpr Mode at(std::size_t i) {
    return {static_cast<TexelFormat>(i / 20), static_cast<Blend>(i / 4 % 5), i / 2 % 2 != 0, i % 2 != 0};
  }
};

/// Where a watched canvas notes its writes, and where in VRAM its first pixel stands for.
struct Watch : gpu::Watch {
  int x = 0, y = 0;
};

/// The picture: one layer of a Canvas. Sample s of pixel (x, y) is at (y * width + x) * samples + s.
struct Target {
  Pixel* colour = nullptr;
  std::uint32_t* depth = nullptr;      ///< keys, nearer is smaller; nullptr without a z-buffer
  std::uint32_t* ids = nullptr;        ///< per pixel; nullptr when nobody asked
  std::uint32_t* texcoords = nullptr;  ///< with ids: u + 128 | (v + 128) << 16, 8.8
  const Watch* watch = nullptr;        ///< nullptr when nobody watches
  int width = 0, height = 0;
  Point offset{};                  ///< of the layer
  std::span<const Point> samples;  ///< one or more
};

/// An integer attribute over the canvas as the console interpolates it (5.2, 5.3): 24 fractional bits, times
/// the units of a console pixel, modulo 2^64. All arithmetic wraps on purpose: the eight bits read from it
/// are right because the true value inside a triangle fits.
struct IntegerPlane {
  std::uint64_t core = 0, per_x = 0, per_y = 0;  ///< at the core vertex; per canvas unit
};

/// A real attribute: value at `origin`, change per canvas unit.
struct RealPlane {
  double core = 0, per_x = 0, per_y = 0;
  [[nodiscard]] double at(std::int64_t dx, std::int64_t dy) const {
    return core + per_x * static_cast<double>(dx) + per_y * static_cast<double>(dy);
  }
};

/// Attributes in the order r, g, b, u, v.
struct Planes {
  Point origin{};  ///< the core vertex: planes are relative to it
  int shift = 32;  ///< IntegerPlane to 8.8 fixed point: right by this much, less 8
  std::array<IntegerPlane, 5> integer{};
  std::array<RealPlane, 5> over_z{};  ///< attribute / z, when perspective
  RealPlane inverse_z;                ///< 1 / z, when the primitive has depth and somebody reads it
};

class MipChain;

/// Fog ready for the pixel loop: f = constant + slope / z, limited to 0..1.
struct FogRamp {
  std::array<int, 3> colour{};
  double constant = 0, slope = 0;
};

/// The texels of one primitive: taps of a filter stay inside, so what lies beside
/// them in the page does not bleed.
struct TexelBox {
  int u_min = 0, u_max = 255, v_min = 0, v_max = 255;  ///< texels; of pictures that repeat one more each way
  int u_low = 0, u_high = 255 * 256, v_low = 0, v_high = 255 * 256;  ///< coordinates, 8.8
  int coarsest_level = 0;  ///< one texel of the next level would be larger than the box
};

struct TextureView {
  const Vram* vram = nullptr;
  const std::uint16_t* clut = nullptr;  ///< 16 or 256 entries
  int page_x = 0, page_y = 0;
  std::uint8_t keep_u = 255, keep_v = 255, set_u = 0, set_v = 0;
  bool expand = false;  ///< 5 bits to 8 as v << 3 | v >> 2 (24-bit colour), else v << 3
};

struct Paint {
  Mode mode;
  TextureView texture;
  TexelBox box;
  const MipChain* mips = nullptr;
  Filter filter = Filter::nearest;
  int level_bias = 0;     ///< 8.8, added to the mip level
  bool is_exact = false;  ///< corners have rests: coordinates in eighths, and nearest texels kept in the box
  bool raw = false;       ///< the texel is used unchanged
  bool gouraud = false;
  bool perspective = false;
  bool dither = false;
  bool mask_test = false;
  Pixel mask_set = 0;         ///< 0 or mask_bit
  Pixel quantise = 0xf8f8f8;  ///< or ffffff in 24-bit colour
  Pass pass = Pass::console;
  const DepthConstants* depth = nullptr;
  const FogRamp* fog = nullptr;
  int phase_x = 0, phase_y = 0;  ///< of the dither pattern: the canvas pixel 0, 0 in VRAM, times the scale
  std::uint32_t id = 0;
};

}  // namespace gpu::canvas
