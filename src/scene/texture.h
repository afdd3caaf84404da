#pragma once
// Pictures of any size become textures in VRAM: scaled to 256 x 256 texels at most, quantised, and packed
// into the space that the frame buffers leave.
//
//     x 0        W                  1023
//       +--------+---------------------+ 0      W x 480: frame buffers of the display mode
//       | frame  | textures: a grid of |        rows 480..511 below them: colour tables
//       | buffers| cells of 16 x 8     |        the rest: textures, none across y = 256 (a page is 256 rows)
//       +--------+ halfwords           |
//       | tables |                     |
//       +--------+---------------------+ 511
//
// Not modelled: packing that depends on which textures are seen together; everything is resident.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ot/packet.h"
#include "scene/world.h"

namespace scene {

/// One axis of a stored texture.
struct TexelAxis {
  int texels = 1;         ///< one period
  int origin = 0;         ///< its first texel, counted from the page: 0..255
  bool windowed = false;  ///< repeats by the texture window; otherwise coordinates beyond 0..1 need splitting
  bool repeats = false;   ///< coordinates outside 0..1 wrap; otherwise they are clamped

  /// Whole periods that a polygon may span: what 8-bit coordinates can hold.
  [[nodiscard]] int periods() const { return windowed && texels < 128 ? 255 / texels : 1; }
  /// 8-bit coordinate of `t` (0..1 is one period) for a polygon whose smallest t has the whole part `base`.
  [[nodiscard]] std::uint8_t coordinate(double t, double base) const;
};

struct StoredTexture {
  std::uint16_t texpage = 0;  ///< blend mode 0
  std::uint16_t clut = 0;
  TexelAxis u, v;
  std::uint32_t window = ot::gp0::texture_window::make(0);  ///< E2h word
};

/// A rectangle of VRAM and what to put there.
struct VramBlock {
  ot::Upload area;
  std::vector<std::uint16_t> halfwords;  ///< area.width * area.height
};

struct TexturePack {
  std::vector<StoredTexture> textures;  ///< one for each texture given, in order
  std::vector<VramBlock> blocks;
  std::vector<std::string> report;  ///< one line for each texture that is stored smaller than it was
  bool uses_windows = false;
};

/// A texture at most 256 x 256: each side that is longer is scaled down by exact area averages
/// (alpha-weighted), to 256. `halvings` halves it that many times more, down to 1 texel.
[[nodiscard]] Texture scaled(const Texture& texture, int halvings);

/// Packs all textures beside frame buffers of `width` pixels (256, 320, 368, 512 or 640). While
/// they do not fit, the largest is halved. Any number and size of textures; a picture without
/// pixels becomes one white texel.
[[nodiscard]] TexturePack pack_textures(std::span<const Texture> textures, int width);

}  // namespace scene
