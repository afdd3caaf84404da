#pragma once
// What a span kernel is specialised on. Everything else a primitive may ask for (texture window, mask bits,
// the pass of a z-buffered frame) costs an instruction or two and is data.

#include <array>
#include <cstddef>
#include <cstdint>

#include "ot/gp0.h"

namespace gpu {

using ot::Blend, ot::TexelFormat;

enum class Shade : std::uint8_t {
  flat,     ///< one colour; of a texture: texel times colour
  gouraud,  ///< interpolated colour
  raw,      ///< the texel as it is; textures only
};

/// The pixel's colour before it meets VRAM. Only combinations that the console can ask for are in `surfaces`.
struct SurfaceMode {
  TexelFormat texture;
  Shade shade;
  bool dither;
  bool operator==(const SurfaceMode&) const = default;
};

struct Mode {
  SurfaceMode surface;
  Blend blend;
  bool masked;  ///< pixels with bit 15 stay; asked of opaque kernels only, the others read the pixel anyway
  bool depth;   ///< tested against the depth plane and stored there

  bool operator==(const Mode&) const = default;
  [[nodiscard]] constexpr bool reads_target() const { return masked || blend != Blend::opaque; }

  static constexpr std::array<SurfaceMode, 18> surfaces = [] {
    std::array<SurfaceMode, 18> all{};
    std::size_t n = 0;
    for (const TexelFormat t :
         {TexelFormat::none, TexelFormat::clut4, TexelFormat::clut8, TexelFormat::direct15}) {
      const bool textured = t != TexelFormat::none;
      all[n++] = {t, Shade::flat, false};
      if (textured) all[n++] = {t, Shade::flat, true};
      all[n++] = {t, Shade::gouraud, false};
      all[n++] = {t, Shade::gouraud, true};
      if (textured) all[n++] = {t, Shade::raw, false};
    }
    return all;
  }();
  static constexpr std::size_t writes = 6;  ///< opaque, opaque and masked, blended in four ways
  static constexpr std::size_t count = surfaces.size() * writes * 2;

  static constexpr Mode at(std::size_t index) {
    const std::size_t write = index / 2 % writes;
    return {surfaces[index / 2 / writes], write < 2 ? Blend::opaque : static_cast<Blend>(write - 1),
            write == 1, index % 2 != 0};
  }

  [[nodiscard]] constexpr std::size_t index() const {
    // The order of `surfaces`: 3 without a texture, then 5 for each kind of texture.
    const auto dithered = static_cast<std::size_t>(surface.dither);
    const auto texture = static_cast<std::size_t>(surface.texture);
    const std::size_t place = texture == 0 ? static_cast<std::size_t>(surface.shade) + dithered
                              : surface.shade == Shade::raw
                                  ? 5 * texture + 2
                                  : 5 * texture - 2 + 2 * static_cast<std::size_t>(surface.shade) + dithered;
    const std::size_t write =
        blend == Blend::opaque ? static_cast<std::size_t>(masked) : static_cast<std::size_t>(blend) + 1;
    return (place * writes + write) * 2 + static_cast<std::size_t>(depth);
  }
};

static_assert([] {
  for (std::size_t i = 0; i < Mode::count; ++i) {
    if (Mode::at(i).index() != i) return false;
  }
  return true;
}());

}  // namespace gpu
