#include "scene/project.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

#include "gte/commands.h"
#include "scene/angle.h"
#include "scene/submit.h"
#include "scene/view.h"

using scene::Placement;
using scene::Projected;
using scene::Transform;

namespace {

scene::Mesh cloud(int points, float size, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return (static_cast<float>(random() % 20001) / 10000.0F - 1) * size; };
  scene::Mesh mesh;
  for (int i = 0; i < points; ++i) {
    const float x = number();
    const float y = number();
    mesh.positions.emplace_back(x, y, number());
  }
  return mesh;
}

struct Fixture {
  explicit Fixture(Transform transform, float size = 1, double units = 2000) {
    mesh = cloud(500, size, 7);
    scene::Camera camera;
    camera.position = {0.3F, 0.2F, 2.5F * size};
    camera.orientation = scene::rotation_y(0.03) * scene::rotation_x(0.02);
    view = scene::view_of(camera, 320, 240, units);
    model = scene::make_model(mesh, {}, {}, {}, units, false);
    placement.model = &model;
    placement.projection = view.projection;
    placement.transform = transform;
    const glm::mat4 at = scene::rotation_z(0.07);
    placement.exact = scene::to_view(view, at, glm::dvec3(0), 1);
    REQUIRE(scene::set_transform(placement.registers, scene::to_view(view, at, model.centre, model.scale),
                                 view.projection));
    scene::project(placement, {true, true, false}, projected);
  }
  scene::Mesh mesh;
  scene::View view;
  scene::Model model;
  Placement placement;
  Projected projected;
};

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("the GTE projects a model's vertices as RTPS does, and its view positions are MAC1..3") {
    const Fixture f(Transform::gte);
    for (std::uint32_t i = 0; i < f.model.vertices.size(); ++i) {
      gte::Registers r = f.placement.registers;
      r.v[0] = f.model.vertices[i];
      gte::rtps(r);
      CHECK(f.projected.sxy[i] == r.sxy[2]);
      CHECK(f.projected.sz[i] == r.sz[3]);
      CHECK(f.placement.view_position(i) == glm::dvec3(r.mac[1], r.mac[2], r.mac[3]));
    }
  }

  TEST_CASE("a point is projected as a vertex in its place would be") {
    const Fixture f(Transform::gte);
    int checked = 0;
    for (std::uint32_t i = 0; i < f.model.vertices.size(); ++i) {
      if (f.projected.code[i] == scene::outcode::unprojectable) continue;
      const auto p = scene::project_point(f.placement, f.placement.view_position(i));
      CHECK(p.sxy == f.projected.sxy[i]);
      CHECK(p.sz == f.projected.sz[i]);
      ++checked;
    }
    CHECK(checked > 100);
  }

  TEST_CASE("float and double agree with the GTE within the rounding of its vertices and matrix") {
    const Fixture gte(Transform::gte);
    for (const auto transform : {Transform::float32, Transform::float64}) {
      const Fixture exact(transform);
      double worst = 0;
      for (std::size_t i = 0; i < gte.model.vertices.size(); ++i) {
        if (gte.projected.code[i] != 0 || exact.projected.code[i] != 0) continue;
        const auto at = [&](const Projected& p) {
          return glm::dvec2(p.sxy[i].x + p.fraction_x[i] / 256.0, p.sxy[i].y + p.fraction_y[i] / 256.0);
        };
        const auto d = at(gte.projected) - at(exact.projected);
        worst = std::max({worst, std::abs(d.x), std::abs(d.y)});
      }
      // Vertices and matrix are 2000 units long and exact to half a unit each, MAC is cut to whole units; a
      // unit is a tenth of a pixel where z is 2900.
      CHECK(worst < 0.5);
      CHECK(worst > 0);
    }
  }

  TEST_CASE("the fog's MAC0 overflow makes no vertex unprojectable") {
    Fixture f(Transform::gte);
    f.placement.registers.dqa.raw = -32768;
    f.placement.registers.dqb.raw = -0x7fffffff;
    Projected fogged;
    scene::project(f.placement, {false, false, true}, fogged);
    CHECK(fogged.code == f.projected.code);
  }

  TEST_CASE("IR0 of the depth cue is 0 at near, 1.0 at far and half way where 1/z is") {
    Fixture f(Transform::gte);
    scene::set_depth_cue(f.placement.registers, {true, {16, 32, 255}, 1, 4}, f.view);
    const auto fog_at = [&](double z) {
      gte::Registers r = f.placement.registers;
      r.rt = {};
      for (std::size_t i = 0; i < 3; ++i) r.rt[i][i].raw = 4096;
      r.tr = {0, 0, static_cast<std::int32_t>(z)};
      r.v[0] = {};
      gte::rtps(r);
      return static_cast<int>(r.ir[0]);
    };
    CHECK(std::abs(fog_at(2000)) <= 8);
    CHECK(std::abs(fog_at(8000) - 4096) <= 8);
    CHECK(std::abs(fog_at(3200) - 2048) <= 8);  // 1/3200 is the mean of 1/2000 and 1/8000
    CHECK(fog_at(20000) == 4096);
    CHECK(f.placement.registers.fc[2].raw == 255 * 16);
  }

  TEST_CASE("keys of the average are AVSZ3 and AVSZ4, and areas are NCLIP") {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
      std::array<scene::Corner, 4> corners;
      gte::Registers r;
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k].sz = r.sz[k] = static_cast<std::uint16_t>(random() >> (i % 5));
        const auto coordinate = [&] {
          return static_cast<std::int16_t>(static_cast<int>(random() % 2048) - 1024);
        };
        corners[k].sxy = {coordinate(), coordinate()};
        if (k < 3) r.sxy[k] = corners[k].sxy;
      }
      r.zsf3.raw = scene::zsf3;
      r.zsf4.raw = scene::zsf4;
      gte::avsz4(r);
      CHECK(scene::otz_of(corners, scene::Key::average) == r.otz);
      gte::avsz3(r);
      CHECK(scene::otz_of(std::span(corners).subspan(1), scene::Key::average) == r.otz);
      gte::nclip(r);
      CHECK(gte::signed_area(corners[0].sxy, corners[1].sxy, corners[2].sxy) == r.mac[0]);
    }
  }

  TEST_CASE("nearest and farthest keys stand on the scale of the average") {
    std::array<scene::Corner, 3> corners;
    corners[0].sz = 1000;
    corners[1].sz = 1600;
    corners[2].sz = 1300;
    CHECK(scene::otz_of(corners, scene::Key::nearest) == 2000);
    CHECK(scene::otz_of(corners, scene::Key::farthest) == 3200);
    CHECK(scene::otz_of(corners, scene::Key::average) == 2600);  // 2731 * 3900 >> 12
    corners[1].sz = 65535;
    CHECK(scene::otz_of(corners, scene::Key::farthest) == 65535);
  }

  TEST_CASE("a matrix that does not fit into 1.3.12 is refused") {
    gte::Registers r;
    const scene::Projection p;
    CHECK(scene::set_transform(r, {glm::dmat3(7.9), glm::dvec3(0)}, p));
    CHECK_FALSE(scene::set_transform(r, {glm::dmat3(8.0), glm::dvec3(0)}, p));
    CHECK_FALSE(scene::set_transform(r, {glm::dmat3(1.0), glm::dvec3(1e10, 0, 0)}, p));
    CHECK_FALSE(scene::set_transform(r, {glm::dmat3(std::nan("")), glm::dvec3(0)}, p));
  }

  TEST_CASE("a mesh too large for 16 bits is stored smaller, with the matrix to make up for it") {
    const auto mesh = cloud(50, 100, 1);
    const auto model = scene::make_model(mesh, {}, {}, {}, 1000, false);
    CHECK(model.scale < 400);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 back =
          model.centre +
          glm::dvec3(model.vertices[i].x, model.vertices[i].y, model.vertices[i].z) / model.scale;
      CHECK(std::abs(back.x - mesh.positions[i].x) <= 0.51 / model.scale);
      CHECK(std::abs(back.z - mesh.positions[i].z) <= 0.51 / model.scale);
    }
  }

  TEST_CASE("faces with vertices that are missing or not finite are left out") {
    scene::Mesh mesh = cloud(4, 1, 1);
    mesh.positions[3].y = std::nanf("");
    for (const std::uint32_t last : {2U, 3U, 4U, 0xfffffffeU}) {
      scene::Face face;
      face.vertex = {0, 1, last, scene::none};
      mesh.faces.push_back(face);
    }
    mesh.faces.push_back({});  // names no vertex at all
    mesh.lines.push_back({{0, 9}, {}, 0});
    const std::vector<scene::Material> materials(1);
    const auto model = scene::make_model(mesh, {}, materials, {}, 100, false);
    CHECK(model.faces.size() == 1);
    CHECK(model.lines.empty());
  }
}
