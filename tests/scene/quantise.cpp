#include "scene/quantise.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using scene::quantise;
using scene::texel_of;

TEST_SUITE("scene") {
  TEST_CASE("a colour is rounded to the nearest of 32 steps a channel") {
    CHECK(texel_of({255, 0, 0, 255}) == 31);
    CHECK(texel_of({0, 255, 0, 255}) == 31 << 5);
    CHECK(texel_of({0, 0, 4, 255}) == 0x0400);   // 0.49 of a step, and black: see below
    CHECK(texel_of({0, 0, 5, 255}) == 1 << 10);  // 0.61 of a step
    CHECK(texel_of({8, 8, 8, 255}) == (1 | 1 << 5 | 1 << 10));
  }

  TEST_CASE("alpha 0 is 0000h, the texel that is never drawn, whatever its colour") {
    CHECK(texel_of({255, 255, 255, 0}) == 0);
  }

  TEST_CASE("alpha below 255 sets bit 15") {
    CHECK(texel_of({255, 255, 255, 254}) == 0xffff);
    CHECK(texel_of({0, 0, 0, 1}) == 0x8000);
  }

  TEST_CASE("opaque black is drawn: it does not become 0000h") { CHECK(texel_of({0, 0, 0, 255}) == 0x0400); }

  TEST_CASE("no colour but transparent ones becomes 0000h") {
    for (int v = 0; v < 256 * 256; ++v) {
      const auto c = static_cast<std::uint8_t>(v);
      CHECK_FALSE(texel_of({c, static_cast<std::uint8_t>(v >> 8), c, 255}) == 0);
    }
  }

  TEST_CASE("a picture with few colours keeps them exactly") {
    const std::vector<std::uint16_t> texels{0x7fff, 0x0400, 0x0000, 0x801f, 0x7fff, 0x0000};
    const auto q = quantise(texels, 16);
    CHECK(q.palette.size() == 4);
    for (std::size_t i = 0; i < texels.size(); ++i) CHECK(q.palette[q.index[i]] == texels[i]);
  }

  TEST_CASE("a picture with too many colours keeps holes, and bit 15 of every texel") {
    std::vector<std::uint16_t> texels;
    for (std::uint32_t i = 0; i < 4096; ++i)
      texels.push_back(static_cast<std::uint16_t>(i % 7 == 0 ? 0 : (i * 2654435761U >> 16) | 1));
    for (const int colours : {2, 3, 16, 256}) {
      CAPTURE(colours);
      const auto q = quantise(texels, std::max(colours, 3));
      CHECK(q.palette.size() <= static_cast<std::size_t>(std::max(colours, 3)));
      bool all_keep = true;
      for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto found = q.palette[q.index[i]];
        all_keep = all_keep && (found == 0) == (texels[i] == 0) && (found & 0x8000) == (texels[i] & 0x8000);
      }
      CHECK(all_keep);
    }
  }

  TEST_CASE("every texel gets the nearest colour of the table, and the table fits a smooth ramp") {
    std::vector<std::uint16_t> texels;
    for (std::uint32_t i = 0; i < 32 * 32; ++i) texels.push_back(static_cast<std::uint16_t>(i | 1 << 10));
    const auto q = quantise(texels, 256);
    int worst = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const auto found = q.palette[q.index[i]];
      const int dr = (found & 31) - (texels[i] & 31);
      const int dg = (found >> 5 & 31) - (texels[i] >> 5 & 31);
      worst = std::max(worst, dr * dr + dg * dg);
    }
    CHECK(worst <= 4);  // 1024 colours on a plane, 256 entries: cells of 2 x 2, none farther than 2 steps
  }

  TEST_CASE("the table has no entry twice") {
    std::vector<std::uint16_t> texels;
    for (std::uint32_t i = 1; i < 3000; ++i) texels.push_back(static_cast<std::uint16_t>(i * 11));
    const auto q = quantise(texels, 256);
    CHECK(std::set(q.palette.begin(), q.palette.end()).size() == q.palette.size());
  }
}
