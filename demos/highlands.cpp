// Hills in the evening haze: one mesh of shared vertices, lit and fogged by the GTE, vertex by vertex.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

constexpr int cells = 56;
constexpr float size = 48;  // world units; the hills repeat nowhere

// The ground; below 0 it is under water.
double ground_at(double x, double z) {
  const double far_out = std::sqrt(x * x + z * z) / (size / 2);
  const double rolling = clouds((x + size) / 64, (z + size) / 64, 6, 5);
  const double ridge = 1 - std::abs(2 * clouds((x + size) / 80, (z + size) / 80, 5, 17) - 1);
  return (rolling - 0.5) * 5 + (ridge * ridge - 0.35) * 5.5 * (0.3 + far_out);
}
double height_at(double x, double z) { return std::max(0.0, ground_at(x, z)); }

glm::vec3 normal_at(double x, double z) {
  constexpr double step = 0.5;
  const auto slope_x = static_cast<float>((height_at(x + step, z) - height_at(x - step, z)) / (2 * step));
  const auto slope_z = static_cast<float>((height_at(x, z + step) - height_at(x, z - step)) / (2 * step));
  const glm::vec3 n(-slope_x, 1, -slope_z);
  return n / std::sqrt(glm::dot(n, n));
}

// Water, sand at its edge, grass, rock where it is steep, snow on top.
scene::Rgb8 colour_of(glm::vec3 p, glm::vec3 n) {
  const double height = ground_at(p.x, p.z);
  const double speck = 0.9 + 0.2 * grain(static_cast<int>(p.x * 7), static_cast<int>(p.z * 7), 3);
  scene::Rgba8 c = shaded({98, 128, 52}, speck);
  c = mixed(c, shaded({190, 168, 112}, speck), (0.3 - height) * 4);
  c = mixed(c, shaded({116, 104, 98}, speck), (0.84 - n.y) * 8);
  c = mixed(c, shaded({240, 242, 250}, 1), (height - 3.1) * 1.6);
  if (height <= 0) c = mixed(shaded({60, 108, 150}, 1), shaded({30, 60, 104}, 1), -height / 2);
  return {c.r, c.g, c.b};
}

scene::Mesh hills() {
  scene::Mesh mesh;
  constexpr float cell = size / cells;
  add_grid(mesh, {-size / 2, 0, size / 2}, {size, 0, 0}, {0, 0, -size}, cells, cells, {}, {1, 1});
  for (auto& p : mesh.positions) {
    p.x += static_cast<float>(0.5 * cell * (grain(static_cast<int>(p.x), static_cast<int>(p.z), 8) - 0.5));
    p.y = static_cast<float>(height_at(p.x, p.z));
    mesh.normals.push_back(normal_at(p.x, p.z));
  }
  for (auto& face : mesh.faces)
    for (std::size_t k = 0; k < 4; ++k)
      face.colour[k] = colour_of(mesh.positions[face.vertex[k]], mesh.normals[face.vertex[k]]);
  return mesh;
}

void animate(scene::World& world, double seconds) {
  const double turns = seconds / 60;
  const glm::vec3 from(static_cast<float>(9 * scene::cos_turns(turns)),
                       static_cast<float>(3.7 + 0.5 * scene::sin_turns(seconds / 11)),
                       static_cast<float>(9 * scene::sin_turns(turns)));
  const glm::vec3 to(static_cast<float>(-5 * scene::cos_turns(turns + 0.12)), 0.6F,
                     static_cast<float>(-5 * scene::sin_turns(turns + 0.12)));
  world.camera.position = from;
  world.camera.orientation = scene::looking(from, to);
}

}  // namespace

scene::Scene highlands() {
  scene::Scene s;
  scene::World& w = s.world;
  constexpr scene::Rgb8 haze{214, 158, 132};
  w.materials = {{.lit = true}};
  w.meshes.push_back(hills());
  place(w, 0);
  w.lights = {{{-0.75F, -0.42F, 0.3F}, {1.25F, 0.98F, 0.72F}}, {{0.6F, -0.6F, -0.4F}, {0.1F, 0.16F, 0.3F}}};
  w.ambient = {0.3F, 0.28F, 0.36F};
  w.depth_cue = {true, haze, 9, 44};
  w.camera.tan_half_fov = 0.55F;
  w.background = haze;
  s.animate = animate;
  return s;
}

}  // namespace demos
