#include "scene/submit.h"

#include <algorithm>

namespace scene {

std::vector<PacketMaterial> packet_materials(std::span<const Material> materials,
                                             std::span<const StoredTexture> textures) {
  std::vector<PacketMaterial> out;
  for (const auto& m : materials) {
    PacketMaterial p;
    if (m.texture < textures.size()) p.texture = &textures[m.texture];
    p.semi_transparent = m.blend != Blend::opaque;
    p.raw = m.raw_texture && p.texture != nullptr;
    p.double_sided = m.double_sided;
    p.bias = m.bias;
    p.texpage = static_cast<std::uint16_t>((p.texture != nullptr ? p.texture->texpage : 0) |
                                           ot::gp0::draw_mode::put(m.blend));
    out.push_back(p);
  }
  return out;
}

std::uint32_t otz_of(std::span<const Corner> corners, Key key) {
  const auto nearer = [](const Corner& a, const Corner& b) { return a.sz < b.sz; };
  std::uint32_t otz = 0;
  switch (key) {
    case Key::nearest:
      otz = 2U * std::min_element(corners.begin(), corners.end(), nearer)->sz;
      break;
    case Key::farthest:
      otz = 2U * std::max_element(corners.begin(), corners.end(), nearer)->sz;
      break;
    case Key::average: {
      std::uint32_t sum = 0;
      for (const auto& c : corners) sum += c.sz;
      const gte::S3_12 scale{corners.size() == 3 ? zsf3 : zsf4};
      otz = corners.size() == 2 ? sum : static_cast<std::uint32_t>(gte::depth_average(scale, sum).otz);
    }
  }
  return std::min(otz, 65535U);
}

ot::Polygon polygon_of(const Primitive& p) {
  ot::Polygon out;
  out.quad = p.count == 4;
  out.gouraud = p.gouraud && !p.material->raw;
  out.textured = p.material->texture != nullptr;
  out.semi_transparent = p.material->semi_transparent;
  out.raw = p.material->raw;
  for (std::size_t k = 0; k < p.count; ++k) {
    const Corner& c = p.corner[k];
    out.xy[k] = {c.sxy.x, c.sxy.y};
    out.rgb[k] = {c.colour.r, c.colour.g, c.colour.b};
    out.uv[k] = c.uv;
  }
  if (p.material->texture != nullptr) {
    out.clut = p.material->texture->clut;
    out.texpage = p.material->texpage;
  }
  return out;
}

ot::Line line_of(const Primitive& p) {
  ot::Line out;
  out.gouraud = p.gouraud;
  out.semi_transparent = p.material->semi_transparent;
  for (std::size_t k = 0; k < 2; ++k) {
    const Corner& c = p.corner[k];
    out.xy[k] = {c.sxy.x, c.sxy.y};
    out.rgb[k] = {c.colour.r, c.colour.g, c.colour.b};
  }
  return out;
}

ot::DepthAnnotation depth_of(const Primitive& p, std::uint8_t fraction_mask, bool has_fractions) {
  ot::DepthAnnotation out;
  out.count = static_cast<int>(p.count);
  out.has_fractions = has_fractions;
  for (std::size_t k = 0; k < p.count; ++k) {
    out.z[k] = p.corner[k].z_20_12;
    out.fx[k] = p.corner[k].fraction_x & fraction_mask;
    out.fy[k] = p.corner[k].fraction_y & fraction_mask;
  }
  return out;
}

}  // namespace scene
