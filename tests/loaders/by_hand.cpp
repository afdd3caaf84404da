// Corners of the formats, each by hand.

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "files.h"
#include "load/faces.h"
#include "load/x3d/animation.h"

namespace {

using load::x3d::Track;
using scene::none;

std::vector<load::Piece> split(const std::vector<glm::vec3>& polygon) {
  std::uint64_t work = load::split_work;
  std::vector<load::Piece> pieces;
  load::split_polygon(polygon, work, pieces);
  return pieces;
}

base::Result<load::LoadedScene> x3d(const std::string& inside) {
  return load::parse_x3d("<X3D><Scene>" + inside + "</Scene></X3D>", {"s.x3d", "."});
}

/// Where a Transform stands at a fraction of one second, driven by a spline.
float driven(const std::string& spline, double seconds) {
  auto loaded =
      x3d("<TimeSensor DEF='C' cycleInterval='1' loop='true'/><SplinePositionInterpolator DEF='I' " + spline +
          "/><Transform DEF='T'><Shape><Box/></Shape></Transform>"
          "<ROUTE fromNode='C' fromField='fraction_changed' toNode='I' toField='set_fraction'/>"
          "<ROUTE fromNode='I' fromField='value_changed' toNode='T' toField='translation'/>");
  REQUIRE(loaded);
  loaded->scene.animate(loaded->scene.world, seconds);
  return loaded->scene.world.instances.at(0).model[3].x;
}

}  // namespace

TEST_SUITE("loaders") {
  TEST_CASE("A pentagram turns left at every corner and is no convex polygon for all that: it is no fan") {
    std::vector<glm::vec3> star;
    for (int i = 0; i < 5; ++i) {
      const double turn = 2 * i / 5.0 * 2 * 3.14159265358979;
      star.emplace_back(std::cos(turn), std::sin(turn), 0);
    }
    bool all_have_the_first = true;
    for (const auto& piece : split(star)) {
      all_have_the_first = all_have_the_first && (piece[0] == 0 || piece[1] == 0 || piece[2] == 0);
    }
    CHECK_FALSE(all_have_the_first);
  }

  TEST_CASE(
      "A quad is flat if its fourth corner is off by less than a thousandth of its size, bent if by more") {
    for (const float size : {1.0F, 1000.0F, 0.001F}) {
      const auto pieces = [size](float off) {
        return split({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, off * size}}).size();
      };
      CAPTURE(size);
      CHECK(pieces(0.0005F) == 1);
      CHECK(pieces(0.004F) == 2);
    }
  }

  TEST_CASE("OBJ: a fourth number of a v is a weight and no colour, and places nothing") {
    const auto plain = tests::obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto weighted = tests::obj("v 0 0 0 0.25\nv 1 0 0 0.5\nv 0 1 0 0.75\nf 1 2 3\n");
    REQUIRE(plain);
    REQUIRE(weighted);
    const auto &a = plain->scene.world.meshes[0], &b = weighted->scene.world.meshes[0];
    CHECK(a.positions == b.positions);
    CHECK(a.faces[0].colour == b.faces[0].colour);
  }

  TEST_CASE(
      "X3D: an open spline stands still at its ends, passes its keys, and leaves them along its neighbours") {
    const std::string path = "key='0 0.5 1' keyValue='0 0 0 8 0 0 12 0 0'";
    CHECK(driven(path, 0) == doctest::Approx(0));
    CHECK(driven(path, 0.5) == doctest::Approx(8));
    // Hermite half way: (p0 + p1) / 2 + (T0 - T1) / 8 with T0 = 0 and T1 = (12 - 0) / 2 of this interval.
    CHECK(driven(path, 0.25) == doctest::Approx(4 - 6.0 / 8));
    CHECK(driven(path, 0.75) == doctest::Approx(10 + 6.0 / 8));
    CHECK(std::abs(driven(path, 0.001)) < 0.001);  // the tangent at the end is nothing: it starts like t * t
  }

  TEST_CASE("X3D: two velocities are those of a spline's ends") {
    const std::string path = "key='0 1' keyValue='0 0 0 1 0 0' keyVelocity='4 0 0 -2 0 0'";
    CHECK(driven(path, 0.5) == doctest::Approx(0.5 + 4.0 / 8 + 2.0 / 8));
  }

  TEST_CASE(
      "X3D: of intervals of unlike length each has its share of a tangent, so that the speed does not jump") {
    const std::string path = "key='0 0.25 1' keyValue='0 0 0 1 0 0 4 0 0'";
    const double before = (driven(path, 0.25) - driven(path, 0.249)) / 0.001,
                 after = (driven(path, 0.251) - driven(path, 0.25)) / 0.001;
    CHECK(before == doctest::Approx(after).epsilon(0.05));
  }
}
