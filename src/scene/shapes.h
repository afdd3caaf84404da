#pragma once
// Solids as meshes: centred on the origin, axis along y, closed, wound counter-clockwise from outside, white
// (128 = a texel unchanged; paint() gives another colour). Texture coordinates as X3D lays them
// [ISO/IEC 19775-1, Geometry3D component].

#include <glm/vec3.hpp>

#include "scene/world.h"

namespace scene {

/// Six quads, each with the whole picture, upright when seen from outside. No normals: faces are flat.
Mesh box(const glm::vec3& size);

/// `slices` round the axis, `stacks` from pole to pole; quads, triangles at the poles. Smooth.
Mesh sphere(float radius, int slices = 32, int stacks = 16);

/// Which parts of a cylinder or cone are there; without one of them it is no longer closed.
struct Parts {
  bool side = true, top = true, bottom = true;
};
Mesh cylinder(float radius, float height, Parts parts = {}, int slices = 32);
Mesh cone(float bottom_radius, float height, Parts parts = {}, int slices = 32);

/// Every corner of every face in one colour.
void paint(Mesh& mesh, Rgb8 colour);

}  // namespace scene
