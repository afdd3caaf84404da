// For each cause the smallest frame that has it, with the pixels counted by hand, and one where it is absent.

#include <doctest/doctest.h>

#include "stage.h"

using inspect::Cause;
using tests::is_exactly;
using tests::Stage;

TEST_SUITE("inspect") {
  TEST_CASE("BlendOrder: the farther pane was drawn over the nearer one") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 300, {.bucket = 9});
    stage.quad(0, 0, 4, 4, 100, {.bucket = 5, .semi_transparent = true});
    stage.quad(2, 2, 6, 6, 200,
               {.bucket = 5, .semi_transparent = true});  // shares 2x2 pixels with the one before
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::blend_order, 4));
    CHECK(report.raw_count(Cause::bucket_tie) == 0);
    REQUIRE(report.pairs.size() == 1);
    CHECK(report.pairs[0].winner.draw == 2);
    CHECK(report.pairs[0].owner.draw == 1);
  }

  TEST_CASE("BlendOrder is absent: panes from far to near") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 300);
    stage.quad(2, 2, 6, 6, 200, {.semi_transparent = true});
    stage.quad(0, 0, 4, 4, 100, {.semi_transparent = true});
    CHECK(stage.report().wrong_pixels() == 0);
  }

  TEST_CASE("BlendOrder: a pane in front is hidden by the wall drawn after it") {
    Stage stage;
    stage.quad(0, 0, 4, 2, 100, {.semi_transparent = true});  // 8 pixels
    stage.quad(0, 0, 8, 8, 300);
    CHECK(is_exactly(stage.report(), Cause::blend_order, 8));
  }

  TEST_CASE("BlendOrder: a pane behind shines through the wall") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 300);
    stage.quad(0, 0, 4, 2, 400, {.semi_transparent = true});
    CHECK(is_exactly(stage.report(), Cause::blend_order, 8));
  }

  TEST_CASE("BlendOrder is absent: a pane as far as the wall may be over or under it") {
    Stage over, under;
    over.quad(0, 0, 8, 8, 300);
    over.quad(0, 0, 4, 2, 300, {.semi_transparent = true});
    CHECK(over.report().wrong_pixels() == 0);
    under.quad(0, 0, 4, 2, 300, {.semi_transparent = true});
    under.quad(0, 0, 8, 8, 300);
    CHECK(under.report().wrong_pixels() == 0);
  }

  // 1/z of the slanted quad is 1/100 - x/1200; it meets 1/150 at x = 4. So it is nearer at x 0..3, the two
  // are equal at x = 4, and the flat one is nearer at x 5..7.
  TEST_CASE("Interpenetration: the flat quad hides the nearer half of the slanted one") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100, 300, {.bucket = 7});
    stage.quad(0, 0, 8, 8, 150, {.bucket = 6});
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::interpenetration, 32));
    CHECK(report.raw_count(Cause::cyclic_overlap) == 32);  // each must be drawn before the other
    CHECK(report.raw_count(Cause::key_inversion) == 32);
  }

  TEST_CASE("Interpenetration is absent: the two share only pixels on which the flat one is not farther") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100, 300, {.bucket = 7});
    stage.quad(4, 0, 8, 8, 150, {.bucket = 6});
    CHECK(stage.report().wrong_pixels() == 0);
  }

  // Four strips like the flaps of a closed box, two pixels wide. Along each, z goes from 100 to
  // 300, so each lies under the next where they cross: top under right, right under bottom,
  // bottom under left, left under top.
  struct Flaps : Stage {
    explicit Flaps(int left_begins) {
      quad(0, 0, 8, 2, 100, 300, {.bucket = 8});
      upright(6, 0, 8, 8, 100, 300, {.bucket = 7});
      quad(0, 6, 8, 8, 300, 100, {.bucket = 6});
      upright(0, left_begins, 2, 8, 300, 100,
              {.bucket = 5});  // drawn last, on top of the top one: 2x2 pixels
    }
  };

  TEST_CASE("CyclicOverlap: four flaps, none of which can be drawn first") {
    Flaps flaps(0);
    const auto report = flaps.report();
    CHECK(is_exactly(report, Cause::cyclic_overlap, 4));
    CHECK(report.raw_count(Cause::key_inversion) == 4);
    CHECK(report.raw_count(Cause::interpenetration) == 0);
  }

  TEST_CASE("CyclicOverlap is absent: the last flap ends before the first") {
    Flaps flaps(2);
    CHECK(flaps.report().wrong_pixels() == 0);
  }

  TEST_CASE("BucketTie: two in one bucket, the farther one drawn last") {
    Stage stage;
    stage.quad(0, 0, 4, 4, 100, {.bucket = 3});
    stage.quad(2, 2, 6, 6, 200, {.bucket = 3});
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::bucket_tie, 4));
    CHECK(report.buckets.tied == 2);
    CHECK(report.raw_count(Cause::key_inversion) == 0);
  }

  TEST_CASE("BucketTie is absent: the nearer one drawn last, or nothing shared") {
    Stage lucky, apart;
    lucky.quad(2, 2, 6, 6, 200, {.bucket = 3});
    lucky.quad(0, 0, 4, 4, 100, {.bucket = 3});
    CHECK(lucky.report().wrong_pixels() == 0);
    apart.quad(0, 0, 4, 4, 100, {.bucket = 3});
    apart.quad(4, 4, 8, 8, 200, {.bucket = 3});
    CHECK(apart.report().wrong_pixels() == 0);
  }

  // A floor from z 100 to z 900 (average 500) and a box on its far end at z 600: the average
  // says the box is behind. At x = 6, 7 the floor's 1/z is 1/100 - x/900 = 1/300, 1/450: nearer
  // than 600. At x = 7.5 it is 1/600.
  TEST_CASE("KeyInversion: averages put the long floor in front of the box that stands on it") {
    Stage stage;
    stage.quad(7, 0, 8, 8, 400, {.bucket = 600});
    stage.quad(0, 0, 8, 8, 100, 900, {.bucket = 500});  // at x = 7 it is at z 450: behind the box
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::key_inversion, 8));
    REQUIRE(report.pairs.size() == 1);
    CHECK(report.pairs[0].winner_depth == doctest::Approx(450));
    CHECK(report.pairs[0].owner_depth == doctest::Approx(400));
    CHECK(inspect::id(0, report.pairs[0].winner) == "0:2:500");
  }

  TEST_CASE("KeyInversion is absent: keys by the farthest vertex") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100, 900, {.bucket = 900});
    stage.quad(7, 0, 8, 8, 400, {.bucket = 600});
    CHECK(stage.report().wrong_pixels() == 0);
  }

  TEST_CASE("ListOrder: without buckets the list alone is to blame") {
    Stage stage;
    stage.quad(0, 0, 4, 4, 100);
    stage.quad(0, 0, 4, 4, 200);
    const auto report = stage.report();
    CHECK(is_exactly(report, Cause::list_order, 16));
    CHECK(report.raw_count(Cause::bucket_tie) == 0);
    CHECK_FALSE(report.buckets.known);
    CHECK(inspect::to_text(report).find("buckets: not available") != std::string::npos);
  }

  TEST_CASE("ListOrder is absent: far to near") {
    Stage stage;
    stage.quad(0, 0, 4, 4, 200);
    stage.quad(0, 0, 4, 4, 100);
    CHECK(stage.report().wrong_pixels() == 0);
  }
}
