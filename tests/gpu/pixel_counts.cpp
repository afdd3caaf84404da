// Pixels by kind, counted for a host's clock.

#include "gpu/pixel_counts.h"

#include <doctest/doctest.h>

#include <memory>
#include <numeric>
#include <vector>

#include "gpu/canvas/options.h"
#include "gpu/gpu.h"
#include "random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;
using gpu::PixelCounts;

PixelCounts counts_of(const Words& words) {
  gpu::Gpu gpu;
  PixelCounts counts;
  gpu.set_pixel_counts(&counts);
  gpu.gp0(Words{0xe3000000, 0xe4000000 | 319 | 239 << 10});
  gpu.gp0(words);
  return counts;
}

std::uint64_t sum(const std::array<std::uint64_t, 8>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("A rectangle counts its pixels inside the drawing area, under what it is made of") {
    CHECK(counts_of({0x60ffffff, 310, 20 | 4 << 16}).rectangles[0] == 10 * 4);
    CHECK(counts_of({0x62ffffff, 0, 2 | 4 << 16}).rectangles[PixelCounts::semi_transparent] == 8);
    CHECK(counts_of({0x7cffffff, 0, 0}).rectangles[PixelCounts::textured] == 256);
    CHECK(sum(counts_of({0x60ffffff, 320, 20 | 4 << 16}).rectangles) == 0);
  }

  TEST_CASE("A quad counts both its triangles, and a polygon that is too large counts nothing") {
    CHECK(counts_of({0x28ffffff, 0, 10, 10 << 16, 10 | 10 << 16}).polygons[0] == 100);
    CHECK(counts_of({0x30ffffff, 0, 0, 16, 0, 16 << 16}).polygons[PixelCounts::gouraud] == 136);
    CHECK(sum(counts_of({0x20ffffff, 0, 1024, 16 << 16}).polygons) == 0);
  }

  TEST_CASE("A line counts both its ends, and only what lies inside") {
    CHECK(counts_of({0x40ffffff, 0, 9}).lines[0] == 10);
    CHECK(counts_of({0x40ffffff, 315, 324}).lines[0] == 5);
  }

  TEST_CASE("Fills, copies and transfers count their rectangles") {
    const auto counts = counts_of({0x02ffffff, 0, 32 | 4 << 16, 0x80000000, 0, 0, 5 | 3 << 16, 0xa0000000, 0,
                                   2 | 1 << 16, 0, 0xc0000000, 0, 7 | 2 << 16});
    CHECK(counts.fills == 128);
    CHECK(counts.copies == 15);
    CHECK(counts.uploads == 2);
    CHECK(counts.downloads == 14);
  }

  TEST_CASE("Random opaque primitives count as many pixels as they write") {
    tests::RandomWords random(5);
    for (int round = 0; round < 300; ++round) {
      Words words;
      random.state(words);
      words.back() = 0xe6000000;  // no mask
      random.place(1 + random.below(300));
      constexpr std::uint32_t opcodes[] = {0x20, 0x28, 0x30, 0x38, 0x40, 0x48,
                                           0x50, 0x58, 0x60, 0x68, 0x70, 0x78};
      const std::uint32_t opcode = opcodes[random.below(12)];
      if (opcode < 0x40) random.polygon(words, opcode);
      if (opcode >= 0x40 && opcode < 0x60) random.line(words, opcode);
      if (opcode >= 0x60) random.rectangle(words, opcode);
      gpu::Gpu gpu;
      gpu::Trace trace;
      trace.keep_history = true;
      PixelCounts counts;
      if (random.coin()) gpu.gp1(0x08000024);  // interlaced: rows are skipped
      gpu.set_trace(&trace);
      gpu.set_pixel_counts(&counts);
      gpu.gp0(words);
      CHECK(sum(counts.polygons) + sum(counts.rectangles) + sum(counts.lines) == trace.history.size());
    }
  }

  TEST_CASE("On a canvas and under a z-buffer the console's pixels count") {
    gpu::Gpu gpu;
    PixelCounts counts;
    gpu.set_pixel_counts(&counts);
    gpu.set_canvas(gpu::canvas::Options{.width = 64, .height = 64, .scale = 4, .depth = gpu::DepthOptions{}});
    gpu.gp0(Words{0xe3000000, 0xe4000000 | 63 | 63 << 10, 0x28ffffff, 0, 10, 10 << 16, 10 | 10 << 16});
    CHECK(counts.polygons[0] == 100);
  }
}
