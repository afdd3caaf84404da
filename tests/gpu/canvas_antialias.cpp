// Edges against exact area coverage: a pixel is the square of side 1 round its sample point.

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

#include "canvas_scene.h"
#include "gpu/canvas/resolve.h"
#include "gpu/canvas/sample_pattern.h"

using namespace canvas_test;
namespace canvas = gpu::canvas;

namespace {

struct Real {
  double x, y;
};
using Outline = std::vector<Real>;

/// The part of a convex outline where `inside(p)` >= 0, `inside` being affine.
template <class F>
Outline cut(const Outline& outline, F&& inside) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Real a = outline[i];
    const Real b = outline[(i + 1) % outline.size()];
    const double da = inside(a);
    const double db = inside(b);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const double t = da / (da - db);
      kept.push_back({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t});
    }
  }
  return kept;
}

double area(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Real a = outline[i];
    const Real b = outline[(i + 1) % outline.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return std::abs(sum) / 2;
}

/// Share of pixel (x, y) that the triangle covers.
double coverage(const std::array<Corner, 3>& t, int x, int y) {
  Outline o;
  for (const auto& c : t) o.push_back({c.x / 256.0, c.y / 256.0});
  o = cut(o, [&](Real p) { return p.x - (x - 0.5); });
  o = cut(o, [&](Real p) { return x + 0.5 - p.x; });
  o = cut(o, [&](Real p) { return p.y - (y - 0.5); });
  o = cut(o, [&](Real p) { return y + 0.5 - p.y; });
  return area(o);
}

constexpr int side = 64;

canvas::Options target() {
  return {.width = side, .height = side, .fraction_bits = 8, .colour = canvas::Colour::bits24};
}
canvas::Options layered(std::vector<canvas::Point> layers) {
  auto o = target();
  o.layers = std::move(layers);
  return o;
}
canvas::Options multisampled(int n) {
  auto o = target();
  o.samples = canvas::rotated_grid(n);
  return o;
}

std::vector<std::array<Corner, 3>> random_triangles(int count) {
  Random random(3);
  std::vector<std::array<Corner, 3>> list;
  for (int i = 0; i < count; ++i) {
    std::array<Corner, 3> t;
    for (auto& c : t) c = {random.between(0, side * 256), random.between(0, side * 256), 0xffffff};
    list.push_back(t);
  }
  return list;
}

/// Long edges that rise by less than one pixel in eight.
std::vector<std::array<Corner, 3>> near_horizontal_triangles(int count) {
  Random random(5);
  std::vector<std::array<Corner, 3>> list;
  for (int i = 0; i < count; ++i) {
    const int y = random.between(20 * 256, 40 * 256);
    list.push_back({Corner{-300 * 256, y, 0xffffff},
                    Corner{364 * 256, y + random.between(-60 * 256, 60 * 256), 0xffffff},
                    Corner{32 * 256, 400 * 256, 0xffffff}});
  }
  return list;
}

base::Picture picture(Studio& studio, const std::array<Corner, 3>& t) {
  studio.draw({0x02000000, 0, side | side << 16});
  studio.draw(polygon(0x20, {t.begin(), t.end()}));
  studio.gpu.end_frame();
  return canvas::resolve(studio.canvas, canvas::Reconstruction::box);
}

/// Root mean square of (shown - exact coverage) over the pixels that an edge crosses.
template <class Finish>
double edge_error(const canvas::Options& options, const std::vector<std::array<Corner, 3>>& triangles,
                  Finish&& finish) {
  double sum = 0;
  int pixels = 0;
  for (const auto& t : triangles) {
    Studio studio(options);
    const auto shown = finish(picture(studio, t));
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double exact = coverage(t, x, y);
        if (exact < 1e-9 || exact > 1 - 1e-9) continue;
        const double seen = shown.at(x, y).r / 255.0;
        sum += (seen - exact) * (seen - exact);
        ++pixels;
      }
    }
  }
  return std::sqrt(sum / pixels);
}

double edge_error(const canvas::Options& options, const std::vector<std::array<Corner, 3>>& triangles) {
  return edge_error(options, triangles, [](base::Picture image) { return image; });
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("the error of edges against exact area coverage falls with the number of samples") {
    const auto triangles = random_triangles(24);
    const double none = edge_error(target(), triangles);
    CHECK(none > 0.2);
    SUBCASE("rotated grids") {
      double last = none;
      for (const int n : {2, 4, 8, 16, 32, 64}) {
        const double error = edge_error(layered(canvas::rotated_grid(n)), triangles);
        CAPTURE(n);
        CHECK(error < last);
        last = error;
      }
      CHECK(last < 0.02);
    }
    SUBCASE("square grids") {
      double last = none;
      for (const int n : {2, 3, 4, 6, 8}) {
        const double error = edge_error(layered(canvas::regular_grid(n)), triangles);
        CAPTURE(n);
        CHECK(error < last);
        last = error;
      }
      CHECK(last < 0.03);
    }
    SUBCASE("multi-sampling") {
      double last = none;
      for (const int n : {2, 4, 8}) {
        const double error = edge_error(multisampled(n), triangles);
        CAPTURE(n);
        CHECK(error < last);
        last = error;
      }
      CHECK(last < 0.08);
    }
    SUBCASE("FXAA improves on nothing at all") {
      CHECK(edge_error(target(), triangles, [](const base::Picture& i) { return canvas::fxaa(i); }) < none);
    }
  }

  TEST_CASE("four samples off the grid beat four on it where edges are nearly horizontal") {
    const auto triangles = near_horizontal_triangles(16);
    const double square = edge_error(layered(canvas::regular_grid(2)), triangles);
    const double rotated = edge_error(layered(canvas::rotated_grid(4)), triangles);
    CHECK(rotated < 0.75 * square);
  }

  TEST_CASE("temporal accumulation of a still picture converges to as many samples as its jitter has") {
    const auto triangles = random_triangles(8);
    const double one = edge_error(target(), triangles);
    double sum = 0;
    int pixels = 0;
    for (const auto& t : triangles) {
      auto jittered = target();
      jittered.temporal = true;
      Studio studio(jittered);
      canvas::Accumulator accumulator;
      base::Picture shown;
      for (int frame = 0; frame < 2 * canvas::jitter_length; ++frame) {
        studio.gpu.begin_frame();
        shown = accumulator.add(picture(studio, t));
      }
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const double exact = coverage(t, x, y);
          if (exact < 1e-9 || exact > 1 - 1e-9) continue;
          const double seen = shown.at(x, y).r / 255.0;
          sum += (seen - exact) * (seen - exact);
          ++pixels;
        }
      }
    }
    CHECK(std::sqrt(sum / pixels) < one / 2);
  }

  TEST_CASE("every pattern has its mean on the sample point, to 0.005 pixel") {
    const auto mean_of = [](const std::vector<canvas::Point>& points) {
      std::array<double, 2> sum{};
      for (const auto& p : points) {
        sum[0] += static_cast<double>(p.x);
        sum[1] += static_cast<double>(p.y);
      }
      return std::max(std::abs(sum[0]), std::abs(sum[1])) / static_cast<double>(points.size()) / 256;
    };
    std::vector<canvas::Point> jitter;
    for (int i = 0; i < canvas::jitter_length; ++i) jitter.push_back(canvas::temporal_jitter(i));
    CHECK(mean_of(jitter) <= 0.005);
    for (int n = 2; n <= 64; ++n) {
      CAPTURE(n);
      CHECK(mean_of(canvas::rotated_grid(n)) <= 0.005);
      CHECK(mean_of(canvas::cell_middles(n)) <= 0.005);
      for (std::uint32_t seed = 1; seed < 70; ++seed)
        CHECK(mean_of(canvas::random_samples(n, seed)) <= 0.005);
      if (n <= 8) CHECK(mean_of(canvas::regular_grid(n)) <= 0.005);
    }
  }

  TEST_CASE("random samples lie one in each cell") {
    for (const int n : {4, 7, 12}) {
      const auto middles = canvas::cell_middles(n);
      const auto samples = canvas::random_samples(n, 3);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        // A cell is as wide as the middles lie apart; centring may move a sample by a fraction of that.
        CHECK(std::abs(samples[i].x - middles[i].x) <= 128);
        CHECK(std::abs(samples[i].y - middles[i].y) <= 256 / 2);
      }
    }
    const auto four = canvas::random_samples(4, 9);
    CHECK(four[0].x < four[1].x);
    CHECK(four[0].y < four[2].y);
  }

  TEST_CASE("pixels with samples of their own: no shift of the picture, and an error that falls with N") {
    const auto triangles = random_triangles(200);
    double last = edge_error(target(), triangles);
    for (const int n : {4, 16, 64}) {
      auto options = layered(canvas::cell_middles(n));
      options.scatter_seed = 1;
      double shift_x = 0, shift_y = 0, sum = 0;
      int edges = 0;
      for (const auto& t : triangles) {
        Studio studio(options);
        const auto shown = picture(studio, t);
        double weight = 0, x_sum = 0, y_sum = 0, exact_weight = 0, exact_x = 0, exact_y = 0;
        for (int y = 0; y < side; ++y) {
          for (int x = 0; x < side; ++x) {
            const double exact = coverage(t, x, y);
            const double seen = shown.at(x, y).r / 255.0;
            weight += seen;
            x_sum += seen * x;
            y_sum += seen * y;
            exact_weight += exact;
            exact_x += exact * x;
            exact_y += exact * y;
            if (exact < 1e-9 || exact > 1 - 1e-9) continue;
            sum += (seen - exact) * (seen - exact);
            ++edges;
          }
        }
        if (exact_weight < 100) continue;
        shift_x += x_sum / weight - exact_x / exact_weight;
        shift_y += y_sum / weight - exact_y / exact_weight;
      }
      CAPTURE(n);
      const auto count = static_cast<double>(triangles.size());
      CHECK(std::abs(shift_x / count) < 0.005);
      CHECK(std::abs(shift_y / count) < 0.005);
      const double error = std::sqrt(sum / edges);
      CHECK(error < 0.75 * last);
      last = error;
    }
  }

  TEST_CASE("an upright edge shows other levels from row to row where pixels have samples of their own") {
    const auto levels = [](std::uint32_t seed) {
      auto options = layered(canvas::cell_middles(4));
      options.scatter_seed = seed;
      Studio studio(options);
      const auto shown = picture(
          studio, {Corner{20 * 256 + 60, -100 * 256, 0xffffff}, Corner{60 * 256, -100 * 256, 0xffffff},
                   Corner{20 * 256 + 60, 300 * 256, 0xffffff}});
      std::set<std::uint32_t> seen;
      for (int y = 0; y < side; ++y) seen.insert(shown.at(20, y).r);
      return seen.size();
    };
    CHECK(levels(0) == 1);
    CHECK(levels(1) >= 2);
  }

  TEST_CASE("multi-sampling shades a pixel once, super-sampling once per sample") {
    const auto triangles = random_triangles(12);
    std::uint64_t single = 0;
    std::uint64_t multi = 0;
    std::uint64_t super = 0;
    std::uint64_t multi_covered = 0;
    for (const auto& t : triangles) {
      const auto words = polygon(0x20, {t.begin(), t.end()});
      Studio one(target());
      Studio many(multisampled(4));
      Studio layers(layered(canvas::rotated_grid(4)));
      for (Studio* s : {&one, &many, &layers}) s->draw(words);
      single += one.canvas.counters().shaded;
      multi += many.canvas.counters().shaded;
      multi_covered += many.canvas.counters().covered;
      super += layers.canvas.counters().shaded;
      // What is written is the same set of samples either way.
      CHECK(many.canvas.counters().written == layers.canvas.counters().written);
    }
    CHECK(multi == multi_covered);
    CHECK(multi < single * 5 / 4);  // the pixels of one sample, and those that only an edge touches
    CHECK(super > 39 * single / 10);
  }

  TEST_CASE("the weights of a filter sum to one, and a picture of one colour keeps it") {
    for (const auto filter :
         {canvas::Reconstruction::box, canvas::Reconstruction::tent, canvas::Reconstruction::gauss}) {
      for (const int n : {1, 4, 7, 16}) {
        const auto options = layered(n == 1 ? std::vector<canvas::Point>{{}} : canvas::rotated_grid(n));
        std::uint32_t sum = 0;
        for (const auto& tap : canvas::filter_taps(options, filter)) sum += tap.weight;
        CHECK(sum == 65536);
        Studio studio(options);
        studio.draw({0x027fc501, 0, side | side << 16});
        const auto image = canvas::resolve(studio.canvas, filter);
        CHECK(image.pixels == std::vector<base::Rgba>(side * side, {0x01, 0xc5, 0x7f}));
      }
    }
  }
}
