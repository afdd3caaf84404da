#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "exact/split.h"
#include "tests/inspect/random_triangles.h"

namespace {

using exact::Area;
using exact::SplitOrder;
using exact::Triangle;

using Stacks =
    std::map<std::pair<int, int>, std::vector<std::uint32_t>>;  // pixel -> triangles, drawn first first

Stacks drawn(const SplitOrder& order) {
  Stacks stacks;
  for (const auto& piece : order.pieces) {
    for (int y = piece.rows.top; y < piece.rows.bottom(); ++y) {
      for (int x = piece.rows.at(y).left; x < piece.rows.at(y).right; ++x)
        stacks[{x, y}].push_back(piece.triangle);
    }
  }
  return stacks;
}

// Every pixel sorted by itself: farther first, then lower index.
Stacks expected(const std::vector<Triangle>& triangles, const Area& area) {
  Stacks stacks;
  const std::vector<exact::InversePlane> planes(triangles.begin(), triangles.end());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (planes[t].is_degenerate()) continue;
    const auto rows = covered_rows(triangles[t], area);
    for (int y = rows.top; y < rows.bottom(); ++y) {
      for (int x = rows.at(y).left; x < rows.at(y).right; ++x) stacks[{x, y}].push_back(t);
    }
  }
  for (auto& [pixel, stack] : stacks) {
    std::stable_sort(stack.begin(), stack.end(), [&, x = pixel.first, y = pixel.second](auto a, auto b) {
      return compare_nearness_exactly(planes[a], planes[b], x, y) < 0;
    });
  }
  return stacks;
}

Triangle on_pixels(std::array<std::array<int, 3>, 3> corners) {
  Triangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    t[i] = {corners[i][0] * 256, corners[i][1] * 256, static_cast<std::uint32_t>(corners[i][2]) * 4096};
  }
  return t;
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("triangles that can be ordered are not split") {
    const std::vector<Triangle> triangles{on_pixels({{{0, 0, 100}, {8, 0, 100}, {0, 8, 100}}}),
                                          on_pixels({{{0, 0, 300}, {8, 0, 300}, {0, 8, 300}}}),
                                          on_pixels({{{0, 0, 200}, {8, 0, 200}, {0, 8, 200}}})};
    const auto order = split_into_order(triangles, {});
    CHECK(order.splits == 0);
    REQUIRE(order.pieces.size() == 3);
    CHECK(order.pieces[0].triangle == 1);
    CHECK(order.pieces[1].triangle == 2);
    CHECK(order.pieces[2].triangle == 0);
    CHECK(order.pieces[0].is_whole);
  }

  TEST_CASE("two triangles that pierce each other need one split") {
    const std::vector<Triangle> triangles{on_pixels({{{0, 0, 100}, {16, 0, 300}, {0, 16, 100}}}),
                                          on_pixels({{{0, 0, 150}, {16, 0, 150}, {0, 16, 150}}})};
    const auto order = split_into_order(triangles, {});
    CHECK(order.splits == 1);
    CHECK(order.cycles == 1);
    CHECK(order.pieces.size() == 3);
    CHECK(drawn(order) == expected(triangles, {}));
  }

  TEST_CASE("three triangles in a ring are split and then drawn right") {
    // Each lies over the next at the corner they share, in the manner of paper strips.
    const std::vector<Triangle> ring{on_pixels({{{0, 0, 100}, {30, 0, 300}, {0, 8, 100}}}),
                                     on_pixels({{{30, 0, 200}, {22, 30, 400}, {22, 0, 200}}}),
                                     on_pixels({{{30, 30, 300}, {0, 0, 200}, {0, 6, 200}}})};
    const auto order = split_into_order(ring, {});
    CHECK(order.cycles == 1);
    CHECK(order.splits == 1);
    CHECK(drawn(order) == expected(ring, {}));
  }

  TEST_CASE("the picture of equal depths is that of list order, whatever else is in the scene") {
    const Triangle a = on_pixels({{{0, 0, 100}, {8, 0, 100}, {0, 8, 100}}});
    const std::vector<Triangle> triangles{a, a, a};
    const auto order = split_into_order(triangles, {});
    CHECK(order.splits == 0);
    REQUIRE(order.pieces.size() == 3);
    for (std::uint32_t i = 0; i < 3; ++i) CHECK(order.pieces[i].triangle == i);
  }

  TEST_CASE("triangles without pixels have no pieces") {
    const std::vector<Triangle> triangles{on_pixels({{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}),
                                          on_pixels({{{-9, -9, 1}, {-5, -9, 1}, {-9, -5, 1}}})};
    CHECK(split_into_order(triangles, {}).pieces.empty());
    CHECK(exact::split_into_order({}, {}).pieces.empty());
  }

  TEST_CASE("every pixel is drawn in order of depth, each triangle once: random scenes") {
    tests::RandomTriangles random(11);
    const Area area{0, 0, 15, 15};
    std::uint32_t splits = 0;
    for (int scene = 0; scene < 300; ++scene) {
      const auto kind = tests::all_kinds[static_cast<std::size_t>(scene) % tests::all_kinds.size()];
      const auto triangles = random.scene(kind, 2 + scene % 9, 16);
      const auto order = split_into_order(triangles, area);
      REQUIRE(drawn(order) == expected(triangles, area));
      splits += order.splits;
    }
    CHECK(splits > 100);
  }

  TEST_CASE("the pieces of a triangle make up the triangle") {
    tests::RandomTriangles random(12);
    const Area area{0, 0, 31, 31};
    const auto triangles = random.scene(tests::Kind::anything, 40, 32);
    const auto order = split_into_order(triangles, area);
    CHECK(order.splits > 0);
    std::vector<std::uint64_t> pixels(triangles.size());
    for (const auto& piece : order.pieces) {
      pixels[piece.triangle] += piece.rows.pixels();
      CHECK(piece.is_whole == (piece.rows == covered_rows(triangles[piece.triangle], area)));
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
      CHECK(pixels[t] == covered_rows(triangles[t], area).pixels());
  }
}
