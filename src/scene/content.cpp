#include "scene/content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "ot/gp0.h"
#include "ot/gp1.h"
#include "scene/tessellate.h"
#include "scene/view.h"

namespace scene {
namespace {

// The longest image of a unit axis.
double scale_of(const glm::mat4& m) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 column(m[axis]);
    most = std::max(most, glm::dot(column, column));
  }
  return std::isfinite(most) ? std::sqrt(most) : 0;
}

}  // namespace

Content::Content(const World& world, int w, int h, int n)
    : width(w), height(h), pieces(n), units(choose_units(world)), pack(pack_textures(world.textures, w)) {
  report = pack.report;
  materials = packet_materials(world.materials, pack.textures);
  std::vector<double> largest(world.meshes.size());  // scale of the instances of each mesh
  for (const auto& instance : world.instances) {
    if (instance.mesh < largest.size())
      largest[instance.mesh] = std::max(largest[instance.mesh], scale_of(instance.model));
  }
  for (std::uint32_t i = 0; i < largest.size(); ++i) add_model(world, i, largest[i]);
  shown = {false, false, false};
  for (const Model& model : models) {
    for (const ModelFace& face : model.faces) {
      const PacketMaterial& material = materials[face.material];
      shown.polygons = true;
      shown.textured = shown.textured || material.texture != nullptr;
      shown.gouraud = shown.gouraud || (face.gouraud && !material.raw);
    }
  }
}

void Content::add_model(const World& world, std::uint32_t index, double largest) {
  const double wanted = units * (largest > 0 ? largest : 1);
  const Mesh& mesh = world.meshes[index];
  const auto cut = tessellate(mesh, world.materials, pack.textures, pieces, report);
  models.push_back(make_model(cut ? cut->mesh : mesh,
                              cut ? std::span(cut->sources) : std::span<const std::uint32_t>{},
                              world.materials, pack.textures, wanted, world.depth_cue.on));
  const double scale = models.back().scale;
  if (scale < wanted * 0.999) {
    report.push_back("mesh " + std::to_string(index) + ": scaled to " + std::to_string(scale / wanted) +
                     " of its size to fit 16 bits");
  }
}

std::vector<std::uint32_t> upload_gp0(const Content& content) {
  std::vector<std::uint32_t> words{
      ot::gp0::clear_cache};  // the CLUT cache must not keep what was there before
  for (const auto& block : content.pack.blocks) {
    std::array<std::uint32_t, 3> header{};
    ot::encode(block.area, header);
    words.insert(words.end(), header.begin(), header.end());
    for (std::size_t i = 0; i < block.halfwords.size(); i += 2) {
      const std::uint32_t high = i + 1 < block.halfwords.size() ? block.halfwords[i + 1] : 0U;
      words.push_back(block.halfwords[i] | high << 16);
    }
  }
  return words;
}

std::vector<std::uint32_t> display_gp1(const Content& content) {
  const bool tall = content.height == 480;
  namespace gp1 = ot::gp1;
  using namespace gp1::display_mode;
  // 480 lines come as two interlaced fields. The ranges are those of a 240-line NTSC picture.
  return {gp1::display_mode::make(put_width(content.width) | Is480Lines::put(tall) | IsInterlaced::put(tall)),
          gp1::horizontal_range::make(0x260, 0xc60), gp1::vertical_range::make(0x10, 0x100),
          gp1::display_start::make(0, 0), gp1::display_off::make(false)};
}

}  // namespace scene
