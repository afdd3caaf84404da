// Textured crates, spinning: convex objects well apart, the case the ordering table was made for.

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

struct Crate {
  glm::vec3 position;
  float half;
  bool metal;
  double turns_per_second;
};
constexpr Crate crate_list[] = {
    {{-1.55F, 0.15F, 0.0F}, 0.72F, false, 0.11}, {{1.5F, -0.1F, 0.5F}, 0.78F, true, -0.09},
    {{0.1F, 0.75F, -3.2F}, 0.8F, false, 0.07},   {{-0.1F, -1.05F, 1.6F}, 0.42F, true, 0.17},
    {{-3.4F, -0.7F, -3.4F}, 0.75F, true, -0.12}, {{3.5F, 0.9F, -3.6F}, 0.7F, false, 0.13},
};

void animate(scene::World& world, double seconds) {
  for (std::size_t i = 0; i < std::size(crate_list); ++i) {
    const Crate& c = crate_list[i];
    const double turns = c.turns_per_second * seconds + 0.13 * static_cast<double>(i);
    world.instances[i].model = scene::translation(c.position) * scene::rotation_y(turns) *
                               scene::rotation_x(0.06 + turns * 0.5) * scene::scaling(glm::vec3(c.half));
  }
}

}  // namespace

scene::Scene crates() {
  scene::Scene s;
  scene::World& w = s.world;
  w.textures = {wooden_crate(), metal_crate()};
  w.materials = {{.texture = 0, .lit = true}, {.texture = 1, .lit = true}};
  for (std::uint32_t material = 0; material < 2; ++material) {
    scene::Mesh mesh;
    add_box(mesh, {0, 0, 0}, {1, 1, 1}, {material, {140, 140, 140}});
    w.meshes.push_back(mesh);
  }
  for (const Crate& c : crate_list) place(w, c.metal ? 1 : 0);
  w.camera.position = {0, 0.6F, 6.2F};
  w.camera.orientation = scene::looking(w.camera.position, {0, 0, -0.6F});
  w.lights = {{{-0.5F, -0.8F, -0.6F}, {0.95F, 0.92F, 0.82F}}, {{0.8F, 0.2F, -0.3F}, {0.18F, 0.22F, 0.34F}}};
  w.ambient = glm::vec3(0.26F, 0.26F, 0.32F);
  w.background = {26, 30, 52};
  s.animate = animate;
  return s;
}

}  // namespace demos
