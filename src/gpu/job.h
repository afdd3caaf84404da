#pragma once
// What a kernel is handed: the constants of one triangle or rectangle, and the runs of pixels it covers.

#include <array>
#include <cstdint>
#include <span>

#include "gpu/depth.h"
#include "gpu/mode.h"

namespace gpu {

/// A run of pixels in one row, inside VRAM and the drawing area.
struct Span {
  std::int16_t x, y;    ///< the leftmost pixel: y may be 512..1023 and is stored wrapped
  std::int16_t count;   ///< >= 1
  std::int16_t dx, dy;  ///< from the vertex where gradients start to the leftmost pixel
};

/// An attribute that is affine on the screen: 8 bits and 24 of fraction, modulo 2^32.
struct Gradient {
  std::uint32_t start, dx, dy;
  [[nodiscard]] std::uint32_t at(int x, int y) const {
    return start + dx * static_cast<std::uint32_t>(x) + dy * static_cast<std::uint32_t>(y);
  }
};

struct ColourGradients {
  Gradient r, g, b;
};

struct TextureGradients {
  Gradient u, v;
};

struct TexturePage {
  std::uint32_t x = 0, y = 0;                                        ///< VRAM position of texel 0, 0
  std::uint32_t keep_u = 0xff, keep_v = 0xff, set_u = 0, set_v = 0;  ///< texture window
  /// u advances by exactly one texel a pixel and v stays, nothing wraps in the page: texels lie side by side.
  bool side_by_side = false;
};

/// A depth key that is affine on the screen, unsigned 32.32 and modulo 2^64, one half added: the key is the
/// high word. For whoever needs neither a limit nor a division per pixel.
struct FixedDepth {
  std::uint64_t start, dx, dy;
  [[nodiscard]] std::uint64_t at(int x, int y) const {
    return start + dx * static_cast<std::uint64_t>(x) + dy * static_cast<std::uint64_t>(y);
  }
};

/// Depth of a triangle. With e[i] the doubled area opposite vertex i, the affine quantity is
/// sum(e[i] * weight[i]): the depth itself (hyperbolic) or 1/z (linear). All three are of one
/// sign inside, so nothing cancels.
struct DepthJob {
  std::uint32_t* keys;
  const DepthConstants* constants;
  FixedDepth fixed;  ///< is_fixed; otherwise 0, and what follows up to `slope` counts
  std::array<double, 3> weight, edge_start, edge_dx, edge_dy;  ///< edges relative to the gradients' vertex
  double slope;                                                ///< of the affine quantity along a row
  bool is_fixed, writes;
  std::uint16_t texel_mask, texel_value;  ///< only texels t with (t & mask) == value are drawn in this pass
};

struct Job {
  std::uint16_t* pixels;              ///< of VRAM
  const std::uint16_t* clut;          ///< 256 entries and padding
  std::uint16_t colour;               ///< flat, untextured: the pixel
  std::uint16_t mask_set, mask_test;  ///< bit 15 or 0
  std::uint8_t r, g, b;               ///< flat, textured
  TexturePage page;
  TextureGradients texel;
  ColourGradients shade;
  DepthJob depth;
};

}  // namespace gpu
