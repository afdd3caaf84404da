// Which of two surfaces is nearer: the floating-point filter against integers that never round.

#include <doctest/doctest.h>

#include "exact/depth_order.h"
#include "inspect/random_triangles.h"
#include "stability/measure.h"

using exact::DecisionCounts;
using exact::InversePlane;
using stability::Measure;

namespace {

/// 1 if the filtered comparison says something else than the exact one.
int contradiction(const InversePlane& a, const InversePlane& b, int x, int y, DecisionCounts& counts) {
  return compare_nearness(a, b, x, y, counts) != compare_nearness_exactly(a, b, x, y);
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("The depth filter agrees with wide integers on random triangles of every kind") {
    Measure wrong{"10. Exact predicates",
                  "random pairs: sub-pixel, coplanar, nearly coplanar, sharing corners, extreme depths; "
                  "samples inside and 4,096 pixels outside",
                  "a filter that trusts a rounding",
                  "the exact answer",
                  "contradictions",
                  0};
    DecisionCounts counts;
    tests::RandomTriangles random(110);
    for (const auto kind : tests::all_kinds) {
      const auto triangles = random.scene(kind, 2000, 8);
      for (std::size_t i = 0; i + 1 < triangles.size(); ++i) {
        const InversePlane a(triangles[i]), b(triangles[i + 1]);
        if (a.is_degenerate() || b.is_degenerate()) continue;
        for (const int x : {-4096, 0, 3, 8, 4096}) {
          wrong.see(contradiction(a, b, x, random.between(-9, 9), counts));
        }
      }
    }
    CHECK(counts.filtered > 1000);
    CHECK(counts.exact > 1000);
  }

  TEST_CASE("The depth filter hands over planes that differ by a unit in the last place") {
    Measure wrong{"10. Exact predicates",
                  "a plane and the same with one depth moved by -1, 0 or 1 unit of 2^-12; corners at the "
                  "limits of coordinates, depths at both ends",
                  "two nearly coplanar surfaces in the wrong order",
                  "the exact answer",
                  "contradictions",
                  0};
    DecisionCounts counts;
    tests::RandomTriangles random(111);
    constexpr std::array sizes{256, 8 * 256, 1023 * 256, exact::corner_limit};
    for (int i = 0; i < 20'000; ++i) {
      const int size = sizes[static_cast<std::size_t>(i) % sizes.size()];
      exact::Triangle t;
      for (auto& corner : t) {
        corner.x = random.between(-size, size);
        corner.y = random.between(-size, size);
        switch (random.between(0, 3)) {
          case 0:
            corner.z = static_cast<std::uint32_t>(random.between(2, 9));
            break;
          case 1:
            corner.z = 0xffffffff - static_cast<std::uint32_t>(random.between(1, 9));
            break;
          default:
            corner.z = static_cast<std::uint32_t>(random.between(2, 0x7ffffffe));
        }
      }
      auto moved = t;
      auto& z = moved[static_cast<std::size_t>(random.between(0, 2))].z;
      z = static_cast<std::uint32_t>(std::int64_t{z} + random.between(-1, 1));
      const InversePlane a(t), b(moved);
      if (a.is_degenerate()) continue;
      // At a corner, where weights vanish, somewhere, and far away.
      wrong.see(contradiction(a, b, t[0].x / 256, t[0].y / 256, counts));
      wrong.see(contradiction(a, b, random.between(-40, 40), random.between(-40, 40), counts));
      wrong.see(contradiction(a, b, 4096, -4096, counts));
    }
    CHECK(counts.filtered > 1000);
    CHECK(counts.exact > 1000);
  }
}
