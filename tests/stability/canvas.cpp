// The accurate target: watertight at every resolution, fraction and sample pattern, exact where positions are
// finest, and close to exact arithmetic in perspective and colour.

#include "gpu/canvas/canvas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "gpu/canvas/sample_pattern.h"
#include "gpu/canvas_scene.h"
#include "stability/measure.h"
#include "stability/triangulation.h"

namespace canvas = gpu::canvas;
using canvas_test::Corner;
using canvas_test::polygon;
using canvas_test::Studio;
using stability::Measure;
using stability::Random;

namespace {

struct Pattern {
  std::vector<canvas::Point> layers{{}}, samples;
};

/// One sample, super-sampling regular, rotated and random, multi-sampling.
std::vector<Pattern> patterns() {
  return {{},
          {canvas::regular_grid(2), {}},
          {canvas::rotated_grid(5), {}},
          {canvas::random_samples(7), {}},
          {{{}}, canvas::rotated_grid(2)},
          {{{}}, canvas::rotated_grid(4)},
          {{{}}, canvas::rotated_grid(8)}};
}

/// f(colour, sample point) for every sample of the canvas, the point in units of 1/256 canvas pixel.
template <class F>
void each_sample(const canvas::Canvas& target, F&& f) {
  const auto& o = target.options();
  for (std::size_t layer = 0; layer < o.layers.size(); ++layer) {
    const auto colours = target.layer(layer);
    const auto points = o.samples.empty() ? std::span(&o.layers[layer], 1) : std::span(o.samples);
    std::size_t at = 0;
    for (int y = 0; y < target.height(); ++y) {
      for (int x = 0; x < target.width(); ++x) {
        for (const auto p : points) f(colours[at++], canvas::Point{x * 256 + p.x, y * 256 + p.y});
      }
    }
  }
}

/// Inside the triangle by products of integers. A sample on an edge moves by an infinitely small step to the
/// right and an even smaller one down: left and top edges are in, right and bottom ones out.
bool covers(const std::array<canvas::Point, 3>& t, canvas::Point p) {
  const auto area = canvas::doubled_area(t[0], t[1], t[2]);
  for (std::size_t e = 0; e < 3; ++e) {
    const auto a = t[e], b = t[(e + 1) % 3];
    auto side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (side == 0) side = b.y == a.y ? b.x - a.x : a.y - b.y;
    if (area > 0 ? side <= 0 : side >= 0) return false;
  }
  return area != 0;
}

/// The triangle on a canvas at (0, 0).
std::array<canvas::Point, 3> placed(const std::vector<Corner>& corners, int scale) {
  std::array<canvas::Point, 3> t;
  for (std::size_t i = 0; i < 3; ++i)
    t[i] = {std::int64_t{corners[i].x} * scale, std::int64_t{corners[i].y} * scale};
  return t;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Triangulations hit every sample once at every scale, fraction and sample pattern") {
    Measure wrong{"1. Watertight",
                  "random triangulations on a canvas: x1, x2, x4, x8; 0, 2, 4, 8 bits of fraction; 7 sample "
                  "patterns, MSAA included",
                  "a hole, a doubly blended seam, a sample outside",
                  "every sample inside once, no other",
                  "samples",
                  0};
    Random random(101);
    for (const int scale : {1, 2, 4, 8}) {
      for (const int bits : {0, 2, 4, 8}) {
        for (const auto& pattern : patterns()) {
          canvas::Options options{.width = 48,
                                  .height = 32,
                                  .scale = scale,
                                  .fraction_bits = bits,
                                  .colour = canvas::Colour::bits24};
          options.layers = pattern.layers;
          options.samples = pattern.samples;
          Studio studio(options);
          studio.draw({0xe1000020});  // B + F
          // A rectangle that leaves a border of some pixels, on the grid that the fractions can say.
          const int steps = 1 << bits, unit = 256 / steps;
          const canvas::Point corner{random.between(2 * steps, 5 * steps),
                                     random.between(2 * steps, 5 * steps)};
          const int width = random.between(20 * steps, 40 * steps),
                    height = random.between(12 * steps, 24 * steps);
          const auto mesh = stability::triangulate(random, width, height, 40);
          for (const auto& t : mesh) {
            std::vector<Corner> corners;
            for (const auto& p : t)
              corners.push_back({static_cast<int>(corner.x + p.x) * unit,
                                 static_cast<int>(corner.y + p.y) * unit, 0x010101});
            studio.draw(polygon(0x22, corners));
          }
          const auto left = corner.x * unit * scale, right = left + std::int64_t{width} * unit * scale,
                     top = corner.y * unit * scale, bottom = top + std::int64_t{height} * unit * scale;
          int bad = 0;
          each_sample(studio.canvas, [&](canvas::Pixel colour, canvas::Point p) {
            const bool inside = p.x >= left && p.x < right && p.y >= top && p.y < bottom;
            bad += (colour & 0xffffff) != (inside ? 0x010101U : 0U);
          });
          wrong.see(bad, mesh.size());
        }
      }
    }
  }

  TEST_CASE("All triangles on a 5 x 5 lattice of half pixels cover what exact arithmetic says") {
    Measure wrong{"2. Degenerate",
                  "all 15,625 triangles on a 5 x 5 lattice of half pixels, on a canvas x1 and x2, and with 4 "
                  "samples",
                  "a needle or a point leaves a sample",
                  "the samples of the rule, exactly",
                  "samples",
                  0};
    for (const bool multi : {false, true}) {
      for (const int scale : {1, 2}) {
        canvas::Options options{
            .width = 6, .height = 6, .scale = scale, .fraction_bits = 8, .colour = canvas::Colour::bits24};
        if (multi) options.samples = canvas::rotated_grid(4);
        Studio studio(options);
        for (std::uint32_t code = 0; code < 25 * 25 * 25; ++code) {
          // Opaque, each in a colour of its own: what has that colour was covered.
          const auto lattice = [&](std::uint32_t n) {
            return Corner{static_cast<int>(256 + n % 5 * 128), static_cast<int>(256 + n / 5 * 128), code + 1};
          };
          const std::vector<Corner> corners{lattice(code % 25), lattice(code / 25 % 25), lattice(code / 625)};
          studio.draw(polygon(0x20, corners));
          const auto t = placed(corners, scale);
          int bad = 0;
          each_sample(studio.canvas, [&](canvas::Pixel colour, canvas::Point p) {
            bad += ((colour & 0xffffff) == code + 1) != covers(t, p);
          });
          wrong.see(bad);
        }
      }
    }
  }

  TEST_CASE("Triangles at the corners of the number range are exact on a canvas x8") {
    Measure wrong{"3. Extremes",
                  "triangles with corners in 1/256 pixel at -1024, 1023 + 255/256 and near 0, canvas x8",
                  "an overflow of coordinate products",
                  "the samples of the rule, exactly",
                  "samples",
                  0};
    Random random(103);
    Studio studio(
        {.width = 16, .height = 12, .scale = 8, .fraction_bits = 8, .colour = canvas::Colour::bits24});
    std::uint32_t colour = 0;
    while (colour < 600) {
      const auto coordinate = [&](int low, int high) {
        switch (random.between(0, 3)) {
          case 0:
            return low;
          case 1:
            return high;
          case 2:
            return random.between(low, high);
          default:
            return random.between(-256, 16 * 256);
        }
      };
      ++colour;
      std::vector<Corner> corners;
      // Within 1023 x 511 whole pixels, or the size rule refuses the triangle.
      const bool right = random.between(0, 1) != 0, lower = random.between(0, 1) != 0;
      for (int i = 0; i < 3; ++i) {
        corners.push_back({right ? coordinate(0, 1023 * 256 + 255) : coordinate(-1015 * 256, 8 * 256 + 255),
                           lower ? coordinate(0, 511 * 256 + 255) : coordinate(-503 * 256, 8 * 256 + 255),
                           colour});
      }
      const auto rows = std::minmax({corners[0].y >> 8, corners[1].y >> 8, corners[2].y >> 8});
      const auto columns = std::minmax({corners[0].x >> 8, corners[1].x >> 8, corners[2].x >> 8});
      if (rows.second - rows.first > 511 || columns.second - columns.first > 1023) continue;
      studio.draw(polygon(0x20, corners));
      const auto t = placed(corners, 8);
      int bad = 0;
      each_sample(studio.canvas, [&](canvas::Pixel pixel, canvas::Point p) {
        bad += ((pixel & 0xffffff) == colour) != covers(t, p);
      });
      wrong.see(bad);
    }
  }

  TEST_CASE("Perspective-correct texture coordinates are those of exact rationals") {
    Measure error{
        "7. Perspective",
        "u, v of random and of grazing triangles (z from 1 to 65,535 in one triangle), positions in "
        "1/256 pixel, x1 and x4",
        "texture that swims or jumps where 1/z is steep",
        "half a step of the 8.8 result and what double rounds: 1/512 + 1e-6 texel",
        "texels",
        1.0 / 512 + 1e-6};
    using Wide = boost::multiprecision::int256_t;
    Random random(104);
    for (const int scale : {1, 4}) {
      Studio studio({.width = 48,
                     .height = 36,
                     .scale = scale,
                     .fraction_bits = 8,
                     .perspective = true,
                     .colour = canvas::Colour::bits24,
                     .trace = true});
      std::ranges::fill(studio.gpu.vram().pixels(), std::uint16_t{0x1111});  // no texel is transparent
      for (int i = 0; i < 200; ++i) {
        studio.gpu.begin_frame();
        std::vector<Corner> corners;
        for (int v = 0; v < 3; ++v) {
          const bool grazes = i % 2 == 1;
          const int z = !grazes  ? random.between(100, 4000)
                        : v == 0 ? 1
                        : v == 1 ? 65'535
                                 : random.between(1, 65'535);
          corners.push_back({random.between(-20 * 256, 68 * 256), random.between(-20 * 256, 56 * 256),
                             0x808080, random.between(0, 255), random.between(0, 255),
                             static_cast<std::uint32_t>(z) << 12});
        }
        studio.draw(polygon(0x25, corners, 0, 0x100));
        const auto t = placed(corners, scale);
        double worst = 0;
        std::uint64_t pixels = 0;
        for (int y = 0; y < studio.canvas.height(); ++y) {
          for (int x = 0; x < studio.canvas.width(); ++x) {
            const auto at = static_cast<std::size_t>(y * studio.canvas.width() + x);
            if (studio.canvas.ids()[at] == 0) continue;
            // u = sum(w u / z) / sum(w / z), w the area opposite each corner; times 2^32, then floor.
            const canvas::Point p{x * 256, y * 256};
            Wide u = 0, v = 0, inverse = 0;
            for (std::size_t c = 0; c < 3; ++c) {
              const Wide weight = Wide{canvas::doubled_area(p, t[(c + 1) % 3], t[(c + 2) % 3])} *
                                  corners[(c + 1) % 3].z * corners[(c + 2) % 3].z;
              u += weight * corners[c].u;
              v += weight * corners[c].v;
              inverse += weight;
            }
            const auto exact = [&](const Wide& sum) {
              return static_cast<double>(Wide{(sum << 32) / inverse}) * 0x1p-32;
            };
            const auto word = studio.canvas.texcoords()[at];
            const auto seen = [](std::uint32_t bits) { return (static_cast<double>(bits) - 128) / 256; };
            worst = std::max(
                {worst, std::abs(exact(u) - seen(word & 0xffff)), std::abs(exact(v) - seen(word >> 16))});
            ++pixels;
          }
        }
        if (pixels != 0) error.see(worst, pixels);
      }
    }
  }

  TEST_CASE("A 15-bit blend stays within two steps of the same blend in 24 bits") {
    Measure error{"9. Blend",
                  "every 8-bit colour over every other, in 24 bits and in 15, four modes",
                  "24-bit frames that look like another picture",
                  "less than 2 steps of 8",
                  "steps of 8",
                  1.9999};
    for (std::uint32_t mode = 0; mode < 4; ++mode) {
      const auto drawn = [&](canvas::Colour depth) {
        auto studio = std::make_unique<Studio>(canvas::Options{.width = 256, .height = 256, .colour = depth});
        studio->draw({0xe1000000 | mode << 5});
        for (std::uint32_t level = 0; level < 256; ++level) {  // 1 x 256 in columns, then 256 x 1 in rows
          studio->draw({0x60000000 | level * 0x010101, level, 0x01000001});
        }
        for (std::uint32_t level = 0; level < 256; ++level) {
          studio->draw({0x62000000 | level * 0x010101, level << 16, 0x00010100});
        }
        return studio;
      };
      const auto fine = drawn(canvas::Colour::bits24), coarse = drawn(canvas::Colour::bits15);
      for (std::size_t i = 0; i < 256 * 256; ++i) {
        const auto value = [&](const Studio& s) { return static_cast<int>(s.canvas.layer(0)[i] & 255); };
        error.see(std::abs(value(*fine) / 8.0 - value(*coarse) / 8));
      }
    }
  }
}
