// A split that is told to stop, or would take too much, gives every pixel of every triangle all the same.

#include <doctest/doctest.h>

#include <random>

#include "exact/split.h"

namespace {

std::vector<exact::Triangle> pierced(int count) {
  std::mt19937 random(2);
  const auto below = [&](int n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  std::vector<exact::Triangle> triangles(static_cast<std::size_t>(count));
  for (auto& t : triangles) {
    for (auto& corner : t)
      corner = {below(64) * 256, below(64) * 256, static_cast<std::uint32_t>((50 + below(200)) << 12)};
  }
  return triangles;
}

std::vector<std::uint64_t> pixels_of(const exact::SplitOrder& order, std::size_t triangles) {
  std::vector<std::uint64_t> pixels(triangles);
  for (const auto& piece : order.pieces) pixels[piece.triangle] += piece.rows.pixels();
  return pixels;
}

}  // namespace

TEST_SUITE("exact") {
  TEST_CASE("A split that is stopped anywhere still draws every pixel of every triangle once") {
    const auto triangles = pierced(40);
    const exact::Area area{0, 0, 63, 63};
    const auto whole = exact::split_into_order(triangles, area);
    CHECK_FALSE(whole.was_stopped);
    REQUIRE(whole.splits > 10);
    for (const int after : {0, 1, 5, 30, 200}) {
      int asked = 0;
      const auto stopped = exact::split_into_order(triangles, area, {.keep_going = [&](double done) {
                                                     CHECK(done >= 0);
                                                     CHECK(done <= 1);
                                                     return asked++ < after;
                                                   }});
      CAPTURE(after);
      CHECK(stopped.was_stopped);
      CHECK(pixels_of(stopped, triangles.size()) == pixels_of(whole, triangles.size()));
    }
  }

  TEST_CASE("A split whose pieces pass the limit of rows ends and says so") {
    const auto triangles = pierced(40);
    const auto order = exact::split_into_order(triangles, {0, 0, 63, 63}, {.most_spans = 2000});
    CHECK(order.was_too_much);
    CHECK_FALSE(order.was_stopped);
    CHECK_FALSE(exact::split_into_order(triangles, {0, 0, 63, 63}).was_too_much);
  }
}
