#include <algorithm>
#include <cmath>
#include <sstream>

#include "load/obj.h"
#include "load/pictures.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace load {
namespace {

float finite(float value, float otherwise) {
  return std::isfinite(value) && std::abs(value) <= 1e6F ? value : otherwise;
}

glm::vec3 colour_of(const tinyobj::real_t (&rgb)[3]) {
  return {finite(rgb[0], 0), finite(rgb[1], 0), finite(rgb[2], 0)};
}

ObjMaterial convert(const tinyobj::material_t& from, Pictures& pictures) {
  ObjMaterial to;
  const float opacity = finite(from.dissolve, 1);
  to.is_invisible = opacity <= 0;
  to.material.blend = opacity < 1 ? Blend::average : Blend::opaque;
  to.material.lit = true;
  to.diffuse = colour_of(from.diffuse);
  const glm::vec3 glow = colour_of(from.emission);
  if (to.diffuse == glm::vec3(0) && glow != glm::vec3(0)) {
    to.diffuse = glow;
    to.material.lit = false;
  }
  if (from.diffuse_texname.empty()) return to;

  const tinyobj::texture_option_t& options = from.diffuse_texopt;
  std::uint32_t texture = pictures.load(from.diffuse_texname, !options.clamp);
  if (texture == none) return to;
  if (to.material.blend == Blend::average) texture = pictures.see_through(texture);
  if (pictures.is_partly_transparent(texture)) to.material.blend = Blend::average;
  to.material.texture = texture;
  to.uv_scale = {finite(options.scale[0], 1), finite(options.scale[1], 1)};
  to.uv_offset = {finite(options.origin_offset[0], 0), finite(options.origin_offset[1], 0)};
  // Exporters leave Kd black under a picture and mean the picture alone.
  if (to.diffuse == glm::vec3(0)) to.diffuse = glm::vec3(1);
  return to;
}

}  // namespace

void parse_mtl(const std::string& bytes, Pictures& pictures,
               std::map<std::string, ObjMaterial, std::less<>>& materials) {
  std::map<std::string, int> index;
  std::vector<tinyobj::material_t> read;
  std::string warning, error;
  std::istringstream in(bytes);
  tinyobj::LoadMtl(&index, &read, &in, &warning, &error);
  for (const tinyobj::material_t& material : read) {
    if (materials.size() >= limits::materials) return;
    if (!materials.contains(material.name)) materials.emplace(material.name, convert(material, pictures));
  }
}

}  // namespace load
