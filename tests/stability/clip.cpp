// Near-plane crossings at every angle, and cameras and models at their limits.

#include "scene/clip.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/angle.h"
#include "scene/frame.h"
#include "scene/pipeline.h"
#include "scene/project.h"
#include "scene/shapes.h"
#include "stability/measure.h"
#include "stability/triangulation.h"

using glm::dvec3;
using scene::Clipper;
using scene::ClipPolygon;
using scene::Projection;
using stability::Measure;
using stability::Random;

namespace {

double area(const std::vector<dvec3>& polygon) {
  dvec3 sum{0.0};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return glm::length(sum) / 2;
}

/// The part of a triangle with z >= near, computed on its own: Sutherland-Hodgman against one plane.
std::vector<dvec3> beyond_near(const std::array<dvec3, 3>& t, double near_z) {
  std::vector<dvec3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 a = t[i], b = t[(i + 1) % 3];
    if (a.z >= near_z) out.push_back(a);
    if ((a.z >= near_z) != (b.z >= near_z)) out.push_back(a + (b - a) * ((near_z - a.z) / (b.z - a.z)));
  }
  return out;
}

ClipPolygon polygon_of(const std::array<dvec3, 3>& t) {
  ClipPolygon p;
  for (const auto& v : t) p.add({.position = v});
  return p;
}

std::vector<dvec3> clipped(const Clipper& clipper, const std::array<dvec3, 3>& t) {
  ClipPolygon in = polygon_of(t), out;
  clipper.clip(in, out);
  std::vector<dvec3> positions;
  for (std::size_t i = 0; i < out.count; ++i) positions.push_back(out.vertex[i].position);
  return positions;
}

/// A point on a sphere that is well spread whatever the generator gives.
dvec3 direction(Random& random) {
  for (;;) {
    const dvec3 v{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const double size = glm::length(v);
    if (size > 0.1 && size <= 1) return v / size;
  }
}

struct Shown {
  int pixels = 0;                      // that are not the background
  std::vector<std::uint16_t> picture;  // 320 x 240
};

/// Frame 0 of a world through the whole line.
base::Result<Shown> show(const scene::Scene& scene) {
  const scene::Knobs knobs;
  scene::FrameBuilder builder(scene, knobs);
  static ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  const auto stats = scene::render_frame(builder, 0, knobs, ram, gpu);
  if (!stats) return tl::make_unexpected(stats.error());
  Shown shown;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      shown.picture.push_back(gpu.vram().at(x, y));
      shown.pixels += shown.picture.back() != 0;
    }
  }
  return shown;
}

scene::Scene one_box(const glm::mat4& model) {
  scene::Scene scene;
  scene.world.meshes.push_back(scene::box({1, 1, 1}));
  for (auto& face : scene.world.meshes[0].faces) face.colour.fill({200, 100, 50});
  scene.world.instances.push_back({0, model});
  scene.world.camera.position = {0, 0, 4};
  return scene;
}

/// A colour for each side of a box, taken from where the side lies after `mirror`.
void colour_sides(scene::Mesh& mesh, glm::vec3 mirror) {
  for (auto& face : mesh.faces) {
    glm::vec3 middle{0};
    for (std::size_t v = 0; v < (face.is_quad() ? 4U : 3U); ++v)
      middle += mesh.positions[face.vertex[v]] * mirror;
    const auto level = [](float side) {
      return static_cast<std::uint8_t>(side > 1 ? 240 : side < -1 ? 40 : 120);
    };
    face.colour.fill({level(middle.x), level(middle.y), level(middle.z)});
  }
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Triangles that cross the near plane at any angle keep exactly the part behind it") {
    Measure lost{"7. Perspective",
                 "100,000 triangles at random angles across the near plane, exact clipping",
                 "a clipped triangle that vanishes or explodes",
                 "the area beyond the plane, to 1e-9 of the whole",
                 "of the triangle",
                 1e-9};
    Measure moved{"7. Perspective",
                  "the same, rounded to the GTE's whole units",
                  "vertices nearer than H/2, whose quotient overflows",
                  "every new vertex within 1.5 units of the exact edge, none nearer than the near plane",
                  "units",
                  1.5};
    Measure apart{"7. Perspective",
                  "two triangles with a common edge, cut at it, either way round",
                  "a crack at the near plane",
                  "the same vertex to the last bit",
                  "edges",
                  0};
    const Projection projection;
    const Clipper exact(projection, false), whole(projection, true);
    const double near_z = projection.near_z;
    Random random(70);
    for (int i = 0; i < 100'000; ++i) {
      // Inside the guard band wherever z allows, so that the near plane alone cuts.
      const dvec3 centre{random.real(-20, 20), random.real(-20, 20), near_z + random.real(-20, 20)};
      const dvec3 u = direction(random), v = direction(random);
      const double size = random.real(1, 45);
      const std::array<dvec3, 3> t{centre + u * size, centre + v * size, centre - (u + v) * size};
      const double all = area({t[0], t[1], t[2]});
      lost.see(std::abs(area(clipped(exact, t)) - area(beyond_near(t, near_z))) / std::max(all, 1.0));
      double worst = 0;
      for (const auto& p : clipped(whole, t)) {
        if (p.z < near_z) worst = 1e9;
        double nearest = 1e9;  // to the exact outline: its edges, by distance from a segment
        const auto outline = beyond_near(t, near_z);
        for (std::size_t e = 0; e < outline.size(); ++e) {
          const dvec3 a = outline[e], b = outline[(e + 1) % outline.size()];
          const double along = glm::dot(b - a, b - a) > 0
                                   ? std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0)
                                   : 0;
          nearest = std::min(nearest, glm::length(p - (a + (b - a) * along)));
        }
        worst = std::max(worst, nearest);
      }
      moved.see(worst);
      // A neighbour at the other side of edge 0-1, which it names the other way round.
      const std::array<dvec3, 3> neighbour{t[1], t[0], t[0] + t[1] - t[2]};
      const auto here = clipped(whole, t), there = clipped(whole, neighbour);
      const bool crosses = (t[0].z < near_z) != (t[1].z < near_z);
      const auto common = std::ranges::count_if(
          here, [&](const dvec3& p) { return std::ranges::find(there, p) != there.end(); });
      apart.see(crosses && common < 2 ? 1 : 0);
    }
  }

  TEST_CASE("No camera or model matrix makes a frame fail, crash or explode") {
    Measure bad{"11. Cameras and scenes",
                "boxes under gimbal poses, zero, tiny, huge, negative and non-finite scales and places",
                "a division by zero, a NaN, a face that fills the screen",
                "a frame; what cannot be drawn is counted as dropped",
                "frames",
                0};
    std::vector<glm::mat4> models;
    const float huge = 1e30F, tiny = 1e-30F, inf = HUGE_VALF, nan = std::nanf("");
    for (const float s : {0.0F, tiny, 1e-3F, 1.0F, -1.0F, 1e3F, huge, -huge, inf, nan}) {
      models.push_back(scene::scaling({s, s, s}));
      models.push_back(scene::scaling({s, 1, 1}));
      models.push_back(scene::translation({s, 0, 0}));
      models.push_back(scene::translation({0, 0, s}));
    }
    for (const double turns : {0.0, 0.25, 0.5, 0.75, 0.2499999, 1e9}) {
      models.push_back(scene::rotation_x(turns) * scene::rotation_y(0.25) * scene::rotation_z(turns));
    }
    for (const auto& model : models) {
      const auto shown = show(one_box(model));
      bad.see(shown ? 0 : 1);
    }
  }

  TEST_CASE("A mirrored model shows its own outside") {
    Measure wrong{"11. Cameras and scenes",
                  "a box with six colours mirrored along x, y, z and all of them",
                  "back faces shown instead of front faces",
                  "the picture of a box whose colours are exchanged instead",
                  "pixels",
                  0};
    const auto turn = scene::rotation_y(0.11) * scene::rotation_x(0.07);
    for (const auto& mirror :
         {glm::vec3{-1, 1, 1}, glm::vec3{1, -1, 1}, glm::vec3{1, 1, -1}, glm::vec3{-1, -1, -1}}) {
      auto mirrored = one_box(turn * scene::scaling(mirror)), exchanged = one_box(turn);
      colour_sides(mirrored.world.meshes[0], {1, 1, 1});
      colour_sides(exchanged.world.meshes[0], mirror);
      const auto one = show(mirrored), other = show(exchanged);
      REQUIRE(one);
      REQUIRE(other);
      int different = 0;
      for (std::size_t i = 0; i < one->picture.size(); ++i) different += one->picture[i] != other->picture[i];
      wrong.see(one->pixels > 1000 ? different : 1e9);
    }
  }

  TEST_CASE("A camera that flies through a mesh draws it until the near plane, and never flashes") {
    Measure jump{"11. Cameras and scenes",
                 "a camera that flies through the faces of a box in 400 steps",
                 "a face that vanishes early or fills the screen for a frame",
                 "the covered area grows steadily until the camera is inside",
                 "of the screen in one step",
                 0.1};
    double before = -1;
    for (int step = 0; step < 400; ++step) {
      auto scene = one_box(scene::rotation_y(0.03));
      scene.world.units_per_world = 1000;
      scene.world.camera.position = {0.02F, 0.03F, 3.0F - static_cast<float>(step) * 0.005F};
      const auto shown = show(scene);
      REQUIRE(shown);
      const double covered = shown->pixels / (320.0 * 240.0);
      // Growth is judged while the box stands before the camera; inside it the front faces are behind.
      if (before >= 0 && step < 320) jump.see(std::abs(covered - before));
      before = covered;
    }
  }
}
