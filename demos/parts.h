#pragma once
// The few shapes the demos are made of. Faces run counter-clockwise seen from outside.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/world.h"

namespace demos {

/// What a face looks like; all corners alike.
struct Look {
  std::uint32_t material = 0;
  scene::Rgb8 colour{128, 128, 128};  ///< 128: a texture's own colours
};

/// Four corners counter-clockwise; texture coordinates 0,1 / 1,1 / 1,0 / 0,0 times `repeat`.
void add_quad(scene::Mesh& mesh, const std::array<glm::vec3, 4>& corners, Look look,
              glm::vec2 repeat = {1, 1});

/// A box round `centre`; each side shows the whole texture. Sides share their corner vertices.
void add_box(scene::Mesh& mesh, glm::vec3 centre, glm::vec3 half, Look look);

/// A flat rectangle of columns x rows quads from `corner` along two edges, one vertex per grid point. The
/// texture repeats `repeat` times over the whole.
void add_grid(scene::Mesh& mesh, glm::vec3 corner, glm::vec3 across, glm::vec3 along, int columns, int rows,
              Look look, glm::vec2 repeat);

/// Adds an instance of a mesh to the world and returns its number.
std::uint32_t place(scene::World& world, std::uint32_t mesh, const glm::mat4& model = glm::mat4{1.0F});

}  // namespace demos
