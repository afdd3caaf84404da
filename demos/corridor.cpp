// A long corridor of large textured quads with things standing on its floor. The average depth of a long
// floor quad says little about its depth near an object, and affine texture coordinates bend along it.

#include "demos/parts.h"
#include "demos/scenes.h"
#include "demos/textures.h"
#include "scene/angle.h"

namespace demos {
namespace {

constexpr int segments = 6;
constexpr float segment_length = 5, half_width = 2, height = 2.6F;

enum : std::uint32_t {
  floor_material,
  wall_material,
  ceiling_material,
  wood_material,
  metal_material,
  pillar_material
};

// One quad for each side of each segment: as few as a console game could afford.
scene::Mesh hall() {
  scene::Mesh mesh;
  const glm::vec3 along{0, 0, -segments * segment_length};
  add_grid(mesh, {-half_width, 0, 0}, {2 * half_width, 0, 0}, along, 1, segments,
           {floor_material, {140, 140, 140}}, {2, 3 * segments});
  add_grid(mesh, {half_width, height, 0}, {-2 * half_width, 0, 0}, along, 1, segments,
           {ceiling_material, {70, 70, 76}}, {2, 3 * segments});
  add_grid(mesh, {-half_width, 0, 0}, along, {0, height, 0}, segments, 1, {wall_material, {128, 128, 128}},
           {3 * segments, 1});
  // From far to near, so that it faces the hall.
  add_grid(mesh, glm::vec3(half_width, 0, 0) + along, -along, {0, height, 0}, segments, 1,
           {wall_material, {112, 112, 112}}, {3 * segments, 1});
  add_quad(mesh,
           {glm::vec3(-half_width, 0, along.z),
            {half_width, 0, along.z},
            {half_width, height, along.z},
            {-half_width, height, along.z}},
           {pillar_material, {110, 110, 110}}, {3, 2});
  return mesh;
}

void animate(scene::World& world, double seconds) {
  const double walked = seconds / 24 - std::floor(seconds / 24);  // there and back in 24 s
  const double forth = walked < 0.5 ? 2 * walked : 2 - 2 * walked;
  auto& camera = world.camera;
  camera.position = {static_cast<float>(0.5 * scene::sin_turns(seconds / 9)), 1.35F,
                     static_cast<float>(-0.6 - 16.5 * forth)};
  camera.orientation = scene::rotation_y(0.018 * scene::sin_turns(seconds / 7)) * scene::rotation_x(-0.022);
}

}  // namespace

scene::Scene corridor() {
  scene::Scene s;
  scene::World& w = s.world;
  w.textures = {stone_tiles(), plaster(), planks(), wooden_crate(), metal_crate(), bricks()};
  w.materials = {{.texture = 0}, {.texture = 1}, {.texture = 2},
                 {.texture = 3}, {.texture = 4}, {.texture = 5}};
  w.meshes.push_back(hall());
  place(w, 0);

  const auto add_prop = [&w](glm::vec3 half, Look look, glm::vec3 at, double turns) {
    scene::Mesh mesh;
    add_box(mesh, {0, half.y, 0}, half, look);
    w.meshes.push_back(mesh);
    place(w, static_cast<std::uint32_t>(w.meshes.size() - 1),
          scene::translation(at) * scene::rotation_y(turns));
  };
  add_prop({0.4F, 0.4F, 0.4F}, {wood_material, {134, 134, 134}}, {-1.2F, 0, -4.4F}, 0.04);
  add_prop({0.28F, 0.28F, 0.28F}, {metal_material, {134, 134, 134}}, {-1.15F, 0.8F, -4.45F}, 0.11);
  add_prop({0.45F, 0.45F, 0.45F}, {metal_material, {134, 134, 134}}, {1.2F, 0, -8.2F}, -0.06);
  add_prop({0.22F, height / 2, 0.22F}, {pillar_material, {128, 128, 128}}, {-1.3F, 0, -11.5F}, 0);
  add_prop({0.22F, height / 2, 0.22F}, {pillar_material, {128, 128, 128}}, {1.3F, 0, -11.5F}, 0);
  add_prop({0.5F, 0.5F, 0.5F}, {wood_material, {134, 134, 134}}, {0.3F, 0, -15.4F}, 0.09);
  add_prop({0.35F, 0.35F, 0.35F}, {wood_material, {134, 134, 134}}, {-1.3F, 0, -20.0F}, 0.2);
  add_prop({0.5F, 0.5F, 0.5F}, {metal_material, {134, 134, 134}}, {1.1F, 0, -23.5F}, 0.05);

  w.camera.tan_half_fov = 0.6F;
  w.camera.near_z = 0.05F;
  w.depth_cue = {true, {14, 14, 22}, 2.5F, 26};
  w.background = {14, 14, 22};
  s.animate = animate;
  return s;
}

}  // namespace demos
