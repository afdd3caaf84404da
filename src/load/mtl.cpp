#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>

#include "load/obj.h"
#include "load/pictures.h"
#include "load/text.h"

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

namespace {

// The lines that a material is made of, so that one of millions takes no memory for the others.
constexpr std::array<std::string_view, 6> keys{"Kd", "Ke", "d", "Tr", "illum", "map_Kd"};

void take_material(const std::string& lines, Pictures& pictures,
                   std::map<std::string, ObjMaterial, std::less<>>& materials) {
  std::map<std::string, int> index;
  std::vector<tinyobj::material_t> read;
  std::string warning, error;
  std::istringstream in(lines);
  tinyobj::LoadMtl(&index, &read, &in, &warning, &error);
  for (const tinyobj::material_t& material : read) {
    if (!materials.contains(material.name)) materials.emplace(material.name, convert(material, pictures));
  }
}

}  // namespace

void parse_mtl(std::string_view bytes, Pictures& pictures,
               std::map<std::string, ObjMaterial, std::less<>>& materials) {
  constexpr std::string_view blank = " \t\r";
  std::set<std::string_view> names;
  std::string lines;  // of the material being read; empty: of one that is not wanted
  while (!bytes.empty() && materials.size() < limits::materials) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    std::string_view rest = line;
    const std::string_view key = next_token(rest, blank);
    if (key == "newmtl") {
      if (!lines.empty()) take_material(lines, pictures, materials);
      lines.clear();
      if (names.insert(rest).second) lines.append(line).append("\n");
    } else if (!lines.empty() && std::find(keys.begin(), keys.end(), key) != keys.end()) {
      lines.append(line).append("\n");
    }
  }
  if (!lines.empty() && materials.size() < limits::materials) take_material(lines, pictures, materials);
}

}  // namespace load
