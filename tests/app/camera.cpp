#include "app/window/camera.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>

#include "app/window/held_keys.h"

namespace {

constexpr double quarter = std::numbers::pi / 2;

bool near(glm::vec3 a, glm::vec3 b) { return glm::length(a - b) < 1e-5F; }

glm::vec3 forward(const scene::Camera& camera) {
  return glm::vec3(camera.orientation * glm::vec4(0, 0, -1, 0));
}

// Looks along -z from (0,0,10) at the origin.
scene::Camera start_camera() {
  scene::Camera camera;
  camera.position = {0, 0, 10};
  return camera;
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("a camera that nobody moved is the scene's, bit for bit") {
    auto camera = start_camera();
    camera.position = {0.1F, 0.2F, 0.3F};
    const auto same = app::moved(camera, {}, 7);
    CHECK(same.position == camera.position);
    CHECK(same.orientation == camera.orientation);
  }

  TEST_CASE("a quarter orbit stands beside the pivot and looks at it") {
    app::CameraOffset offset;
    app::orbit(offset, quarter, 0);
    const auto camera = app::moved(start_camera(), offset, 10);
    CHECK(near(camera.position, {10, 0, 0}));
    CHECK(near(forward(camera), {-1, 0, 0}));
  }

  TEST_CASE("an orbit stops straight above the pivot") {
    app::CameraOffset offset;
    app::orbit(offset, 0, -100);
    const auto camera = app::moved(start_camera(), offset, 10);
    CHECK(near(camera.position, {0, 10, 0}));
  }

  TEST_CASE("looking round leaves the eye where it is") {
    app::CameraOffset offset;
    app::look(offset, quarter, 0);
    const auto camera = app::moved(start_camera(), offset, 10);
    CHECK(near(camera.position, {0, 0, 10}));
    CHECK(near(forward(camera), {-1, 0, 0}));
  }

  TEST_CASE("zooming moves along the line to the pivot, never through it") {
    app::CameraOffset offset;
    app::zoom(offset, 1);
    CHECK(near(app::moved(start_camera(), offset, 10).position, {0, 0, 9}));
    app::zoom(offset, 10000);
    CHECK(app::moved(start_camera(), offset, 10).position.z > 0);
  }

  TEST_CASE("flying follows the way the camera looks") {
    app::CameraOffset offset;
    app::look(offset, quarter, 0);
    app::fly(offset, start_camera(), {0, 0, -1}, 2);
    CHECK(near(app::moved(start_camera(), offset, 10).position, {-2, 0, 10}));
  }

  TEST_CASE("a camera's five numbers are read back as they were written") {
    const app::CameraPlace place{{0.1F, -2.5F, 1e-3F}, -179.999, 12.345};
    const auto read = app::parse_camera(app::to_text(place));
    REQUIRE(read);
    CHECK(*read == place);
    CHECK(app::to_text({{1, 0, -3}, 90, 0}) == "1,0,-3,90,0");
  }

  TEST_CASE("what is not five numbers is no camera, and the error names it") {
    for (const std::string text : {"", "1,2,3,4", "1,2,3,4,5,6", "1,2,3,4,x", "1,2,3,4,5 ", "nan,0,0,0,0",
                                   "1e30,0,0,0,0", "0,0,0,0,91"}) {
      CAPTURE(text);
      const auto read = app::parse_camera(text);
      REQUIRE_FALSE(read);
      CHECK(read.error().text.find("--camera") != std::string::npos);
      CHECK(read.error().text.find("'" + text + "'") != std::string::npos);
    }
  }

  TEST_CASE("yaw turns to the left, pitch up; at 0, 0 a camera looks along -z") {
    CHECK(near(forward(app::camera_at({}, {{}, 0, 0})), {0, 0, -1}));
    CHECK(near(forward(app::camera_at({}, {{}, 90, 0})), {-1, 0, 0}));
    CHECK(near(forward(app::camera_at({}, {{}, 0, 90})), {0, 1, 0}));
  }

  TEST_CASE("wherever the user has gone, the five numbers put a camera there, bit for bit") {
    scene::Camera tilted = start_camera();
    tilted.orientation =
        glm::rotate(glm::rotate(glm::mat4(1.0F), 0.7F, glm::vec3(0, 1, 0)), 0.3F, glm::vec3(0, 0, 1));
    for (const auto& base : {start_camera(), tilted}) {
      app::CameraOffset offset;
      app::orbit(offset, 0.3, -0.2);
      app::look(offset, 1.1, 0.4);
      app::zoom(offset, 2);
      app::fly(offset, base, {0.1F, 0.2F, 0.3F}, 7);
      const auto there = app::moved(base, offset, 7);
      const auto read = app::parse_camera(app::to_text(app::place_of(base, offset, 7)));
      REQUIRE(read);
      const auto placed = app::moved(base, {.from = *read}, 3);
      CHECK(placed.position == there.position);
      CHECK(placed.orientation == there.orientation);
    }
  }

  TEST_CASE("from a place of one's own the camera orbits and flies on") {
    app::CameraOffset offset{.from = app::CameraPlace{{0, 0, 4}, 0, 0}};
    app::fly(offset, start_camera(), {0, 0, -1}, 1);
    CHECK(near(app::moved(start_camera(), offset, 2).position, {0, 0, 3}));
  }

  TEST_CASE("the pivot is as far away as the middle of the world") {
    scene::World world;
    world.camera = start_camera();
    world.meshes.resize(1);
    world.meshes[0].positions = {{-1, -1, -1}, {1, 1, 1}};
    CHECK(app::pivot_distance(world) == doctest::Approx(1));  // no instance: any distance serves
    world.instances.push_back({});
    CHECK(app::pivot_distance(world) == doctest::Approx(6.9282F));  // 10, but at most twice the world's size
    world.camera.position = {0, 0, 5};
    CHECK(app::pivot_distance(world) == doctest::Approx(5));
    world.camera.position = {0, 0, -5};  // behind the camera: a hundredth of the size
    CHECK(app::pivot_distance(world) == doctest::Approx(0.034641F));
  }

  TEST_CASE("a held key moves, opposite keys cancel, a released one stops") {
    app::HeldKeys held;
    CHECK(held.press("W", 0));
    CHECK(held.motion(0).fly == glm::vec3(0, 0, -1));
    held.press("S", 0);
    CHECK_FALSE(held.motion(0).any());
    held.release("W", 1);
    CHECK(held.motion(1).fly == glm::vec3(0, 0, 1));
    held.release_all();
    CHECK_FALSE(held.motion(1).any());
  }

  TEST_CASE("D tapped is a key of the table, D held flies right") {
    app::HeldKeys held;
    held.press("D", 0);
    CHECK_FALSE(held.motion(0.1).any());
    CHECK(held.release("D", 0.1));
    held.press("D", 1);
    held.press("D", 1.15);  // the keyboard's own repeat
    CHECK(held.motion(1.3).fly == glm::vec3(1, 0, 0));
    CHECK_FALSE(held.release("D", 1.3));
  }

  TEST_CASE("W, A and S have no other meaning, whether tapped or held") {
    app::HeldKeys held;
    held.press("W", 0);
    CHECK_FALSE(held.release("W", 0.05));
    CHECK_FALSE(held.press("V", 0));
  }
}
