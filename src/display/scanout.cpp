#include "display/scanout.h"

#include <array>
#include <cassert>

namespace display {
namespace {

constexpr auto expanded = [] {
  std::array<base::Rgba, 0x8000> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = expand(static_cast<std::uint16_t>(i));
  return table;
}();

// Byte number `at` of a VRAM row; a row is 2048 bytes and wraps.
std::uint8_t byte_of(std::span<const std::uint16_t> row, unsigned at) {
  const unsigned pixel = row[(at >> 1U) & (vram_width - 1U)];
  return static_cast<std::uint8_t>((at & 1U) != 0 ? pixel >> 8U : pixel);
}

}  // namespace

Area area_of(const gpu::Display& display) {
  return {.x = display.start_x(),
          .y = display.start_y(),
          .width = display.width(),
          .height = display.height(),
          .is_24_bit = display.is_24_bit(),
          .is_off = display.is_off};
}

base::Picture scan_out(std::span<const std::uint16_t> vram, const Area& area) {
  assert(vram.size() == std::size_t{vram_width} * vram_height);
  assert(area.width >= 0 && area.height >= 0);
  base::Picture picture(area.width, area.height);
  if (area.is_off) return picture;
  auto out = picture.pixels.begin();
  for (int y = 0; y < area.height; ++y) {
    const auto wrapped_y = static_cast<unsigned>(area.y + y) & (vram_height - 1U);
    const auto row = vram.subspan(std::size_t{wrapped_y} * vram_width, vram_width);
    for (int x = 0; x < area.width; ++x) {
      if (area.is_24_bit) {
        const auto at = 2U * static_cast<unsigned>(area.x) + 3U * static_cast<unsigned>(x);
        *out++ = {byte_of(row, at), byte_of(row, at + 1), byte_of(row, at + 2), 255};
      } else {
        *out++ = expanded[row[static_cast<unsigned>(area.x + x) & (vram_width - 1U)] & 0x7fffU];
      }
    }
  }
  return picture;
}

base::Picture scan_out_all(std::span<const std::uint16_t> vram) {
  return scan_out(vram, {.x = 0, .y = 0, .width = vram_width, .height = vram_height});
}

}  // namespace display
