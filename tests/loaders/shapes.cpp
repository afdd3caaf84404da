#include "scene/shapes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "load/faces.h"

namespace {

using scene::Mesh, scene::Face;

const std::vector<std::pair<const char*, Mesh>>& solids() {
  static const std::vector<std::pair<const char*, Mesh>> all{{"box", scene::box({2, 3, 4})},
                                                             {"sphere", scene::sphere(2)},
                                                             {"cylinder", scene::cylinder(1, 2)},
                                                             {"cone", scene::cone(1, 2)}};
  return all;
}

glm::vec3 face_normal(const Mesh& mesh, const Face& f) {
  const glm::vec3 &a = mesh.positions[f.vertex[0]], &b = mesh.positions[f.vertex[1]],
                  &c = mesh.positions[f.vertex[2]];
  return glm::normalize(glm::cross(b - a, c - a));
}

TEST_SUITE("loaders") {
  TEST_CASE("every solid is closed and faces outwards") {
    for (const auto& solid : solids()) {
      const char* name = solid.first;
      const Mesh& mesh = solid.second;
      CAPTURE(name);
      for (const bool closed : load::faces_of_closed_surfaces(mesh)) CHECK(closed);
    }
  }

  TEST_CASE("normals have length one and lie within 60 degrees of their face's own") {
    for (const auto& solid : solids()) {
      const char* name = solid.first;
      const Mesh& mesh = solid.second;
      CAPTURE(name);
      if (mesh.normals.empty()) continue;
      REQUIRE(mesh.normals.size() == mesh.positions.size());
      for (const Face& f : mesh.faces) {
        for (const std::uint32_t v : f.vertex) {
          if (v == scene::none) continue;
          CHECK(glm::length(mesh.normals[v]) == doctest::Approx(1));
          CHECK(glm::dot(mesh.normals[v], face_normal(mesh, f)) > 0.5F);
        }
      }
    }
  }

  TEST_CASE("solids have the size asked for, centred on the origin") {
    for (const auto& solid : solids()) {
      const char* name = solid.first;
      const Mesh& mesh = solid.second;
      CAPTURE(name);
      load::Bounds bounds;
      for (const glm::vec3& p : mesh.positions) bounds.include(p);
      CHECK(glm::length(bounds.centre()) < 1e-6F);
      const glm::vec3 size = bounds.high - bounds.low;
      const std::string shape = name;
      const glm::vec3 expected = shape == "box"      ? glm::vec3(2, 3, 4)
                                 : shape == "sphere" ? glm::vec3(4)
                                                     : glm::vec3(2);
      CHECK(glm::length(size - expected) < 1e-5F);
    }
  }

  TEST_CASE("a box shows the whole picture upright on each side") {
    const Mesh mesh = scene::box({1, 1, 1});
    const Face& front = mesh.faces[0];
    CHECK(face_normal(mesh, front) == glm::vec3(0, 0, 1));
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::vec3& p = mesh.positions[front.vertex[i]];
      CHECK(front.uv[i] == glm::vec2(p.x + 0.5F, 0.5F - p.y));
    }
  }

  TEST_CASE("round a sphere the picture's left edge is at the back and a quarter of it is on the left") {
    const Mesh mesh = scene::sphere(1);
    for (const Face& f : mesh.faces) {
      for (std::size_t i = 0; i < 4 && f.is_quad(); ++i) {
        const glm::vec3& p = mesh.positions[f.vertex[i]];
        if (f.uv[i].x == 0 || f.uv[i].x == 1) CHECK((p.z < 0 && std::abs(p.x) < 1e-6F));
        if (f.uv[i].x == 0.25F) CHECK((p.x < 0 && std::abs(p.z) < 1e-6F));
        if (f.uv[i].x == 0.5F) CHECK((p.z > 0 && std::abs(p.x) < 1e-6F));
      }
    }
  }

  TEST_CASE("a cylinder without its lids is its side alone, and is open") {
    const Mesh tube = scene::cylinder(1, 2, {.top = false, .bottom = false});
    CHECK(tube.faces.size() == 32);
    CHECK(!load::faces_of_closed_surfaces(tube)[0]);
  }
}

}  // namespace
