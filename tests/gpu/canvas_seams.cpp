// Hard cases of coverage: every sample between two triangles that share an edge
// belongs to exactly one of them.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "canvas_scene.h"
#include "gpu/canvas/sample_pattern.h"

using namespace canvas_test;
namespace canvas = gpu::canvas;

namespace {

struct Named {
  std::string name;
  canvas::Options options;
};

constexpr int side = 64;  // console pixels of the square canvas

/// Every way in which a canvas can place and sample positions.
std::vector<Named> all_targets() {
  std::vector<Named> list;
  const auto add = [&](const std::string& name, int scale, const std::vector<canvas::Point>& layers,
                       const std::vector<canvas::Point>& samples) {
    for (const bool deep : {false, true}) {
      canvas::Options o{.width = side,
                        .height = side,
                        .scale = scale,
                        .fraction_bits = 8,
                        .perspective = deep,
                        .colour = canvas::Colour::bits24};
      if (deep) o.depth = gpu::DepthOptions{};
      o.layers = layers;
      o.samples = samples;
      list.push_back({name + (deep ? ", z-buffer" : ""), o});
    }
  };
  for (const int scale : {1, 2, 4, 8}) add(std::to_string(scale) + "x", scale, {{}}, {});
  for (const int n : {2, 3, 4}) add(std::to_string(n) + "x ssaa", 1, canvas::regular_grid(n), {});
  add("rotated 5 at x2", 2, canvas::rotated_grid(5), {});
  add("random 8", 1, canvas::random_samples(8), {});
  for (const int n : {4, 7}) {
    add("scattered " + std::to_string(n), 1, canvas::cell_middles(n), {});
    for (auto* target : {&list[list.size() - 2], &list.back()}) target->options.scatter_seed = 5;
  }
  for (const int n : {2, 4, 8}) add(std::to_string(n) + "x msaa", 1, {{}}, canvas::rotated_grid(n));
  add("taa", 1, {canvas::temporal_jitter(3)}, {});
  return list;
}

/// A grid of cells with shaken inner corners, each cell two semi-transparent triangles that add `colour`.
std::vector<std::uint32_t> shaken_mesh(Random& random, std::uint32_t colour) {
  constexpr int cells = 6;
  constexpr int low = -20 * 256;
  constexpr int step = (side + 40) * 256 / cells;
  std::array<std::array<Corner, cells + 1>, cells + 1> corners;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && i < cells && j > 0 && j < cells;
      const auto shake = [&] { return inner ? random.between(-step * 2 / 5, step * 2 / 5) : 0; };
      const int x = low + i * step + shake();
      corners[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = {
          x,      low + j * step + shake(),
          colour, 0,
          0,      static_cast<std::uint32_t>(random.between(100, 4000)) << 12};
    }
  }
  std::vector<std::uint32_t> words{0xe1000020};  // B + F
  const auto triangle = [&](Corner a, Corner b, Corner c) {
    std::array<Corner, 3> order{a, b, c};
    std::rotate(order.begin(), order.begin() + random.between(0, 2), order.end());
    if (random.between(0, 1) == 0) std::swap(order[0], order[1]);
    const auto more = polygon(0x32, {order.begin(), order.end()});
    words.insert(words.end(), more.begin(), more.end());
  };
  for (std::size_t j = 0; j < cells; ++j) {
    for (std::size_t i = 0; i < cells; ++i) {
      const auto a = corners[j][i];
      const auto b = corners[j][i + 1];
      const auto c = corners[j + 1][i];
      const auto d = corners[j + 1][i + 1];
      // The diagonal that keeps both halves the right way round exists in a convex cell; others are split
      // anyway, along b-c, as two triangles of one orientation each, or left to the area test below.
      triangle(a, b, c);
      triangle(b, c, d);
    }
  }
  return words;
}

/// Signed coverage may overlap where a shaken cell is not convex: the mesh is one sheet
/// when all triangles turn alike.
bool is_one_sheet(const std::vector<std::uint32_t>& words) {
  std::vector<canvas::Point> points;
  std::array<canvas::Point, 3> fractions{};
  for (std::size_t at = 1; at < words.size();) {
    const auto opcode = words[at] >> 24;
    if (opcode >= 0xec) {
      fractions[opcode - 0xec] = {words[at] & 0xff, words[at] >> 8 & 0xff};
      ++at;
    } else if (opcode >= 0xe7) {
      ++at;
    } else {
      for (std::size_t v = 0; v < 3; ++v) {
        const auto word = words[at + 1 + 2 * v];
        const auto coordinate = [](std::uint32_t bits) {
          return static_cast<int>((bits & 0x7ff) ^ 0x400) - 0x400;
        };
        points.push_back(
            {coordinate(word) * 256 + fractions[v].x, coordinate(word >> 16) * 256 + fractions[v].y});
      }
      at += 6;
    }
  }
  std::int64_t total = 0;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    total += std::abs(canvas::doubled_area(points[i], points[i + 1], points[i + 2]));
  }
  const auto [left, right] = std::ranges::minmax(points, {}, &canvas::Point::x);
  const auto [top, bottom] = std::ranges::minmax(points, {}, &canvas::Point::y);
  return total == 2 * (right.x - left.x) * (bottom.y - top.y);
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("semi-transparent triangles that share edges blend every sample exactly once, in every mode") {
    for (const auto& target : all_targets()) {
      const auto& options = target.options;
      Random random(7);
      int sheets = 0;
      for (int attempt = 0; attempt < 200 && sheets < 6; ++attempt) {
        const auto words = shaken_mesh(random, 0x0b0705);
        if (!is_one_sheet(words)) continue;
        ++sheets;
        Studio studio(options);
        studio.draw(words);
        const auto end = studio.gpu.end_frame();
        CHECK(end.polygons_without_depth == 0);
        for (std::size_t layer = 0; layer < options.layers.size(); ++layer) {
          const auto colours = studio.canvas.layer(layer);
          CAPTURE(target.name);
          CAPTURE(layer);
          REQUIRE(std::ranges::count(colours, 0x0b0705U) == static_cast<std::ptrdiff_t>(colours.size()));
        }
      }
      REQUIRE(sheets == 6);
    }
  }

  TEST_CASE(
      "opaque needles, points and huge triangles at the corners of the number range draw without overflow") {
    for (const auto& target : all_targets()) {
      const auto& options = target.options;
      Studio studio(options);
      Random random(11);
      for (int i = 0; i < 300; ++i) {
        const auto coordinate = [&] {
          constexpr std::array extremes{-1024 * 256, -1024 * 256 + 255, 1023 * 256 + 255, 0, 1, 255,
                                        -1,          32 * 256};
          return extremes[static_cast<std::size_t>(random.between(0, 7))] / (random.between(0, 1) + 1);
        };
        std::vector<Corner> corners;
        corners.reserve(4);
        for (int c = 0; c < 4; ++c) {
          corners.push_back({coordinate(), coordinate(), random.word() & 0xffffff, random.between(0, 255),
                             random.between(0, 255),
                             random.between(0, 3) == 0 ? 0xffffffff : random.word() >> 12 | 1});
        }
        studio.draw(polygon(0x20 | (random.word() & 0x1f), corners, 0x4000, 0x110));
      }
      studio.gpu.end_frame();
      CAPTURE(target.name);
      CHECK(studio.canvas.counters().written > 0);
    }
  }

  TEST_CASE("a sample pattern keeps inside the pixel and off the axes it promises to avoid") {
    for (int n = 2; n <= 64; ++n) {
      const auto rotated = canvas::rotated_grid(n);
      std::vector<std::int64_t> columns;
      std::vector<std::int64_t> rows;
      for (const auto p : rotated) {
        REQUIRE((p.x >= -128 && p.x < 128 && p.y >= -128 && p.y < 128));
        columns.push_back(p.x);
        rows.push_back(p.y);
      }
      std::ranges::sort(columns);
      std::ranges::sort(rows);
      CHECK(std::ranges::adjacent_find(columns) == columns.end());
      CHECK(std::ranges::adjacent_find(rows) == rows.end());
      for (const auto p : canvas::random_samples(n))
        REQUIRE((p.x >= -128 && p.x < 128 && p.y >= -128 && p.y < 128));
    }
    // Four samples: the knight's moves of the rotated grid, by hand.
    CHECK(canvas::rotated_grid(4) == std::vector<canvas::Point>{{-96, -32}, {-32, 96}, {32, -96}, {96, 32}});
    CHECK(canvas::regular_grid(2) == std::vector<canvas::Point>{{-64, -64}, {64, -64}, {-64, 64}, {64, 64}});
  }
}
