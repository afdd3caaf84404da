#include "exact/depth_order.h"

#include <doctest/doctest.h>

#include "../oracle/ray_caster.h"
#include "exact/rows.h"
#include "tests/inspect/random_triangles.h"

namespace {

using exact::InversePlane;
using exact::Triangle;

std::array<oracle::Corner, 3> for_oracle(const Triangle& t) {
  std::array<oracle::Corner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {t[i].x, t[i].y, std::max(t[i].z, 1U)};
  return corners;
}

Triangle flat(std::uint32_t z) { return {{{0, 0, z}, {2048, 0, z}, {0, 2048, z}}}; }

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("the nearer of two planes parallel to the screen is the one with the smaller z") {
    exact::DecisionCounts counts;
    const InversePlane near(flat(4096)), far(flat(8192));
    CHECK(compare_nearness(near, far, 1, 1, counts) > 0);
    CHECK(compare_nearness(far, near, 1, 1, counts) < 0);
    CHECK(counts.filtered == 2);
    CHECK(counts.exact == 0);
  }

  TEST_CASE("equal depth is found equal, by wide integers") {
    exact::DecisionCounts counts;
    // z 100 at x=0 and 300 at x=8: 1/z at x=4 is the mean of 1/100 and 1/300, that is 1/150.
    const InversePlane slanted(Triangle{{{0, 0, 100}, {2048, 0, 300}, {0, 2048, 100}}});
    const InversePlane upright(flat(150));
    CHECK(compare_nearness(slanted, upright, 4, 0, counts) == 0);
    CHECK(counts.exact == 1);
    CHECK(compare_nearness(slanted, upright, 3, 0, counts) > 0);
    CHECK(compare_nearness(slanted, upright, 5, 0, counts) < 0);
    CHECK(counts.filtered == 2);
  }

  TEST_CASE("depths that differ by one part in 2^62 are told apart") {
    exact::DecisionCounts counts;
    // On the long diagonal w1 : w2 is 1 : 1, so 1/z is the mean of the reciprocals
    // of neighbouring huge depths.
    const std::uint32_t z = 0xfffffffe;
    const InversePlane mean(Triangle{{{0, 0, z}, {2048, 0, z - 1}, {0, 2048, z + 1}}});
    const InversePlane plain(flat(z));
    CHECK(compare_nearness(mean, plain, 4, 4, counts) > 0);  // harmonic mean of z-1 and z+1 is below z
    CHECK(counts.exact == 1);
  }

  TEST_CASE("a triangle with two corners exchanged is the same plane") {
    exact::DecisionCounts counts;
    tests::RandomTriangles random(1);
    for (const Triangle& t : random.scene(tests::Kind::anything, 100, 8)) {
      const InversePlane a(t), b(Triangle{{t[1], t[0], t[2]}});
      if (!a.is_degenerate()) CHECK(compare_nearness(a, b, 3, 5, counts) == 0);
    }
  }

  TEST_CASE("corners on one line make no plane") {
    CHECK(InversePlane(Triangle{{{0, 0, 1}, {256, 256, 1}, {768, 768, 1}}}).is_degenerate());
    CHECK(InversePlane(Triangle{{{9, 9, 1}, {9, 9, 1}, {9, 9, 1}}}).is_degenerate());
  }

  TEST_CASE("the filter never contradicts the wide integers, far outside the triangle either") {
    exact::DecisionCounts counts;
    tests::RandomTriangles random(2);
    for (const auto kind : tests::all_kinds) {
      const auto triangles = random.scene(kind, 400, 8);
      for (std::size_t i = 0; i + 1 < triangles.size(); ++i) {
        const InversePlane a(triangles[i]), b(triangles[i + 1]);
        if (a.is_degenerate() || b.is_degenerate()) continue;
        for (const int x : {-4096, -3, 0, 1, 2, 7, 4096}) {
          const int y = random.between(-20, 20);
          CHECK(compare_nearness(a, b, x, y, counts) == compare_nearness_exactly(a, b, x, y));
        }
      }
    }
    CHECK(counts.exact > 100);
    CHECK(counts.filtered > 100);
  }

  TEST_CASE("corners at the limit do not overflow") {
    exact::DecisionCounts counts;
    constexpr std::int32_t m = exact::corner_limit;
    constexpr std::uint32_t top = 0xffffffff;
    const InversePlane a(Triangle{{{-m, -m, top}, {m, -m, top}, {-m, m, top}}});
    const InversePlane b(Triangle{{{-m, -m, top}, {m, -m, top - 1}, {m, m, top}}});
    CHECK(compare_nearness(a, b, 4095, 4095, counts) == compare_nearness_exactly(a, b, 4095, 4095));
    CHECK(compare_nearness_exactly(a, b, 4096, -4096) < 0);    // there b has depth top - 1
    CHECK(compare_nearness_exactly(a, b, -4096, -4096) == 0);  // and there top, as a has everywhere
  }

  TEST_CASE("coverage and nearness are those of rays through triangles in space") {
    exact::DecisionCounts counts;
    tests::RandomTriangles random(3);
    constexpr int size = 6;
    std::uint64_t compared = 0;
    for (int scene = 0; scene < 12000; ++scene) {
      const auto kind = tests::all_kinds[static_cast<std::size_t>(scene) % tests::all_kinds.size()];
      const auto triangles = random.scene(kind, 2, size);
      const InversePlane a(triangles[0]), b(triangles[1]);
      const exact::Area area{0, 0, size - 1, size - 1};
      const auto rows_a = covered_rows(triangles[0], area), rows_b = covered_rows(triangles[1], area);
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const auto hit_a = oracle::cast_ray(for_oracle(triangles[0]), x, y);
          const auto hit_b = oracle::cast_ray(for_oracle(triangles[1]), x, y);
          REQUIRE(hit_a.has_value() == rows_a.covers(x, y));
          REQUIRE(hit_b.has_value() == rows_b.covers(x, y));
          if (!hit_a || !hit_b) continue;
          ++compared;
          const int expected = hit_a->compare(*hit_b) < 0 ? 1 : (hit_a->compare(*hit_b) > 0 ? -1 : 0);
          const auto found = compare_nearness(a, b, x, y, counts);
          REQUIRE((found > 0 ? 1 : (found < 0 ? -1 : 0)) == expected);
        }
      }
    }
    CHECK(compared > 5000);
  }

  TEST_CASE("coverage is the hardware's for corners on whole pixels") {
    // (2,0)(6,3)(0,7): rows 1: 2..3, 2: 2..4, 3: 2..5, 4: 1..4, 5: 1..2, 6: 1..1
    const Triangle t{{{512, 0, 1}, {1536, 768, 1}, {0, 1792, 1}}};
    const auto rows = covered_rows(t, {});
    CHECK(rows.top == 1);
    CHECK(rows.spans == std::vector<exact::Columns>{{2, 4}, {2, 5}, {2, 6}, {1, 5}, {1, 3}, {1, 2}});
    CHECK(rows.pixels() == 16);
  }

  TEST_CASE("coverage stays inside the area") {
    const Triangle t{{{-1024, -1024, 1}, {8192, -1024, 1}, {-1024, 8192, 1}}};
    const auto rows = covered_rows(t, {2, 3, 5, 4});
    CHECK(rows.top == 3);
    CHECK(rows.spans == std::vector<exact::Columns>{{2, 6}, {2, 6}});
    CHECK(covered_rows(t, {5, 0, 4, 9}).spans.empty());
  }
}
