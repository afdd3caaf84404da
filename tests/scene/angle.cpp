#include "scene/angle.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("the sine of quarter turns is exact") {
    CHECK(scene::sin_turns(0) == 0);
    CHECK(scene::sin_turns(0.25) == 1);
    CHECK(scene::sin_turns(0.5) == 0);
    CHECK(scene::sin_turns(0.75) == -1);
    CHECK(scene::cos_turns(0) == 1);
    CHECK(scene::cos_turns(0.5) == -1);
  }

  TEST_CASE("the sine table is within 4e-7 of the sine, between its steps too") {
    double worst = 0;
    for (int i = -50000; i < 50000; ++i) {
      const double turns = i * 0.000123457;
      worst = std::max(worst, std::abs(scene::sin_turns(turns) - std::sin(turns * 2 * std::numbers::pi)));
    }
    CHECK(worst < 4e-7);
    CHECK(worst > 0);
  }

  TEST_CASE("the sine of an angle that is not finite is 0") {
    CHECK(scene::sin_turns(infinity) == 0);
    CHECK(scene::sin_turns(not_a_number) == 0);
    CHECK(scene::cos_turns(-infinity) == 0);
  }

  TEST_CASE("turns_of is the inverse of sine and cosine") {
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
      const double turns = i / 5000.0;
      worst = std::max(worst,
                       std::abs(scene::turns_of(scene::sin_turns(turns), scene::cos_turns(turns)) - turns));
    }
    CHECK(worst < 1e-6);
    CHECK(scene::turns_of(0, 0) == 0);
    CHECK(scene::turns_of(-1, 0) == doctest::Approx(0.75).epsilon(1e-6));
  }

  TEST_CASE("rotations are right-handed: a quarter turn about y takes +z to +x") {
    const glm::vec4 turned = scene::rotation_y(0.25) * glm::vec4(0, 0, 1, 0);
    CHECK(turned.x == doctest::Approx(1));
    CHECK(turned.z == doctest::Approx(0));
  }

  TEST_CASE("a rotation about a zero axis is the identity") {
    CHECK(scene::rotation({0, 0, 0}, 0.3) == glm::mat4(1.0F));
  }

  TEST_CASE("a camera looks at its target also when it looks straight down") {
    const auto m = scene::looking({0, 5, 0}, {0, 0, 0});
    CHECK(m[2].y == doctest::Approx(1));  // its +z points back, up
    const glm::vec3 right(m[0]);
    CHECK(glm::dot(right, right) == doctest::Approx(1));
  }

  TEST_CASE("rounding puts halves up and saturates") {
    CHECK(scene::round_saturated<std::int16_t>(1.5) == 2);
    CHECK(scene::round_saturated<std::int16_t>(-1.5) == -1);
    CHECK(scene::round_saturated<std::int16_t>(1e30) == 32767);
    CHECK(scene::round_saturated<std::int16_t>(-infinity) == -32768);
    CHECK(scene::round_saturated<std::uint32_t>(-0.6) == 0);
    CHECK(scene::round_saturated<std::int32_t>(not_a_number) == 0);
    CHECK(scene::floor_saturated<std::int32_t>(-0.25) == -1);
    CHECK(scene::floor_saturated<std::uint8_t>(300) == 255);
  }
}
