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

/// A coordinate as packets hold it, and what it leaves over: whole + rest / 8 counts texels, texel i having
/// its middle at i. The console rounds to the nearest whole texel, and knows no rest.
struct TexelCoordinate {
  std::uint8_t whole = 0;
  std::int8_t rest = 0;  ///< eighths, -8..7
  bool operator==(const TexelCoordinate&) const = default;
};
/// The rest that brings `whole` as near to `exact` as eighths can.
[[nodiscard]] std::int8_t texel_rest(double exact, int whole);

/// One axis of a stored texture.
struct TexelAxis {
  int texels = 1;         ///< one period
  int origin = 0;         ///< its first texel, counted from the page: 0..255
  bool windowed = false;  ///< repeats by the texture window; otherwise coordinates beyond 0..1 need splitting
  bool repeats = false;   ///< coordinates outside 0..1 wrap; otherwise they are clamped

  /// Whole periods that a polygon may span: what 8-bit coordinates can hold.
  [[nodiscard]] int periods() const { return windowed && texels < 128 ? 255 / texels : 1; }
  /// Of `t` (0..1 is one period) for a polygon whose smallest t has the whole part `base`. The left edge of
  /// texel i of N is at t = i / N: u = t N - 1/2, as near to it as a whole number can be. `is_one`: the
  /// polygon spans no more than one picture, and its edge must not show the next one's first texel.
  [[nodiscard]] TexelCoordinate coordinate(double t, double base, bool is_one) const;
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
