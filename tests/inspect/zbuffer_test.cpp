// What a z-buffer gets wrong, and what helps.

#include <doctest/doctest.h>

#include "demos/demos.h"
#include "stage.h"
#include "watcher.h"

using inspect::Cause;
using tests::is_exactly;
using tests::Stage;

namespace {

gpu::DepthOptions options(gpu::DepthFormat format, double near_z, double far_z) {
  gpu::DepthOptions o;
  o.format = format;
  o.near_z = near_z;
  o.far_z = far_z;
  return o;
}

// A decal at z 900 on a wall at z 900.5; the farther one first, or the nearer one.
std::uint64_t wrong_on_decal(const gpu::DepthOptions& depth, bool decal_first) {
  Stage stage(depth);
  const auto wall = [&] {
    stage.raw_polygon({{0, 0, 3688448}, {8, 0, 3688448}, {0, 8, 3688448}, {8, 8, 3688448}}, {});
  };
  const auto decal = [&] { stage.quad(2, 2, 6, 6, 900); };
  if (decal_first) decal();
  wall();
  if (!decal_first) decal();
  const auto report = stage.report();
  CHECK(report.count(Cause::depth_tie) == report.wrong_pixels());
  return report.wrong_pixels();
}

}  // namespace

TEST_SUITE("inspect") {
  // 16 bits, near 16, far 65535, hyperbolic: z 40000 and 40010 are both stored as
  // round(65535/65519 * (1 - 16/z) * 65535) = 65525. With `less` the first of equals stays.
  TEST_CASE("DepthTie: two depths that 16 bits cannot tell apart") {
    Stage stage(options(gpu::DepthFormat::bits16, 16, 65535));
    stage.quad(0, 0, 4, 4, 40010);
    stage.quad(2, 2, 6, 6, 40000);
    CHECK(is_exactly(stage.report(), Cause::depth_tie, 4));
  }

  TEST_CASE("DepthTie is absent: the nearer one comes first, or there are 32 bits") {
    Stage first(options(gpu::DepthFormat::bits16, 16, 65535));
    first.quad(2, 2, 6, 6, 40000);
    first.quad(0, 0, 4, 4, 40010);
    CHECK(first.report().wrong_pixels() == 0);
    Stage fine(options(gpu::DepthFormat::bits32, 16, 65535));
    fine.quad(0, 0, 4, 4, 40010);
    fine.quad(2, 2, 6, 6, 40000);
    CHECK(fine.report().wrong_pixels() == 0);
  }

  // Rounding alone keeps the order of depths. But the rasterizer steps along a row with depths that were cut
  // to 18 bits of fraction at the corners, and just beside the point where rounding goes up that is enough.
  // 16 bits, near 16, far 65535: z is stored as round(65535 / 65519 * (1 - 16 / z) * 65535).
  //   slanted, x = 0: z 62788.66357  65534.29999922   cut to 65534.29999542
  //            x = 2: z 64329.14136  65534.70000455   cut to 65534.70000076
  //            x = 1: z 63549.56832  65534.50000188   stepped to 65534.49999809: stored as 65534
  //   flat,    x = 1: z 63549.56128  65534.50000005   cut to 65534.50000000: stored as 65535, and yet it is
  //   nearer
  TEST_CASE("DepthPrecision: stored depths that have the wrong order") {
    Stage stage(options(gpu::DepthFormat::bits16, 16, 65535));
    stage.raw_polygon({{1, 0, 260299003}, {2, 0, 260299003}, {1, 1, 260299003}, {2, 1, 260299003}}, {});
    stage.raw_polygon({{0, 0, 257182366}, {2, 0, 263492163}, {0, 1, 257182366}, {2, 1, 263492163}}, {});
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::depth_precision, 1));
    REQUIRE(report.wrong.size() == 1);
    CHECK(report.wrong[0].pixel == 1);
    CHECK(report.wrong[0].winner == 1);
    CHECK(report.wrong[0].owner == 0);
  }

  TEST_CASE("DepthPrecision is absent: stored depths in the right order") {
    Stage stage(options(gpu::DepthFormat::bits24, 16, 65535));
    stage.quad(0, 0, 4, 2, 100);
    stage.quad(0, 0, 4, 2, 200);
    CHECK(stage.report().wrong_pixels() == 0);
  }

  TEST_CASE("panes behind a wall do not show through a z-buffer, in whatever order they come") {
    Stage stage(options(gpu::DepthFormat::bits24, 16, 65535));
    stage.quad(0, 0, 8, 8, 150, {.semi_transparent = true});
    stage.quad(0, 0, 4, 4, 300, {.semi_transparent = true});
    stage.quad(0, 0, 8, 8, 200);
    stage.quad(0, 0, 8, 8, 100, {.semi_transparent = true});
    CHECK(stage.report().wrong_pixels() == 0);
  }

  // Test `less`. Wrong pixels of 16 (the decal's), the wall submitted first and the decal first:
  //   16 bits, near 16, far 65535      16   0
  //   more bits: 24                     0   0
  //   farther near plane: 800           0   0
  //   nearer far plane: 1000           16   0   (the near plane decides: far/(far-near) hardly changes)
  TEST_CASE(
      "the three remedies for z-fighting: more bits and a farther near plane help, a nearer far plane "
      "hardly") {
    using gpu::DepthFormat;
    struct Row {
      gpu::DepthOptions depth;
      std::uint64_t wall_first, decal_first;
    };
    const Row table[]{{options(DepthFormat::bits16, 16, 65535), 16, 0},
                      {options(DepthFormat::bits24, 16, 65535), 0, 0},
                      {options(DepthFormat::bits16, 800, 65535), 0, 0},
                      {options(DepthFormat::bits16, 16, 1000), 16, 0}};
    for (const Row& row : table) {
      CAPTURE(row.depth.near_z);
      CAPTURE(row.depth.far_z);
      CHECK(wrong_on_decal(row.depth, false) == row.wall_first);
      CHECK(wrong_on_decal(row.depth, true) == row.decal_first);
    }
  }

  TEST_CASE("a 32-bit z-buffer shows no wrong pixel on any demo") {
    for (const auto& entry : demos::all()) {
      CAPTURE(entry.name);
      tests::Watcher watcher(entry,
                             {.visibility = scene::Visibility::zbuffer, .depth = scene::DepthFormat::bits32});
      for (const std::uint32_t frame : {0U, 33U, 77U}) {
        const auto report = watcher.frame(frame);
        CHECK(report.wrong_pixels() == 0);
        CHECK(report.polygons_judged > 0);
      }
    }
  }
}
