#pragma once
// Small worlds, each made for one error.

#include <vector>

#include "scene/world.h"

namespace cost_test {

/// A quad in the plane z = `z`, facing the camera, corners (x0, y0)..(x1, y1).
inline void add_wall(scene::World& world, float x0, float y0, float x1, float y1, float z, scene::Rgb8 colour,
                     std::uint32_t material = 0) {
  scene::Mesh mesh;
  mesh.positions = {{x0, y1, z}, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}};
  scene::Face face;
  face.vertex = {0, 1, 2, 3};
  face.uv = {glm::vec2{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  face.colour = {colour, colour, colour, colour};
  face.material = material;
  mesh.faces.push_back(face);
  world.meshes.push_back(mesh);
  world.instances.push_back({static_cast<std::uint32_t>(world.meshes.size() - 1), glm::mat4(1.0F)});
}

/// Many parallel walls close behind each other, inserted so that list order is wrong wherever two share a
/// bucket.
inline scene::Scene slices() {
  scene::Scene s;
  s.name = "slices";
  s.world.units_per_world = 100;
  for (int i = 0; i < 40; ++i) {
    const float z =
        -35.0F + 0.37F * static_cast<float>(i);  // later ones nearer: a LIFO bucket draws them first
    const float x = -6.0F + 0.25F * static_cast<float>(i);
    add_wall(s.world, x, -4, x + 3, 4, z, {static_cast<std::uint8_t>(40 + 5 * i), 90, 200});
  }
  return s;
}

/// A floor that runs away from z = -near to -40, with a checkerboard on it and fog over it if asked.
inline scene::Scene runway(bool fog, float half_width = 4, float near = 1.5F) {
  scene::Scene s;
  s.name = "runway";
  scene::World& w = s.world;
  w.units_per_world = 400;
  scene::Texture board{"board", 64, 64, {}, scene::TexelFormat::clut4, false};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto c = static_cast<std::uint8_t>(((x / 4 + y / 4) & 1) != 0 ? 230 : 40);
      board.pixels.push_back({c, c, 60, 255});
    }
  }
  w.textures.push_back(board);
  scene::Material material;
  material.texture = 0;
  material.double_sided = true;
  w.materials = {material};
  scene::Mesh mesh;
  mesh.positions = {{-half_width, -1.5F, -near},
                    {half_width, -1.5F, -near},
                    {half_width, -1.5F, -40},
                    {-half_width, -1.5F, -40}};
  scene::Face face;
  face.vertex = {0, 1, 2, 3};
  face.uv = {glm::vec2{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  face.colour.fill({128, 128, 128});
  mesh.faces.push_back(face);
  w.meshes.push_back(mesh);
  w.instances.push_back({0, glm::mat4(1.0F)});
  if (fog) w.depth_cue = {true, {90, 120, 200}, 2, 40};
  w.background = {90, 120, 200};
  return s;
}

/// One wall whose colours change slowly from corner to corner.
inline scene::Scene gradient() {
  scene::Scene s;
  s.name = "gradient";
  s.world.units_per_world = 100;
  add_wall(s.world, -20, -14, 20, 14, -20, {});
  auto& colours = s.world.meshes[0].faces[0].colour;
  colours = {scene::Rgb8{60, 70, 90}, {100, 60, 70}, {70, 110, 80}, {90, 80, 120}};
  return s;
}

/// Small flat triangles in all directions.
inline scene::Scene shards(bool flat) {
  scene::Scene s;
  s.name = "shards";
  s.world.units_per_world = 300;
  std::uint32_t state = 1;
  const auto next = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(state >> 8) / 16777216.0F - 0.5F;
  };
  scene::Material material;
  material.double_sided = true;
  s.world.materials = {material};
  scene::Mesh mesh;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const glm::vec3 centre{next() * 16, next() * 12, -18 + next() * 8};
    scene::Face face;
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.positions.push_back(centre + glm::vec3{next() * 4, next() * 4, next() * 4});
      face.vertex[k] = 3 * i + k;
    }
    face.colour.fill({static_cast<std::uint8_t>(50 + 3 * i), 160, 80});
    if (!flat) face.colour[1] = {255, 10, 10};
    mesh.faces.push_back(face);
  }
  s.world.meshes.push_back(mesh);
  s.world.instances.push_back({0, glm::mat4(1.0F)});
  return s;
}

}  // namespace cost_test
