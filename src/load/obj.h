#pragma once
// Wavefront OBJ with its MTL, as a Scene: one mesh that turns before a camera that sees all of it.
//
// Read: v (with a colour or without), vt, vn, f of any size, l, p, usemtl, mtllib; Kd, Ke, d, Tr, illum 0,
// map_Kd with -s, -o, -clamp. Quads that are flat and convex stay quads. Positive and negative indices. Not
// modelled: curves and surfaces, smoothing groups without normals, all other maps, illumination models and
// reflection terms: every surface is lit by one lamp over the camera's shoulder, unless it has Ke and no Kd.
//
// d below 1 (or Tr above 0) becomes the console's average blend, whatever its value: half of the surface,
// half of what is behind it. At d 0 nothing is drawn.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "load/load.h"

namespace load {

class Pictures;

/// What usemtl switches to.
struct ObjMaterial {
  Material material;
  glm::vec3 diffuse{0.8F};
  glm::vec2 uv_scale{1.0F}, uv_offset{0.0F};
  bool is_invisible = false;
};

/// Reads a material library's bytes into `materials`, a name at its first definition only. Problems inside it
/// are warnings: a surface without its material is drawn grey.
void parse_mtl(std::string_view bytes, Pictures& pictures,
               std::map<std::string, ObjMaterial, std::less<>>& materials);

}  // namespace load
