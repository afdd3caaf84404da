#include "display/scanout.h"

#include <doctest/doctest.h>

#include <vector>

namespace {

using base::Rgba;

struct Vram {
  std::vector<std::uint16_t> pixels = std::vector<std::uint16_t>(std::size_t{1024} * 512);
  std::uint16_t& at(std::size_t x, std::size_t y) { return pixels[y * 1024 + x]; }
};

}  // namespace

TEST_SUITE("display") {
  TEST_CASE("5 bits become 8 as v << 3 | v >> 2, low bits red") {
    CHECK(display::expand(0x0000) == Rgba{0, 0, 0, 255});
    CHECK(display::expand(0x7fff) == Rgba{255, 255, 255, 255});
    CHECK(display::expand(1) == Rgba{8, 0, 0, 255});          // 1 << 3 | 0
    CHECK(display::expand(4U << 5U) == Rgba{0, 33, 0, 255});  // 4 << 3 | 1
    CHECK(display::expand(16U << 10U) == Rgba{0, 0, 132, 255});
  }

  TEST_CASE("bit 15 of a pixel is not shown") {
    CHECK(display::expand(0x8000 | 0x1234) == display::expand(0x1234));
  }

  TEST_CASE("the picture begins at the display start and is as large as the mode") {
    Vram vram;
    vram.at(10, 20) = 31;
    vram.at(13, 21) = 31U << 5U;
    const auto picture = display::scan_out(vram.pixels, {.x = 10, .y = 20, .width = 4, .height = 2});
    REQUIRE(picture.width == 4);
    REQUIRE(picture.height == 2);
    CHECK(picture.at(0, 0) == Rgba{255, 0, 0, 255});
    CHECK(picture.at(3, 1) == Rgba{0, 255, 0, 255});
    CHECK(picture.at(1, 0) == Rgba{0, 0, 0, 255});
  }

  TEST_CASE("the picture wraps at the right and the lower edge of VRAM") {
    Vram vram;
    vram.at(0, 0) = 31;
    const auto picture = display::scan_out(vram.pixels, {.x = 1023, .y = 511, .width = 2, .height = 2});
    CHECK(picture.at(1, 1) == Rgba{255, 0, 0, 255});
    CHECK(picture.at(0, 0) == Rgba{0, 0, 0, 255});
  }

  TEST_CASE("24-bit mode reads three bytes a pixel, across VRAM pixels") {
    Vram vram;
    vram.at(8, 3) = 0x2211;  // bytes 11 22 | 33 44 | 55 66
    vram.at(9, 3) = 0x4433;
    vram.at(10, 3) = 0x6655;
    const auto picture =
        display::scan_out(vram.pixels, {.x = 8, .y = 3, .width = 2, .height = 1, .is_24_bit = true});
    CHECK(picture.at(0, 0) == Rgba{0x11, 0x22, 0x33, 255});
    CHECK(picture.at(1, 0) == Rgba{0x44, 0x55, 0x66, 255});
  }

  TEST_CASE("24-bit mode wraps inside its row") {
    Vram vram;
    vram.at(1023, 5) = 0x2211;
    vram.at(0, 5) = 0x0033;
    const auto picture =
        display::scan_out(vram.pixels, {.x = 1023, .y = 5, .width = 1, .height = 1, .is_24_bit = true});
    CHECK(picture.at(0, 0) == Rgba{0x11, 0x22, 0x33, 255});
  }

  TEST_CASE("a display that is off is black") {
    Vram vram;
    vram.at(0, 0) = 0x7fff;
    const auto picture = display::scan_out(vram.pixels, {.width = 1, .height = 1, .is_off = true});
    CHECK(picture.at(0, 0) == Rgba{0, 0, 0, 255});
  }

  TEST_CASE("the whole of VRAM is 1024 x 512") {
    Vram vram;
    vram.at(1023, 511) = 31;
    const auto picture = display::scan_out_all(vram.pixels);
    REQUIRE(picture.width == 1024);
    REQUIRE(picture.height == 512);
    CHECK(picture.at(1023, 511) == Rgba{255, 0, 0, 255});
  }
}
