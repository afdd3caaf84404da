// The console's rasterizer: watertight, degenerate, extreme. A triangle drawn with colour 080808h and blend
// mode "add" raises every pixel it touches by one step of 5 bits, so VRAM counts how often a pixel was hit.

#include <doctest/doctest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "gpu/gpu.h"
#include "ot/packet.h"
#include "stability/measure.h"
#include "stability/send.h"
#include "stability/triangulation.h"

using gpu::Corners;
using gpu::Gpu;
using gpu::Point;
using stability::Measure;
using stability::Random;
using stability::send;

namespace {

ot::Polygon counting(const Corners& t) {
  ot::Polygon p;
  p.semi_transparent = true;
  p.rgb[0] = {8, 8, 8};
  for (std::size_t i = 0; i < 3; ++i) {
    p.xy[i] = {static_cast<std::int16_t>(t[i].x), static_cast<std::int16_t>(t[i].y)};
  }
  return p;
}

/// A GPU that counts, drawing area and offset as given.
std::unique_ptr<Gpu> counter(Point offset = {0, 0}) {
  auto gpu = std::make_unique<Gpu>();
  send(*gpu, ot::DrawMode{.texpage = ot::texpage_of(0, 0, ot::Blend::add, ot::TexelFormat::clut4)});
  send(*gpu, ot::DrawArea{});
  send(*gpu, ot::DrawOffset{{static_cast<std::int16_t>(offset.x), static_cast<std::int16_t>(offset.y)}});
  return gpu;
}

/// Pixels that were not hit as often as they should: once inside, never outside.
int wrong_hits(const Gpu& gpu, int left, int top, int right, int bottom) {
  int wrong = 0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) {
      const bool inside = x >= left && x < right && y >= top && y < bottom;
      wrong += (gpu.vram().pixels()[static_cast<std::size_t>(y * 1024 + x)] & 31) != (inside ? 1 : 0);
    }
  }
  return wrong;
}

/// Runs f for every set of vector instructions this processor has. The factor is 1 the first time and 0 after
/// that: inputs are counted once, so that the page is the same on every machine.
template <class F>
void on_every_target(F&& f) {
  unsigned factor = 1;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    f(factor);
    factor = 0;
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Random triangulations of a rectangle hit every pixel once") {
    Measure wrong{"1. Watertight",
                  "random triangulations of a rectangle, 12 to 300 triangles, slivers included",
                  "a hole, a doubly blended seam, a pixel outside",
                  "every pixel inside once, no other",
                  "pixels",
                  0};
    on_every_target([&](unsigned factor) {
      Random random(1);
      for (int i = 0; i < 30; ++i) {
        const int width = random.between(1, 320), height = random.between(1, 240);
        const auto mesh = stability::triangulate(random, width, height, random.between(5, 150));
        const auto gpu = counter({random.between(0, 700), random.between(0, 270)});
        const auto at = gpu->state();
        for (const auto& t : mesh) send(*gpu, counting(t));
        wrong.see(
            wrong_hits(*gpu, at.offset_x(), at.offset_y(), at.offset_x() + width, at.offset_y() + height),
            factor * mesh.size());
      }
    });
  }

  TEST_CASE("A fan of 1,000 triangles round one vertex hits every pixel once") {
    Measure wrong{"1. Watertight",
                  "fans of 1,000 triangles round one vertex",
                  "a vertex drawn a thousand times",
                  "every pixel inside once, no other",
                  "pixels",
                  0};
    on_every_target([&](unsigned factor) {
      Random random(2);
      for (int i = 0; i < 8; ++i) {
        const int width = random.between(260, 500), height = random.between(260, 500);
        const Point centre{random.between(1, width - 1), random.between(1, height - 1)};
        const auto gpu = counter();
        for (const auto& t : stability::fan(centre, width, height, 1000)) send(*gpu, counting(t));
        wrong.see(wrong_hits(*gpu, 0, 0, width, height), factor * 1000);
      }
    });
  }

  TEST_CASE("Grids of bent quads hit every pixel once, also through the z-buffer") {
    Measure wrong{"1. Watertight",
                  "grids of bent quads, in list order and through the z-buffer",
                  "the two halves of a quad or its neighbours overlap",
                  "every pixel inside once, no other",
                  "pixels",
                  0};
    Random random(3);
    for (int i = 0; i < 24; ++i) {
      constexpr int cells = 12, size = 20;
      std::array<std::array<Point, cells + 1>, cells + 1> grid{};
      for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
          // At most 4 of 20: a quad that folds over its own diagonal is drawn twice, rightly.
          const auto bend = [&](int at) { return at == 0 || at == cells ? 0 : random.between(-4, 4); };
          grid[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = {x * size + bend(x),
                                                                            y * size + bend(y)};
        }
      }
      const auto gpu = counter();
      if (i % 2 == 1) gpu->set_depth(gpu::DepthOptions{});
      gpu->begin_frame();
      for (std::size_t y = 0; y < cells; ++y) {
        for (std::size_t x = 0; x < cells; ++x) {
          if (i % 2 == 1) {
            send(*gpu,
                 ot::DepthAnnotation{
                     .z = {100U << 12, 200U << 12, 300U << 12, 400U << 12}, .fx = {}, .fy = {}, .count = 4});
          }
          auto quad = counting({grid[y][x], grid[y][x + 1], grid[y + 1][x]});
          quad.quad = true;
          quad.xy[3] = {static_cast<std::int16_t>(grid[y + 1][x + 1].x),
                        static_cast<std::int16_t>(grid[y + 1][x + 1].y)};
          send(*gpu, quad);
        }
      }
      (void)gpu->end_frame();
      wrong.see(wrong_hits(*gpu, 0, 0, cells * size, cells * size), cells * cells);
    }
  }

  TEST_CASE("All triangles on a 5 x 5 lattice cover what exact arithmetic says") {
    Measure wrong{"2. Degenerate",
                  "all 15,625 triangles on a 5 x 5 lattice, point- and line-like ones included",
                  "a needle or a point leaves a pixel",
                  "the pixels of the rule, exactly",
                  "pixels",
                  0};
    on_every_target([&](unsigned factor) {
      const auto gpu = counter({100, 100});
      for (int code = 0; code < 25 * 25 * 25; ++code) {
        const auto lattice = [](int n) { return Point{n % 5 * 2, n / 5 * 2}; };
        const Corners t{lattice(code % 25), lattice(code / 25 % 25), lattice(code / 625)};
        for (int y = 98; y < 112; ++y) std::fill_n(&gpu->vram().at(98, y), 14, std::uint16_t{0});
        send(*gpu, counting(t));
        const int area = gpu::doubled_area(t);
        int bad = 0;
        for (int y = -2; y < 12; ++y) {
          for (int x = -2; x < 12; ++x) {
            // Inside an edge by a product of integers. Left and top edges count, right and bottom ones do
            // not: the sample moves by an infinitely small step to the right and an even smaller one down.
            bool inside = area != 0;
            for (std::size_t e = 0; e < 3 && inside; ++e) {
              const Point p = t[e], q = t[(e + 1) % 3];
              int side = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
              if (side == 0) side = q.y == p.y ? q.x - p.x : p.y - q.y;
              inside = area > 0 ? side > 0 : side < 0;
            }
            bad += (gpu->vram().at(100 + x, 100 + y) & 31) != (inside ? 1 : 0);
          }
        }
        wrong.see(bad, factor);
      }
    });
  }

  TEST_CASE("Triangles at the size rule's edge are drawn whole or not at all") {
    Measure wrong{"3. Extremes",
                  "triangles of 1022..1025 x 510..513 at every offset that the words can say",
                  "an overflow, a half-drawn triangle",
                  "whole if at most 1023 x 511, else nothing",
                  "pixels",
                  0};
    for (const int width : {1022, 1023, 1024, 1025}) {
      for (const int height : {510, 511, 512, 513}) {
        for (const Point offset :
             {Point{0, 0}, Point{-1, -1}, Point{-1024, 0}, Point{0, -1024}, Point{1, 1}}) {
          const auto gpu = counter(offset);
          const int left = std::min(0, 1023 - width), top = std::min(0, 511 - height);
          send(*gpu, counting({{{left, top}, {left + width, top}, {left, top + height}}}));
          std::int64_t expected = 0, drawn = 0;
          if (width <= 1023 && height <= 511) {
            for (int row = 0; row < height; ++row) {
              const int y = top + row + offset.y;
              if (y < 0 || y > 511) continue;
              // Row `row` of the triangle holds the columns x with x * height < width * (height - row).
              const std::int64_t columns = (std::int64_t{width} * (height - row) + height - 1) / height;
              const int from = std::max(0, left + offset.x);
              const auto to = std::min<std::int64_t>(1024, left + offset.x + columns);
              expected += std::max<std::int64_t>(0, to - from);
            }
          }
          for (const auto pixel : gpu->vram().pixels()) drawn += pixel & 31;
          wrong.see(static_cast<double>(std::abs(expected - drawn)));
        }
      }
    }
  }

  TEST_CASE("Texture coordinates 0 and 255 and pages at the right edge stay inside VRAM") {
    Measure wrong{"3. Extremes",
                  "15-bit texture pages at x 768..960, u and v 0..255",
                  "a read behind the row",
                  "columns wrap at 1024",
                  "pixels",
                  0};
    for (const int page : {768, 832, 896, 960}) {
      for (const int y_page : {0, 256}) {
        auto gpu = std::make_unique<Gpu>();
        send(*gpu, ot::DrawArea{});
        for (int y = 0; y < 512; ++y) {
          for (int x = 0; x < 1024; ++x) gpu->vram().at(x, y) = static_cast<std::uint16_t>(1 + x + 7 * y);
        }
        const auto before = std::make_unique<gpu::Vram>(gpu->vram());
        ot::Polygon p;
        p.quad = p.textured = p.raw = true;
        p.texpage = ot::texpage_of(static_cast<unsigned>(page), static_cast<unsigned>(y_page),
                                   ot::Blend::average, ot::TexelFormat::direct15);
        p.xy = {ot::Xy{300, 100}, {555, 100}, {300, 355}, {555, 355}};
        p.uv = {ot::Uv{0, 0}, {255, 0}, {0, 255}, {255, 255}};
        send(*gpu, p);
        int bad = 0;
        for (int y = 0; y < 255; ++y) {
          for (int x = 0; x < 255; ++x) {
            const auto texel = std::as_const(*before).at((page + x) & 1023, y_page + y);
            if (texel != 0) bad += gpu->vram().at(300 + x, 100 + y) != texel;
          }
        }
        wrong.see(bad, 255 * 255);
      }
    }
  }

  TEST_CASE("A thousand semi-transparent layers stay in range and come to rest") {
    Measure moving{"9. Blend",
                   "1,000 layers of each of the four modes, every colour over every background",
                   "wrap-around, oscillation",
                   "5-bit values; the last layer changes nothing",
                   "steps",
                   0};
    for (unsigned mode = 0; mode < 4; ++mode) {
      const auto blend = static_cast<ot::Blend>(1 + mode);
      for (int colour = 0; colour < 32; ++colour) {
        auto gpu = std::make_unique<Gpu>();
        send(*gpu, ot::DrawArea{});
        send(*gpu, ot::DrawMode{.texpage = ot::texpage_of(0, 0, blend, ot::TexelFormat::clut4)});
        for (int b = 0; b < 32; ++b) gpu->vram().at(b, 0) = static_cast<std::uint16_t>(b * 0x421);
        const auto level = static_cast<std::uint8_t>(colour * 8);
        ot::Rectangle layer;
        layer.semi_transparent = true;
        layer.rgb = {level, level, level};
        layer.width = 32;
        layer.height = 1;
        std::array<std::uint16_t, 32> last{};
        for (int i = 0; i < 1000; ++i) {
          std::copy_n(&gpu->vram().at(0, 0), 32, last.begin());
          send(*gpu, layer);
        }
        int changed = 0;
        for (int b = 0; b < 32; ++b) {
          const auto pixel = gpu->vram().at(b, 0);
          changed += pixel != last[static_cast<std::size_t>(b)] || (pixel & 31) != (pixel >> 5 & 31) ||
                     pixel > 0x7fff;
        }
        moving.see(changed, 32);
      }
    }
  }

  TEST_CASE("Dither keeps the mean of 4 x 4 pixels within half a step") {
    // The sixteen offsets sum to -8, so the mean lies half a unit of 8 low: 1/16 of a step, besides rounding.
    Measure error{"9. Blend",
                  "flat colours 0..255 as dithered Gouraud quads",
                  "a shade that dithering makes brighter or darker",
                  "mean within half a step of 8 (colours 4..247; saturation bends the ends)",
                  "steps of 8",
                  0.5};
    for (int value = 4; value <= 247; ++value) {
      auto gpu = std::make_unique<Gpu>();
      send(*gpu, ot::DrawArea{});
      send(*gpu, ot::DrawMode{.dither = true});
      ot::Polygon p;
      p.quad = p.gouraud = true;
      p.rgb.fill({static_cast<std::uint8_t>(value), 0, 0});
      p.xy = {ot::Xy{0, 0}, {4, 0}, {0, 4}, {4, 4}};
      send(*gpu, p);
      int sum = 0;
      for (int i = 0; i < 16; ++i) sum += gpu->vram().at(i % 4, i / 4) & 31;
      // A 5-bit level stands for the middle of the 8 values that truncate to it.
      error.see(std::abs(sum / 16.0 - (value - 3.5) / 8.0));
    }
  }
}
