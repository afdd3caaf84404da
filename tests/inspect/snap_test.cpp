#include "scene/snap.h"

#include <doctest/doctest.h>

#include <map>

#include "random_triangles.h"

namespace {

// How often each pixel is covered.
std::map<std::pair<int, int>, int> covered(const std::vector<gpu::Corners>& triangles) {
  std::map<std::pair<int, int>, int> pixels;
  for (const auto& t : triangles) {
    gpu::for_each_covered_row(t, [&](int y, int left, int right) {
      for (int x = left; x < right; ++x) ++pixels[{x, y}];
    });
  }
  return pixels;
}

std::map<std::pair<int, int>, int> once(const exact::Rows& rows) {
  std::map<std::pair<int, int>, int> pixels;
  for (int y = rows.top; y < rows.bottom(); ++y) {
    for (int x = rows.at(y).left; x < rows.at(y).right; ++x) pixels[{x, y}] = 1;
  }
  return pixels;
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("a rectangle of pixels is two triangles") {
    const exact::Rows rows{3, {{2, 9}, {2, 9}, {2, 9}, {2, 9}}};
    const auto triangles = scene::triangles_over(rows);
    CHECK(triangles.size() == 2);
    CHECK(covered(triangles) == once(rows));
  }

  // x >= y / 3 for 31 rows, the steps 0, 1, 1, 1, 2, 2, 2, ..., 10: the edge from (0,0) to (10,31) has them
  // all, because y * 10 / 31 is below y / 3 by less than a third.
  TEST_CASE("a staircase that is a straight edge is one edge") {
    exact::Rows rows{0, {}};
    for (int y = 0; y < 31; ++y) rows.spans.push_back({(y + 2) / 3, 40});
    const auto triangles = scene::triangles_over(rows);
    CHECK(triangles.size() == 2);
    CHECK(covered(triangles) == once(rows));
  }

  TEST_CASE("a single pixel, rows that do not touch, and rows without pixels between are covered") {
    for (const exact::Rows& rows :
         {exact::Rows{-4, {{7, 8}}}, exact::Rows{0, {{3, 4}, {7, 8}, {11, 12}}},
          exact::Rows{0, {{3, 5}, {}, {}, {7, 8}, {9, 10}}}, exact::Rows{0, {{0, 1}, {0, 100}, {99, 100}}}}) {
      CHECK(covered(scene::triangles_over(rows)) == once(rows));
    }
    CHECK(scene::triangles_over({}).empty());
  }

  TEST_CASE("any rows at all are covered exactly, each pixel once") {
    tests::RandomTriangles random(71);
    for (int shape = 0; shape < 3000; ++shape) {
      exact::Rows rows{random.between(-20, 20), {}};
      const int height = random.between(1, 24), wildness = random.between(0, 12);
      int left = random.between(-30, 30), right = left + random.between(1, 30);
      for (int y = 0; y < height; ++y) {
        rows.spans.push_back({left, right});
        left += random.between(-wildness, wildness);
        right = std::max(left + 1, right + random.between(-wildness, wildness));
      }
      REQUIRE(covered(scene::triangles_over(rows)) == once(rows));
    }
  }

  TEST_CASE("the pieces of split triangles are covered exactly by few triangles") {
    tests::RandomTriangles random(72);
    std::size_t pieces = 0, triangles = 0, rows = 0;
    for (int scene = 0; scene < 200; ++scene) {
      const auto kind = tests::all_kinds[static_cast<std::size_t>(scene) % tests::all_kinds.size()];
      const auto order = split_into_order(random.scene(kind, 8, 60), {0, 0, 63, 63});
      for (const auto& piece : order.pieces) {
        if (piece.is_whole) continue;
        const auto shape = scene::triangles_over(piece.rows);
        REQUIRE(covered(shape) == once(piece.rows));
        ++pieces;
        triangles += shape.size();
        rows += piece.rows.spans.size();
      }
    }
    CHECK(pieces > 500);
    CHECK(triangles < rows);
  }

  // Corners (0,0), (32,0), (0,32) of a parent whose red is 7 * x, whose u is 4 * y, and whose z is 4096
  // everywhere.
  TEST_CASE("a piece has its parent's attributes at its own corners") {
    scene::Primitive parent;
    parent.count = 3;
    parent.gouraud = true;
    constexpr std::array<std::array<std::int16_t, 2>, 3> places{{{0, 0}, {32, 0}, {0, 32}}};
    for (std::size_t k = 0; k < 3; ++k) {
      auto& c = parent.corner[k];
      c.sxy = {places[k][0], places[k][1]};
      c.colour = {static_cast<std::uint8_t>(places[k][0] * 7), 10, 20, 0};
      c.uv = {static_cast<std::uint8_t>(places[k][1] * 4), 9};
      c.z_20_12 = 4096 * 4096;
    }
    std::vector<scene::Primitive> triangles;
    CHECK(scene::snap(parent, {4, {{2, 6}, {2, 6}}}, triangles) == 2);
    REQUIRE(triangles.size() == 2);
    for (const auto& t : triangles) {
      CHECK(t.count == 3);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& c = t.corner[k];
        CHECK(c.colour.r == c.sxy.x * 7);
        CHECK(c.colour.g == 10);
        CHECK(c.uv.u == c.sxy.y * 4);
        CHECK(c.uv.v == 9);
        CHECK(c.z_20_12 == 4096 * 4096);
      }
    }
  }
}
