// Draw state at its extremes: texture windows, offsets that leave the number range, areas without a pixel.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "gpu/gpu.h"
#include "ot/packet.h"
#include "stability/measure.h"
#include "stability/send.h"
#include "stability/triangulation.h"

using gpu::Gpu;
using stability::Measure;
using stability::Random;
using stability::send;

namespace {

ot::Xy xy(int x, int y) { return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)}; }

/// As a vertex's 11 bits read.
int wrapped(int v) { return ((v + 1024) & 2047) - 1024; }

int changed_pixels(const Gpu& gpu, std::uint16_t background) {
  const auto pixels = gpu.vram().pixels();
  return static_cast<int>(pixels.size()) - static_cast<int>(std::ranges::count(pixels, background));
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Every texture window reads the texel that its formula names") {
    Measure wrong{"3. Extremes",
                  "all 1,024 masks and offsets of a texture window on each axis, coordinates 0..255 and on "
                  "beyond 255",
                  "a texel beside the window, a coordinate that leaves 8 bits",
                  "texel (u and not 8 mask) or (8 (offset and mask)), u modulo 256",
                  "pixels",
                  0};
    auto gpu = std::make_unique<Gpu>();
    send(*gpu, ot::DrawArea{});
    send(*gpu,
         ot::DrawMode{.texpage = ot::texpage_of(512, 0, ot::Blend::average, ot::TexelFormat::direct15)});
    for (int v = 0; v < 256; ++v) {
      for (int u = 0; u < 256; ++u) gpu->vram().at(512 + u, v) = static_cast<std::uint16_t>(u | v << 8);
    }
    Random random(140);
    for (int pair = 0; pair < 1024; ++pair) {
      const int mask_u = pair % 32, offset_u = pair / 32, mask_v = offset_u, offset_v = mask_u;
      send(*gpu, ot::TextureWindow{.mask_x = static_cast<std::uint8_t>(mask_u),
                                   .mask_y = static_cast<std::uint8_t>(mask_v),
                                   .offset_x = static_cast<std::uint8_t>(offset_u),
                                   .offset_y = static_cast<std::uint8_t>(offset_v)});
      const ot::Uv first{static_cast<std::uint8_t>(random.word()), static_cast<std::uint8_t>(random.word())};
      const auto texel = [&](int du, int dv) {
        const int u = (first.u + du) & 255, v = (first.v + dv) & 255;
        return static_cast<std::uint16_t>(((u & ~(8 * mask_u)) | 8 * (offset_u & mask_u)) |
                                          ((v & ~(8 * mask_v)) | 8 * (offset_v & mask_v)) << 8);
      };
      ot::Rectangle row{.textured = true, .raw = true};
      row.xy = xy(0, 300);
      row.uv = first;
      row.width = 256;
      row.height = 1;
      ot::Rectangle column = row;
      column.xy = xy(300, 0);
      column.width = 1;
      column.height = 256;
      std::fill_n(&gpu->vram().at(0, 300), 256, std::uint16_t{0});
      for (int y = 0; y < 256; ++y) gpu->vram().at(300, y) = 0;
      send(*gpu, row);
      send(*gpu, column);
      int bad = 0;
      for (int i = 0; i < 256; ++i) {  // texel 0 is a hole, which leaves the 0 below
        bad += gpu->vram().at(i, 300) != texel(i, 0);
        bad += gpu->vram().at(300, i) != texel(0, i);
      }
      wrong.see(bad, 512);
    }
  }

  TEST_CASE("Offsets that carry vertices beyond 11 bits wrap them as the rule says") {
    Measure wrong{"3. Extremes",
                  "rectangles and quads of 8 x 8 pixels, places -1024..1015, drawing offsets -1024..1023, on "
                  "both axes",
                  "a shape that is lost, or found at the other side of VRAM",
                  "begins at the sum's low 11 bits, goes on to the right and down without wrapping",
                  "pixels",
                  0};
    constexpr std::array places{-1024, -1023, -5, 0, 1, 512, 1015};
    constexpr std::array offsets{-1024, -1023, -1, 0, 3, 1020, 1023};
    std::vector<int> expected(1024 * 512);
    for (const int offset_x : offsets) {
      for (const int offset_y : offsets) {
        const auto gpu = std::make_unique<Gpu>();
        send(*gpu, ot::DrawArea{});
        send(*gpu,
             ot::DrawMode{.texpage = ot::texpage_of(0, 0, ot::Blend::add, ot::TexelFormat::clut4)});  // B + F
        send(*gpu, ot::DrawOffset{xy(offset_x, offset_y)});
        std::ranges::fill(expected, 0);
        for (const int x : places) {
          for (const int y : places) {
            ot::Rectangle rectangle{.semi_transparent = true};
            rectangle.rgb = {8, 8, 8};
            rectangle.xy = xy(x, y);
            rectangle.width = rectangle.height = 8;
            send(*gpu, rectangle);
            ot::Polygon quad{.quad = true, .semi_transparent = true};
            quad.rgb[0] = {8, 8, 8};
            quad.xy = {xy(x, y), xy(x + 8, y), xy(x, y + 8), xy(x + 8, y + 8)};
            send(*gpu, quad);
            const int left = wrapped(x + offset_x), top = wrapped(y + offset_y);
            for (int row = std::max(top, 0); row < std::min(top + 8, 512); ++row) {
              for (int column = std::max(left, 0); column < std::min(left + 8, 1024); ++column) {
                expected[static_cast<std::size_t>(row * 1024 + column)] += 2;
              }
            }
          }
        }
        int bad = 0;
        const auto pixels = gpu->vram().pixels();
        for (std::size_t i = 0; i < expected.size(); ++i)
          bad += (pixels[i] & 31) != std::min(expected[i], 31);
        wrong.see(bad, 2 * places.size() * places.size());
      }
    }
  }

  TEST_CASE("A drawing area whose edges are exchanged holds no pixel") {
    Measure drawn{
        "3. Extremes",
        "triangles, quads, rectangles and lines, plain and textured, with and without a z-buffer, in "
        "areas with right < left or bottom < top",
        "a loop that runs backwards, a pixel at an edge",
        "nothing is drawn",
        "pixels",
        0};
    Random random(141);
    for (const bool depth : {false, true}) {
      const auto gpu = std::make_unique<Gpu>();
      if (depth) gpu->set_depth(gpu::DepthOptions{});
      std::ranges::fill(gpu->vram().pixels(), std::uint16_t{0x1111});
      gpu->begin_frame();
      for (int i = 0; i < 300; ++i) {
        ot::DrawArea area{.left = static_cast<std::uint16_t>(random.between(0, 1023)),
                          .top = static_cast<std::uint16_t>(random.between(0, 511)),
                          .right = static_cast<std::uint16_t>(random.between(0, 1023)),
                          .bottom = static_cast<std::uint16_t>(random.between(0, 511))};
        if (area.left <= area.right && area.top <= area.bottom) {
          // By one pixel, or all the way.
          if (i % 3 == 0) std::swap(area.left, area.right);
          if (i % 3 == 1) std::swap(area.top, area.bottom);
          if (i % 3 == 2) area.left = static_cast<std::uint16_t>(area.right + 1);
        }
        if (area.left <= area.right && area.top <= area.bottom) continue;  // equal edges are a pixel
        send(*gpu, area);
        const auto place = [&] { return xy(random.between(-100, 1000), random.between(-100, 500)); };
        ot::Polygon polygon{.quad = i % 2 == 0, .gouraud = i % 4 < 2, .textured = i % 5 == 0};
        for (auto& corner : polygon.xy) corner = place();
        if (depth) {
          ot::DepthAnnotation annotation;
          annotation.z = {1 << 20, 1 << 21, 1 << 22, 1 << 23};
          annotation.count = 4;
          send(*gpu, annotation);
        }
        send(*gpu, polygon);
        ot::Rectangle rectangle{.textured = i % 5 == 1};
        rectangle.xy = place();
        rectangle.width = 1023;
        rectangle.height = 511;
        send(*gpu, rectangle);
        ot::Line line{.gouraud = i % 2 == 1};
        line.xy = {place(), place()};
        send(*gpu, line);
        drawn.see(i % 50 == 0 ? changed_pixels(*gpu, 0x1111) : 0, 3);
      }
      (void)gpu->end_frame();
      drawn.see(changed_pixels(*gpu, 0x1111), 0);
    }
  }
}
