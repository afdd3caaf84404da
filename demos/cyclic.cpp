// Three bars, each in front of the next and behind the one before: no order to paint them in is right.

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

scene::Texture pale_planks() {
  auto t = planks();
  for (auto& p : t.pixels) p.r = p.g = p.b = static_cast<std::uint8_t>(p.r + (255 - p.r) / 3);
  return t;
}

void animate(scene::World& world, double seconds) {
  // The whole figure leans to and fro and turns slowly; the bars keep their places in it.
  const auto figure = scene::rotation_y(0.045 * scene::sin_turns(seconds / 7)) *
                      scene::rotation_x(0.035 * scene::sin_turns(seconds / 5)) *
                      scene::rotation_z(seconds / 40);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto bar = scene::rotation_z(static_cast<double>(i) / 3) * scene::translation({0, -0.62F, 0}) *
                     scene::rotation_y(-0.035);
    world.instances[i].model = figure * bar;
  }
}

}  // namespace

scene::Scene cyclic() {
  scene::Scene s;
  scene::World& w = s.world;
  w.textures = {pale_planks()};
  w.materials = {{.texture = 0, .lit = true}};
  constexpr scene::Rgb8 colours[] = {{176, 62, 52}, {70, 144, 76}, {64, 92, 184}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    scene::Mesh bar;
    add_box(bar, {0, 0, 0}, {1.75F, 0.26F, 0.05F}, {0, colours[i]});
    w.meshes.push_back(bar);
    place(w, i);
  }
  w.camera.position = {0, 0, 5.1F};
  w.lights = {{{0.3F, -0.5F, -0.8F}, {0.85F, 0.85F, 0.8F}}};
  w.ambient = glm::vec3(0.2F);
  w.background = {34, 34, 40};
  s.animate = animate;
  return s;
}

}  // namespace demos
