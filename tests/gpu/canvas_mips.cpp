// Mip levels live as long as what they were made from.

#include <doctest/doctest.h>

#include <algorithm>

#include "canvas_scene.h"

using namespace canvas_test;
namespace canvas = gpu::canvas;

namespace {

constexpr std::uint32_t page_at_512 = 0x108;  // 15-bit texels from (512, 0) on; 4-bit: 0x008
constexpr std::uint32_t clut_at_640_300 = 300U << 6 | 640 / 16;

canvas::Options mipmapped() {
  return {.width = 64, .height = 64, .filter = canvas::Filter::mipmap, .colour = canvas::Colour::bits24};
}

std::vector<std::uint32_t> upload(int x, int y, std::vector<std::uint32_t> pixel_pairs) {
  std::vector<std::uint32_t> words{0xa0000000, vertex_word(0, 0), 0x00010000};
  words[1] = static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 16;
  words[2] |= static_cast<std::uint32_t>(2 * pixel_pairs.size());
  words.insert(words.end(), pixel_pairs.begin(), pixel_pairs.end());
  return words;
}

/// A quad over the canvas that shows the first texels of the page, minified.
std::vector<std::uint32_t> quad(std::uint32_t page, std::uint32_t clut = 0) {
  return polygon(0x2d,
                 {Corner{0, 0, 0, 0, 0}, Corner{2 * 256, 0, 0, 7, 0}, Corner{0, 2 * 256, 0, 0, 7},
                  Corner{2 * 256, 2 * 256, 0, 7, 7}},
                 clut, page);
}

std::uint64_t mip_bytes(const Studio& studio) {
  const auto buffers = studio.canvas.buffers();
  const auto found = std::ranges::find(buffers, "mip levels", &canvas::Buffer::name);
  return found == buffers.end() ? 0 : found->bytes;
}

std::uint32_t shown(const Studio& studio) { return studio.canvas.layer(0)[0] & 0xffffff; }

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("mip levels survive fills and uploads beside their page, and are built once for many polygons") {
    Studio studio(mipmapped());
    for (int y = 0; y < 256; ++y)
      for (int x = 512; x < 768; ++x) studio.gpu.vram().at(x, y) = 0x001f;
    studio.draw(quad(page_at_512));
    const auto one = mip_bytes(studio);
    CHECK(one > 256 * 256 * 4);
    studio.draw({0x02000000, 0, 64U | 64U << 16});
    studio.draw(upload(768, 0, {0, 0}));
    studio.draw(upload(512, 256, {0, 0}));
    CHECK(mip_bytes(studio) == one);
    studio.draw(quad(page_at_512));
    CHECK(mip_bytes(studio) == one);
    CHECK(shown(studio) == 0x0000ff);
  }

  TEST_CASE("mip levels follow an upload, a copy, a fill or a polygon that changes their page") {
    const auto changed_by = [](const std::vector<std::uint32_t>& words) {
      Studio studio(mipmapped());
      for (int y = 0; y < 256; ++y)
        for (int x = 512; x < 768; ++x) studio.gpu.vram().at(x, y) = 0x001f;
      for (int y = 300; y < 400; ++y)
        for (int x = 300; x < 400; ++x) studio.gpu.vram().at(x, y) = 0x7c00;
      studio.draw(quad(page_at_512));
      REQUIRE(shown(studio) == 0x0000ff);
      studio.draw(words);
      studio.draw(area_words(64, 64));
      studio.draw(quad(page_at_512));
      return shown(studio);
    };
    std::vector<std::uint32_t> blue(32 * 8, 0x7c007c00);
    auto uploaded = upload(512, 0, blue);
    uploaded[2] = 64 | 8 << 16;
    CHECK(changed_by(uploaded) == 0xff0000);
    CHECK(changed_by({0x80000000, 300 | 300 << 16, 512, 64 | 64 << 16}) == 0xff0000);
    CHECK(changed_by({0x02ff0000, 512, 64 | 64 << 16}) == 0xff0000);
    CHECK(changed_by({0xe3000000 | 512, 0xe4000000 | 767 | 255 << 10, 0x60ff0000, 512, 64 | 64 << 16}) ==
          0xff0000);
  }

  TEST_CASE("mip levels follow a palette that changes while its page stays") {
    Studio studio(mipmapped());
    for (int y = 0; y < 256; ++y)
      for (int x = 512; x < 576; ++x) studio.gpu.vram().at(x, y) = 0x1111;
    studio.draw(upload(640, 300, {0x001f0000, 0}));
    studio.draw(quad(0x008, clut_at_640_300));
    CHECK(shown(studio) == 0x0000ff);
    studio.draw(upload(640, 300, {0x7c000000, 0}));
    studio.draw({0x01000000});  // the palette cache of the GPU is read anew
    studio.draw(quad(0x008, clut_at_640_300));
    CHECK(shown(studio) == 0xff0000);
  }
}
