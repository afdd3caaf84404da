// Two walls that pass through each other: whichever is painted last hides half of
// the other that should be seen.

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

void animate(scene::World& world, double seconds) {
  world.instances[0].model = scene::rotation_y(0.11 + seconds * 0.05);
  world.instances[1].model = scene::rotation_y(0.36 + seconds * 0.05) * scene::rotation_x(0.04);
}

}  // namespace

scene::Scene crossing() {
  scene::Scene s;
  scene::World& w = s.world;
  w.textures = {bricks(), planks()};
  w.materials = {{.texture = 0, .double_sided = true}, {.texture = 1, .double_sided = true}};
  for (std::uint32_t i = 0; i < 2; ++i) {
    scene::Mesh wall;
    add_quad(wall, {{{-1.6F, -1.1F, 0}, {1.6F, -1.1F, 0}, {1.6F, 1.1F, 0}, {-1.6F, 1.1F, 0}}},
             {i, {136, 136, 136}}, {3, 2});
    w.meshes.push_back(wall);
    place(w, i);
  }
  w.camera.position = {0, 1.5F, 4.6F};
  w.camera.orientation = scene::looking(w.camera.position, {0, -0.05F, 0});
  w.background = {40, 52, 60};
  s.animate = animate;
  return s;
}

}  // namespace demos
