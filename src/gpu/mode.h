#pragma once
// What a span kernel is specialised on. Everything else a primitive may ask for (texture window, mask bits,
// the pass of a z-buffered frame) costs an instruction or two and is data.

#include <array>
#include <cstddef>
#include <cstdint>

namespace gpu {

enum class Texture : std::uint8_t { none, clut4, clut8, direct15 };

enum class Shade : std::uint8_t {
  flat,     ///< one colour; of a texture: texel times colour
  gouraud,  ///< interpolated colour
  raw,      ///< the texel as it is; textures only
};

/// How a pixel gets into VRAM; the first never reads what is there.
enum class Write : std::uint8_t {
  opaque,
  masked,  ///< opaque, but pixels with bit 15 stay
  average,
  add,
  subtract,
  add_quarter,
};

/// The pixel's colour before it meets VRAM. Only combinations that the console can ask for are in `surfaces`.
struct SurfaceMode {
  Texture texture;
  Shade shade;
  bool dither;
  bool operator==(const SurfaceMode&) const = default;
};

struct Mode {
  SurfaceMode surface;
  Write write;
  bool depth;  ///< tested against the depth plane and stored there

  bool operator==(const Mode&) const = default;

  static constexpr std::array<SurfaceMode, 18> surfaces = [] {
    std::array<SurfaceMode, 18> all{};
    std::size_t n = 0;
    for (const Texture t : {Texture::none, Texture::clut4, Texture::clut8, Texture::direct15}) {
      const bool textured = t != Texture::none;
      all[n++] = {t, Shade::flat, false};
      if (textured) all[n++] = {t, Shade::flat, true};
      all[n++] = {t, Shade::gouraud, false};
      all[n++] = {t, Shade::gouraud, true};
      if (textured) all[n++] = {t, Shade::raw, false};
    }
    return all;
  }();
  static constexpr std::size_t writes = 6;
  static constexpr std::size_t count = surfaces.size() * writes * 2;

  static constexpr Mode at(std::size_t index) {
    return {surfaces[index / 2 / writes], static_cast<Write>(index / 2 % writes), index % 2 != 0};
  }

  [[nodiscard]] constexpr std::size_t index() const {
    // The order of `surfaces`: 3 without a texture, then 5 for each kind of texture.
    const auto dithered = static_cast<std::size_t>(surface.dither);
    const auto texture = static_cast<std::size_t>(surface.texture);
    const std::size_t place = texture == 0 ? static_cast<std::size_t>(surface.shade) + dithered
                              : surface.shade == Shade::raw
                                  ? 5 * texture + 2
                                  : 5 * texture - 2 + 2 * static_cast<std::size_t>(surface.shade) + dithered;
    return (place * writes + static_cast<std::size_t>(write)) * 2 + static_cast<std::size_t>(depth);
  }
};

static_assert([] {
  for (std::size_t i = 0; i < Mode::count; ++i) {
    if (Mode::at(i).index() != i) return false;
  }
  return true;
}());

}  // namespace gpu
