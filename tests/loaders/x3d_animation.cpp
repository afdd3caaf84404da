#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "files.h"
#include "load/x3d/animation.h"

namespace {

using tests::refusal;

base::Result<load::LoadedScene> parse(const std::string& inside) {
  return load::parse_x3d("<X3D><Scene>\n" + inside + "\n</Scene></X3D>", {"s.x3d", "."});
}

// A scene whose Transform `T` (with a triangle in it) is driven by `interpolator` (DEF I) on `field`.
std::string driven(const std::string& interpolator, const std::string& field,
                   const std::string& clock = "cycleInterval='4' loop='true'") {
  return "<TimeSensor DEF='C' " + clock + "/>" + interpolator +
         "<Transform DEF='T'><Shape><TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 "
         "0'/></TriangleSet></Shape></Transform>"
         "<ROUTE fromNode='C' fromField='fraction_changed' toNode='I' toField='set_fraction'/>"
         "<ROUTE fromNode='I' fromField='value_changed' toNode='T' toField='" +
         field + "'/>";
}

// Where `point` of the first shape is at `seconds`.
glm::vec3 at(const std::string& scene_text, double seconds, const glm::vec3& point = glm::vec3(0)) {
  auto loaded = parse(scene_text);
  if (!loaded) FAIL(loaded.error().text);
  CHECK(loaded->warnings.empty());
  REQUIRE(loaded->scene.animate);
  loaded->scene.animate(loaded->scene.world, seconds);
  return glm::vec3(loaded->scene.world.instances.at(0).model * glm::vec4(point, 1));
}
bool is_near(const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-3F; }

const std::string path = "<PositionInterpolator DEF='I' key='0 0.5 1' keyValue='0 0 0 10 0 0 10 20 0'/>";

TEST_SUITE("loaders") {
  TEST_CASE("X3D: a PositionInterpolator moves a Transform evenly between its keys") {
    CHECK(is_near(at(driven(path, "translation"), 0), {0, 0, 0}));
    CHECK(is_near(at(driven(path, "translation"), 1), {5, 0, 0}));
    CHECK(is_near(at(driven(path, "set_translation"), 3), {10, 10, 0}));
  }

  TEST_CASE(
      "X3D: a looping clock begins again, another stays at its end; startTime is waited for; enabled='false' "
      "never runs") {
    CHECK(is_near(at(driven(path, "translation"), 5), {5, 0, 0}));
    CHECK(is_near(at(driven(path, "translation", "cycleInterval='4'"), 9), {10, 20, 0}));
    CHECK(is_near(at(driven(path, "translation", "cycleInterval='4' startTime='2'"), 1), {0, 0, 0}));
    CHECK(is_near(at(driven(path, "translation", "cycleInterval='4' startTime='2'"), 3), {5, 0, 0}));
    CHECK(is_near(at(driven(path, "translation", "cycleInterval='4' enabled='false'"), 1), {0, 0, 0}));
  }

  TEST_CASE("X3D: frames may be asked for in any order") {
    auto loaded = parse(driven(path, "translation"));
    loaded->scene.animate(loaded->scene.world, 3);
    loaded->scene.animate(loaded->scene.world, 1);
    CHECK(is_near(glm::vec3(loaded->scene.world.instances[0].model[3]), {5, 0, 0}));
  }

  TEST_CASE("X3D: an OrientationInterpolator turns at an even speed the short way round") {
    const std::string turn =
        "<OrientationInterpolator DEF='I' key='0 1' keyValue='0 0 1 0 0 0 1 1.5707963'/>";
    for (int step = 0; step < 16; ++step) {
      const double angle = 3.14159265 / 2 * step / 16;
      CHECK(is_near(at(driven(turn, "rotation"), step / 4.0, {1, 0, 0}),
                    glm::vec3(std::cos(angle), std::sin(angle), 0)));
    }
    const std::string back = "<OrientationInterpolator DEF='I' key='0 1' keyValue='0 0 1 0 0 0 1 6'/>";
    CHECK(at(driven(back, "rotation"), 2, {1, 0, 0}).y < 0);
  }

  TEST_CASE("X3D: a whole turn in quarters, as course scenes have it, goes all the way round") {
    const std::string turn =
        "<OrientationInterpolator DEF='I' key='0.00 0.25 0.50 0.75 1.00' keyValue='0 1 0 0 0 1 0 1.57079 "
        "0 1 0 3.14159 0 1 0 4.7123889 0 1 0 6.2831852'/>";
    CHECK(is_near(at(driven(turn, "rotation"), 1.5, {1, 0, 0}), {-std::sqrt(0.5F), 0, -std::sqrt(0.5F)}));
    CHECK(is_near(at(driven(turn, "rotation"), 3.5, {1, 0, 0}), {std::sqrt(0.5F), 0, std::sqrt(0.5F)}));
  }

  TEST_CASE(
      "X3D: a SplinePositionInterpolator passes through its values, and starts and ends at rest unless "
      "closed") {
    const std::string values = "key='0 0.25 0.5 0.75 1' keyValue='0 0 0 4 0 0 4 4 0 0 4 0 0 0 0'/>";
    const std::string open = "<SplinePositionInterpolator DEF='I' " + values;
    const std::string closed = "<SplinePositionInterpolator DEF='I' closed='true' " + values;
    for (const std::string& spline : {open, closed}) {
      CHECK(is_near(at(driven(spline, "translation"), 1), {4, 0, 0}));
      CHECK(is_near(at(driven(spline, "translation"), 2), {4, 4, 0}));
    }
    // Hermite by hand, half way in the first interval: 0.5 v0 + 0.5 v1 + 0.125 T0 - 0.125 T1, T1 = (2, 2, 0)
    // and T0 = 0 or, closed, (2, -2, 0).
    CHECK(is_near(at(driven(open, "translation"), 0.5), {1.75F, -0.25F, 0}));
    CHECK(is_near(at(driven(closed, "translation"), 0.5), {2, -0.5F, 0}));
  }

  TEST_CASE("X3D: a spline's speed does not jump at a key between intervals of different length") {
    const std::string spline =
        "<SplinePositionInterpolator DEF='I' key='0 0.1 0.5 1' keyValue='0 0 0 1 0 0 3 0 0 4 0 0'/>";
    const auto x = [&](double fraction) { return double{at(driven(spline, "translation"), 4 * fraction).x}; };
    const double before = (x(0.1) - x(0.0999)) / 0.0001, after = (x(0.1001) - x(0.1)) / 0.0001;
    CHECK(before == doctest::Approx(after).epsilon(0.05));
  }

  TEST_CASE("X3D: scale, centre and the camera can be driven, the field of view by a scalar") {
    CHECK(is_near(
        at(driven("<PositionInterpolator DEF='I' key='0 1' keyValue='1 1 1 3 1 1'/>", "scale"), 2, {1, 0, 0}),
        {2, 0, 0}));
    auto loaded = parse(
        "<Viewpoint DEF='V'/><TimeSensor DEF='C' cycleInterval='2'/>"
        "<ScalarInterpolator DEF='I' key='0 1' keyValue='0.5 2.6415927'/>"
        "<PositionInterpolator DEF='J' key='0 1' keyValue='0 0 0 0 0 8'/>"
        "<ROUTE fromNode='C' fromField='fraction_changed' toNode='I' toField='set_fraction'/>"
        "<ROUTE fromNode='C' fromField='fraction_changed' toNode='J' toField='set_fraction'/>"
        "<ROUTE fromNode='I' fromField='value_changed' toNode='V' toField='fieldOfView'/>"
        "<ROUTE fromNode='J' fromField='value_changed' toNode='V' toField='position'/>");
    REQUIRE(loaded);
    loaded->scene.animate(loaded->scene.world, 1);
    CHECK(loaded->scene.world.camera.tan_half_fov == doctest::Approx(1));
    CHECK(loaded->scene.world.camera.position.z == doctest::Approx(4));
  }

  TEST_CASE("X3D: what a ROUTE leads to and cannot be animated is named, and the rest moves") {
    const auto loaded =
        parse(driven(path, "translation") +
              "<ROUTE fromNode='I' fromField='value_changed' toNode='T' toField='bboxSize'/>"
              "<ROUTE fromNode='I' fromField='value_changed' toNode='X' toField='translation'/>");
    REQUIRE(loaded);
    REQUIRE(loaded->warnings.size() == 2);
    CHECK(loaded->warnings[0].find("'bboxSize' is not supported") != std::string::npos);
    CHECK(loaded->warnings[1].find("toNode 'X' names no DEF") != std::string::npos);
    CHECK(loaded->scene.animate);
  }

  TEST_CASE(
      "X3D: keys without values, falling keys and clocks that stand still are refused with their line") {
    CHECK(refusal(parse("<PositionInterpolator key='0 1' keyValue='0 0 0'/>")) ==
          "s.x3d:2: PositionInterpolator: keyValue has 3 numbers, expected 3 for each of 2 keys");
    CHECK(refusal(parse("<ScalarInterpolator key='1 0' keyValue='0 0'/>")).find("not in rising order") !=
          std::string::npos);
    CHECK(refusal(parse("<TimeSensor cycleInterval='0'/>")).find("not above 0") != std::string::npos);
    CHECK(parse("<SplinePositionInterpolator key='' keyValue=''/>"));
    CHECK(parse("<SplinePositionInterpolator key='0.5' keyValue='1 2 3' closed='true'/>"));
  }
}

}  // namespace
