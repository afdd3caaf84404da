// The canvas where it meets VRAM's edges, and its mip levels where pages share memory.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "canvas_scene.h"
#include "gpu/canvas/mip.h"
#include "gpu/canvas/sample_pattern.h"

using namespace canvas_test;
namespace canvas = gpu::canvas;

namespace {

/// Both targets after the same words: what VRAM holds of the region at (x, y), and what the canvas shows of
/// it.
void check_alike(int x, int y, const std::vector<std::uint32_t>& words) {
  canvas::Options options{.width = 64, .height = 32};
  gpu::Gpu console, accurate;
  accurate.set_canvas(options);
  accurate.begin_frame(x, y);
  console.gp0(words);
  accurate.gp0(words);
  int differ = 0;
  for (int j = 0; j < options.height; ++j) {
    for (int i = 0; i < options.width; ++i) {
      const auto shown = narrow(accurate.canvas()->layer(0)[static_cast<std::size_t>(j * options.width + i)]);
      differ += shown != console.vram().at(x + i, y + j) ? 1 : 0;
    }
  }
  CHECK(differ == 0);
}

std::vector<std::uint32_t> area(int x, int y) {
  return {0xe3000000 | static_cast<std::uint32_t>(y) << 10 | static_cast<std::uint32_t>(x),
          0xe4000000 | static_cast<std::uint32_t>(y + 31) << 10 | static_cast<std::uint32_t>(x + 63),
          0xe5000000};
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("Lines on a canvas of whole pixels are the console's, flat and shaded, in every direction") {
    Random random(4);
    for (const auto& row : {std::pair{0, 0}, {320, 200}, {960, 480}}) {
      const auto x = row.first;
      const auto y = row.second;
      auto words = area(x, y);
      for (int n = 0; n < 60; ++n) {
        const auto at = [&] { return vertex_word(x + random.between(-20, 80), y + random.between(-20, 50)); };
        const std::uint32_t rgb = random.word() & 0xffffff;
        switch (n % 4) {
          case 0:
            words.insert(words.end(), {0x40000000 | rgb, at(), at()});
            break;
          case 1:
            words.insert(words.end(), {0x50000000 | rgb, at(), random.word() & 0xffffff, at()});
            break;
          case 2:
            words.insert(words.end(), {0x42000000 | rgb, at(), at()});
            break;
          default:
            words.insert(words.end(), {0x58000000 | rgb, at(), random.word() & 0xffffff, at(),
                                       random.word() & 0xffffff, at(), 0x55555555});
        }
      }
      check_alike(x, y, words);
    }
  }

  TEST_CASE("Fills, copies and uploads that wrap round VRAM's edges arrive on the canvas at both ends") {
    for (const auto& row : {std::pair{0, 0}, {960, 480}}) {
      const auto x = row.first;
      const auto y = row.second;
      auto words = area(x, y);
      // From column 1008 on, and from row 504 on: the rest lies at 0.
      words.insert(words.end(), {0x02a040f8, 504U << 16 | 1008, 16U << 16 | 64});
      std::vector<std::uint32_t> upload{0xa0000000, 508U << 16 | 1000, 8U << 16 | 48};
      for (std::uint32_t n = 0; n < 8 * 24; ++n) upload.push_back(0x12345678 * n);
      words.insert(words.end(), upload.begin(), upload.end());
      words.insert(words.end(), {0x80000000, 506U << 16 | 996, 510U << 16 | 1012, 12U << 16 | 40});
      check_alike(x, y, words);
    }
  }

  TEST_CASE("Mip levels made through one texture window are not used through another") {
    gpu::Vram vram;
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) vram.at(x, y) = x < 128 ? 0x001f : 0x7c00;
    }
    canvas::MipCache cache;
    gpu::DrawState state;
    state.draw_mode = 0x100;  // 15-bit texels, page at 0,0
    canvas::TextureView view;
    view.vram = &vram;
    std::array<std::uint16_t, 256> clut{};
    view.clut = clut.data();
    const auto mean_of = [&] { return cache.chain(view, state).at(8, 0, 0) & 0xffffff; };
    const auto both = mean_of();
    CHECK((both & 0xff) != 0);
    CHECK((both >> 16 & 0xff) != 0);
    // A window over columns 128..255 alone: every texel is blue.
    state.texture_window = 0x10 | 0x10 << 10;
    view.keep_u = 0x7f;
    view.set_u = 0x80;
    const auto blue = mean_of();
    CHECK((blue & 0xff) == 0);
    CHECK((blue >> 16 & 0xff) == 0xf8);
    state.texture_window = 0;
    view.keep_u = 0xff;
    view.set_u = 0;
    CHECK(mean_of() == both);
  }

  TEST_CASE("Mip levels are forgotten where their page wraps round VRAM's right edge") {
    gpu::Vram vram;
    canvas::MipCache cache;
    gpu::DrawState state;
    state.draw_mode = 0x100 | 15;  // 15-bit texels from column 960 on: 192 of its 256 columns lie at 0
    canvas::TextureView view;
    view.vram = &vram;
    view.page_x = 960;
    std::array<std::uint16_t, 256> clut{};
    view.clut = clut.data();
    const auto texel = [&] { return cache.chain(view, state).at(0, 100, 5); };  // column 36
    const auto before = texel();
    vram.at(36, 5) = 0x7fff;
    CHECK(texel() == before);  // nobody told
    cache.forget({200, 5, 4, 1});
    CHECK(texel() == before);  // not of this page
    cache.forget({30, 5, 10, 1});
    CHECK(texel() != before);
  }

  TEST_CASE("Super-sampling chooses the mip level of its finer pixels: half a level for each doubling") {
    // A page whose level n is of one colour each cannot be made; one of fine stripes can: level 0 alternates
    // black and white, from level 1 on all is grey. A texel a pixel is level 0; two are level 1; two with
    // four samples, 0.
    const auto spread_of = [](std::size_t layers, int texels) {
      canvas::Options options{
          .width = 64, .height = 64, .filter = canvas::Filter::mipmap, .colour = canvas::Colour::bits24};
      if (layers > 1) options.layers = canvas::regular_grid(static_cast<int>(std::lround(std::sqrt(layers))));
      Studio studio(options);
      for (int y = 0; y < 256; ++y) {
        for (int x = 512; x < 768; ++x) studio.gpu.vram().at(x, y) = x % 2 == 0 ? 0x7fff : 0x8000;
      }
      const int last = 32 * texels;
      studio.draw(polygon(0x2d,
                          {Corner{0, 0, 0, 0, 0}, Corner{32 * 256, 0, 0, last, 0},
                           Corner{0, 32 * 256, 0, 0, last}, Corner{32 * 256, 32 * 256, 0, last, last}},
                          0, 0x108));
      int low = 255, high = 0;
      for (int y = 8; y < 24; ++y) {
        for (int x = 8; x < 24; ++x) {
          const int r = static_cast<int>(studio.canvas.layer(0)[static_cast<std::size_t>(y * 64 + x)] & 255);
          low = std::min(low, r);
          high = std::max(high, r);
        }
      }
      return high - low;
    };
    CHECK(spread_of(1, 5) == 0);   // five texels a pixel: level 2, grey
    CHECK(spread_of(16, 5) > 64);  // with 4 x 4 samples about one texel each: level 0, stripes
    CHECK(spread_of(4, 5) == 0);   // with 2 x 2 about two texels each: level 1, grey
  }
}
