#include "display/vram_picture.h"

#include "display/scanout.h"

namespace display {
namespace {

base::Picture indices(std::span<const std::uint16_t> vram, int bits, const Palette& palette) {
  const int each = 16 / bits;
  const unsigned mask = (1U << static_cast<unsigned>(bits)) - 1;
  base::Picture picture(vram_width * each, vram_height);
  const auto row = static_cast<std::size_t>(palette.y & (vram_height - 1)) * vram_width;
  for (int y = 0; y < vram_height; ++y) {
    for (int x = 0; x < vram_width; ++x) {
      const unsigned word = vram[static_cast<std::size_t>(y * vram_width + x)];
      for (int n = 0; n < each; ++n) {
        const unsigned index = word >> static_cast<unsigned>(n * bits) & mask;
        const auto entry = static_cast<std::size_t>(palette.x + static_cast<int>(index)) & (vram_width - 1);
        picture.at(x * each + n, y) = expand(vram[row + entry]);
      }
    }
  }
  return picture;
}

}  // namespace

base::Picture vram_picture(std::span<const std::uint16_t> vram, VramFormat format, const Palette& palette) {
  switch (format) {
    case VramFormat::bits15:
      return scan_out_all(vram);
    case VramFormat::bits8:
      return indices(vram, 8, palette);
    case VramFormat::bits4:
      return indices(vram, 4, palette);
    case VramFormat::bits24:
      return scan_out(
          vram, {.x = 0, .y = 0, .width = vram_width * 2 / 3, .height = vram_height, .is_24_bit = true});
  }
  return {};
}

}  // namespace display
