// Bytes touched, counted by hand on a wall that fills a known rectangle.

#include "cost/touched.h"

#include <doctest/doctest.h>

#include "scenes.h"

using namespace cost_test;

namespace {

/// One flat, untextured wall before an empty background.
scene::Scene one_wall() {
  scene::Scene s;
  s.name = "wall";
  s.world.units_per_world = 100;
  add_wall(s.world, -4, -3, 4, 3, -10, {200, 100, 50});
  return s;
}

cost::Touched touched_with(scene::Scene scene,
                           std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
  scene::Knobs knobs;
  knobs.colour = scene::Colour::bits15;
  for (const auto& [knob, value] : values) REQUIRE(scene::set_knob(knobs, knob, value));
  cost::Subject subject(std::move(scene), 0);
  const auto drawn = subject.draw(knobs);
  REQUIRE(drawn);
  const auto counted = cost::touched(subject, knobs, *drawn);
  REQUIRE(counted);
  return *counted;
}

constexpr std::uint64_t screen = 320 * 240;

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE(
      "a flat frame in VRAM touches its pixels twice, once filled and once drawn, and neither depth nor "
      "texels") {
    const auto console = touched_with(one_wall(), {});
    const auto wall = console.colour / 2 - screen;  // pixels of the wall
    CHECK(wall > 1000);
    CHECK(wall < screen);
    CHECK(console.depth == 0);
    CHECK(console.texels == 0);
    CHECK(console.filter == screen * (2 + 4));
    CHECK(console.list > 0);

    SUBCASE(
        "a z-buffer adds the box round the wall, which is cleared, and a key read and written for each "
        "pixel") {
      const auto deep = touched_with(one_wall(), {{"visibility", "zbuffer"}});
      CHECK(deep.colour == console.colour);
      const auto cleared = deep.depth - 8 * wall;
      CHECK(cleared >= 4 * wall);
      CHECK(cleared <= 4 * (wall + 240));  // one column more
    }
    SUBCASE("a canvas has samples of four bytes, four times as many at twice the resolution") {
      const auto fine = touched_with(one_wall(), {{"colour", "24"}});
      CHECK(fine.colour == 4 * (screen + wall));
      CHECK(fine.filter == screen * (4 + 4));
      const auto doubled = touched_with(one_wall(), {{"colour", "24"}, {"resolution", "2"}});
      CHECK(doubled.filter == 4 * fine.filter);
      CHECK(doubled.colour > 3.9 * static_cast<double>(fine.colour));
    }
    SUBCASE("four samples touch four times the colour, and the filter reads each of them") {
      const auto one = touched_with(one_wall(), {{"colour", "24"}});
      for (const auto* samples : {"rotated-4", "msaa-4"}) {
        const auto four = touched_with(one_wall(), {{"colour", "24"}, {"antialias", samples}});
        CHECK(static_cast<double>(four.colour) ==
              doctest::Approx(4.0 * static_cast<double>(one.colour)).epsilon(0.01));
        CHECK(four.filter == screen * (4 * 4 + 4));
      }
    }
  }

  TEST_CASE(
      "texels touch what their filter reads: four times as much bilinear, four bytes of every tap of a mip "
      "map") {
    const auto nearest = touched_with(runway(false), {{"colour", "24"}}).texels;
    CHECK(nearest > 4 * 1000);
    CHECK(touched_with(runway(false), {}).texels == nearest);  // the console's target reads the same
    CHECK(touched_with(runway(false), {{"colour", "24"}, {"filter", "bilinear"}}).texels == 4 * nearest);
    CHECK(touched_with(runway(false), {{"colour", "24"}, {"filter", "mipmap"}}).texels == 4 * nearest);
    CHECK(touched_with(runway(false), {{"colour", "24"}, {"filter", "mipmap-linear"}}).texels == 8 * nearest);
  }
}
