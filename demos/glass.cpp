// Four panes of glass on a carousel, one for each way the console can mix a new pixel with the one behind it.

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

constexpr std::array modes{scene::Blend::average, scene::Blend::add, scene::Blend::subtract,
                           scene::Blend::add_quarter};

// Lead came between lozenges of glass. Alpha below 255 sets bit 15: those texels are mixed, the lead is not.
scene::Texture leaded(scene::Rgb8 tint, int seed) {
  return painted("leaded glass", 64, [tint, seed](int x, int y) {
    const int a = (x + y) % 32;
    const int b = (x - y + 64) % 32;
    const bool rim = x < 4 || y < 4 || x >= 60 || y >= 60;
    if (rim || a < 3 || b < 3)
      return shaded({74, 74, 82}, rim ? (x < 2 || y < 2 ? 1.4 : 0.9) : a == 1 || b == 1 ? 1.4 : 0.8);
    auto glass =
        shaded(tint, 0.72 + 0.36 * grain((x + y) / 32, (x - y + 64) / 32, seed) + 0.1 * grain(x, y, 3));
    glass.a = 128;
    return glass;
  });
}

void animate(scene::World& world, double seconds) {
  world.instances[1].model =
      scene::rotation_y(-seconds * 0.07) * scene::rotation_x(0.05) * scene::scaling(glm::vec3(0.62F));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double turns = static_cast<double>(i) / 4 + 0.09 + seconds * 0.045;
    world.instances[2 + i].model = scene::rotation_y(turns) * scene::translation({0, 0, 1.55F});
  }
}

}  // namespace

scene::Scene glass() {
  scene::Scene s;
  scene::World& w = s.world;
  w.textures = {bricks(), metal_crate()};
  w.materials = {{.texture = 0}, {.texture = 1, .lit = true}};
  constexpr scene::Rgb8 tints[] = {{110, 190, 210}, {190, 96, 40}, {130, 60, 150}, {240, 230, 130}};
  for (std::uint32_t i = 0; i < modes.size(); ++i) {
    w.textures.push_back(leaded(tints[i], static_cast<int>(i)));
    w.materials.push_back({.texture = 2 + i, .blend = modes[i], .double_sided = true});
  }

  scene::Mesh wall;
  add_grid(wall, {-6, -4, -3}, {12, 0, 0}, {0, 8, 0}, 4, 3, {0, {100, 100, 104}}, {12, 9});
  w.meshes.push_back(wall);
  scene::Mesh crate;
  add_box(crate, {0, 0, 0}, {1, 1, 1}, {1, {140, 140, 140}});
  w.meshes.push_back(crate);
  for (std::uint32_t i = 0; i < modes.size(); ++i) {
    scene::Mesh pane;
    add_quad(pane, {{{-0.75F, -0.95F, 0}, {0.75F, -0.95F, 0}, {0.75F, 0.95F, 0}, {-0.75F, 0.95F, 0}}},
             {2 + i, {128, 128, 128}});
    w.meshes.push_back(pane);
  }
  for (std::uint32_t mesh = 0; mesh < w.meshes.size(); ++mesh) place(w, mesh);

  w.camera.position = {0, 0.7F, 6.4F};
  w.camera.orientation = scene::looking(w.camera.position, {0, -0.1F, 0});
  w.lights = {{{-0.4F, -0.7F, -0.7F}, {1.0F, 0.98F, 0.9F}}};
  w.ambient = glm::vec3(0.3F);
  w.background = {20, 20, 26};
  s.animate = animate;
  return s;
}

}  // namespace demos
