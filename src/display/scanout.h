#pragma once
// Scan-out: the rectangle of VRAM that the video output shows, as a picture.
//
// Not modelled: the analogue signal (borders, overscan, composite colour), the horizontal and vertical ranges
// in video clocks (a picture is as wide and high as the mode says), and the two fields of an interlaced
// picture, which are shown together.

#include <cstdint>
#include <span>

#include "base/picture.h"
#include "gpu/display.h"

namespace display {

inline constexpr int vram_width = 1024, vram_height = 512;

/// What GP1(03h), (05h) and (08h) select.
struct Area {
  int x = 0, y = 0;  ///< top left, in VRAM pixels; the rows and columns after 511 and 1023 are 0 again
  int width = 320, height = 240;  ///< in pixels of the picture
  bool is_24_bit = false;         ///< three bytes a pixel, packed from x on
  bool is_off = false;            ///< the picture is black
  bool operator==(const Area&) const = default;
};

/// The area that the GPU's display registers select.
[[nodiscard]] Area area_of(const gpu::Display& display);

/// One VRAM pixel. 5 bits become 8 as v << 3 | v >> 2, so that 0 stays 0 and 31
/// becomes 255; bit 15 is not shown.
[[nodiscard]] constexpr base::Rgba expand(std::uint16_t pixel) {
  const auto channel = [pixel](int shift) {
    const unsigned v = (static_cast<unsigned>(pixel) >> shift) & 31U;
    return static_cast<std::uint8_t>(v << 3U | v >> 2U);
  };
  return {channel(0), channel(5), channel(10), 255};
}

/// The picture that `area` of `vram` shows. `vram` holds 1024 x 512 pixels, rows from the top.
/// 24 bit: bytes R, G, B from byte 2x of the row on. [docs/hardware.md#display-area]
[[nodiscard]] base::Picture scan_out(std::span<const std::uint16_t> vram, const Area& area);

/// All of VRAM as 15-bit pixels: 1024 x 512.
[[nodiscard]] base::Picture scan_out_all(std::span<const std::uint16_t> vram);

}  // namespace display
