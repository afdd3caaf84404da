// With default options a canvas is a console frame buffer.

#include <doctest/doctest.h>

#include "canvas_scene.h"

using namespace canvas_test;

namespace {

/// Textures and palettes from rows 256..511: never from the canvas, even where a page wraps.
constexpr std::uint32_t lower_half_page = 0x10, lower_half_clut = 0x4000;

/// Random commands of every drawing kind.
std::vector<std::uint32_t> random_command(Random& random) {
  const auto coordinate = [&] {
    const int reach = random.between(0, 3) == 0 ? 900 : 200;
    return vertex_word(random.between(160 - reach, 160 + reach),
                       random.between(120 - reach / 2, 120 + reach / 2));
  };
  std::vector<std::uint32_t> words;
  const int kind = random.between(0, 9);
  if (kind <= 5) {
    const std::uint32_t command = 0x20 | (random.word() & 0x1f);
    const bool gouraud = (command & 0x10) != 0;
    const int corners = (command & 0x08) != 0 ? 4 : 3;
    for (int i = 0; i < corners; ++i) {
      if (i == 0) words.push_back(command << 24 | (random.word() & 0xffffff));
      if (i != 0 && gouraud) words.push_back(random.word() & 0xffffff);
      words.push_back(coordinate());
      const std::uint32_t page = lower_half_page | (random.word() & 0x1ef);
      const std::uint32_t clut = lower_half_clut | (random.word() & 0x7fff);
      if ((command & 0x04) != 0) words.push_back((random.word() & 0xffff) | (i == 0 ? clut : page) << 16);
    }
  } else if (kind == 6) {
    const std::uint32_t command = 0x40 | (random.word() & 0x17);
    words = {command << 24 | (random.word() & 0xffffff), coordinate()};
    if ((command & 0x10) != 0) words.push_back(random.word() & 0xffffff);
    words.push_back(coordinate());
  } else if (kind == 7) {
    const std::uint32_t command = 0x60 | (random.word() & 0x1f);
    words = {command << 24 | (random.word() & 0xffffff), coordinate()};
    if ((command & 0x04) != 0)
      words.push_back((random.word() & 0xffff) | (lower_half_clut | (random.word() & 0x7fff)) << 16);
    if ((command & 0x18) == 0) words.push_back(random.word() & 0x7f007f);
  } else if (kind == 8) {
    words = {0xe1000000 | (random.word() & 0x37ef) | lower_half_page,
             0xe6000000 | (random.between(0, 3) == 0 ? random.word() & 3 : 0),
             0xe2000000 | (random.between(0, 1) == 0 ? random.word() & 0xfffff : 0)};
  } else if (random.between(0, 1) == 0) {
    words = {0x02000000 | (random.word() & 0xffffff), random.word() & 0x00ff01ff, random.word() & 0x003f003f};
  } else {
    // Onto the canvas, from anywhere. What is copied off a canvas is VRAM's, which was not drawn on.
    words = {0x80000000, random.word() & 0x00ff03ff, random.word() & 0x007f00ff,
             (random.word() & 0x001f001f) | 0x10001};
  }
  return words;
}

void fill_with_noise(gpu::Gpu& gpu, Random& random) {
  for (auto& pixel : gpu.vram().pixels()) pixel = static_cast<std::uint16_t>(random.word());
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("a canvas of one sample, integer positions and 15 bits shows the console's picture to the bit") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      gpu::Gpu console;
      Studio studio({.width = 320, .height = 240});
      Random noise(seed);
      fill_with_noise(console, noise);
      std::ranges::copy(console.vram().pixels(), studio.gpu.vram().pixels().begin());
      console.gp0(area_words(320, 240));
      const std::vector<std::uint32_t> clear{0x02000000, 0, 0x00f00140};
      console.gp0(clear);
      studio.draw(clear);
      Random random(seed);
      for (int i = 0; i < 120; ++i) {
        const auto words = random_command(random);
        console.gp0(words);
        studio.draw(words);
      }
      studio.gpu.end_frame();
      int different = 0;
      for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
          const auto drawn = narrow(studio.canvas.layer(0)[static_cast<std::size_t>(y * 320 + x)]);
          different += drawn != console.vram().at(x, y) ? 1 : 0;
        }
      }
      CAPTURE(seed);
      REQUIRE(different == 0);
    }
  }

  TEST_CASE("overlapping copies repeat on a canvas what they repeat in VRAM, across its edges too") {
    gpu::Gpu console;
    Studio studio({.width = 320, .height = 240, .scale = 2});
    Random random(5);
    const std::vector<std::uint32_t> size{0xa0000000, 0, 400 | 4 << 16};
    std::vector<std::uint32_t> words = size;
    for (int i = 0; i < 400 * 4 / 2; ++i) words.push_back(random.word());
    for (int i = 0; i < 60; ++i) {
      const auto row = static_cast<std::uint32_t>(random.between(0, 3)) << 16;
      const auto column = [&] { return static_cast<std::uint32_t>(random.between(-30, 120)) & 1023; };
      words.push_back(0xe6000000 | (i % 3 == 0 ? 3U : 0U));
      words.insert(words.end(), {0x80000000, column() | row, column() | row,
                                 static_cast<std::uint32_t>(random.between(100, 320)) | 0x10000});
    }
    console.gp0(words);
    studio.draw(words);
    int different = 0;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 320; ++x) {
        const auto shown = studio.canvas.layer(0)[static_cast<std::size_t>((2 * y + 1) * 640 + 2 * x)];
        different += narrow(shown) != console.vram().at(x, y) ? 1 : 0;
      }
    }
    CHECK(different == 0);
  }

  TEST_CASE("what is drawn outside the canvas goes to VRAM as on the console") {
    gpu::Gpu console;
    Studio studio({.width = 320, .height = 240});
    const std::vector<std::uint32_t> beside{0xe3000000 | 512, 0xe4000000 | 767 | 255 << 10, 0x60ffffff,
                                            vertex_word(600, 20), 0x00100010};
    console.gp0(beside);
    studio.draw(beside);
    CHECK(console.vram().at(600, 20) == 0x7fff);
    CHECK(std::ranges::equal(console.vram().pixels(), studio.gpu.vram().pixels()));
    CHECK(studio.canvas.counters().written == 0);
  }
}
