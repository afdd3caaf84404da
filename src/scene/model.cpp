#include "scene/model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

#include "scene/angle.h"
#include "scene/view.h"

namespace scene {
namespace {

// What a frame has to do to a colour; the order is that of the runs.
enum class Shading : std::uint8_t { lit, cued, constant };

// One corner of a face or end of a line. Corners that shade alike share a colour.
struct CornerColour {
  Shading shading = Shading::constant;
  std::array<std::int32_t, 3> self_light{};
  std::uint32_t vertex = none;  // if its depth or its own normal matters
  std::array<std::int16_t, 3> normal{};
  Rgb8 colour;
  std::uint32_t corner = 0;  // four to a face, behind all faces two to a line

  [[nodiscard]] auto key() const {
    return std::tuple(shading, self_light, vertex, normal, colour.r, colour.g, colour.b);
  }
};
static_assert(sizeof(CornerColour) <= 36);  // a million faces have four million of them

gte::Vertex fixed_normal(glm::vec3 n) {
  const auto fixed = [](float v) { return round_saturated<std::int16_t>(static_cast<double>(v) * 4096); };
  return {fixed(n.x), fixed(n.y), fixed(n.z), 0};
}

glm::vec3 unit(glm::vec3 v) {
  const float length = std::sqrt(glm::dot(v, v));
  return length > 0 && std::isfinite(length) ? v / length : glm::vec3(0, 0, 0);
}

// Newell's normal: right for quads that are not flat, too.
glm::vec3 face_normal(const Mesh& mesh, const Face& face) {
  const std::size_t n = face.corners();
  glm::vec3 sum{0.0F};
  for (std::size_t i = 0; i < n; ++i) {
    const glm::vec3 a = mesh.positions[face.vertex[i]] - mesh.positions[face.vertex[0]];
    const glm::vec3 b = mesh.positions[face.vertex[(i + 1) % n]] - mesh.positions[face.vertex[0]];
    sum += glm::cross(a, b);
  }
  return unit(sum);
}

// Counter-clockwise with y up is counter-clockwise to the eye; the console's front is clockwise.
constexpr std::array<std::size_t, 4> triangle_order{0, 2, 1, 3}, quad_order{0, 3, 1, 2};
const auto& console_order(const Face& face) { return face.is_quad() ? quad_order : triangle_order; }

// The whole periods of a texture that a face lies in.
struct Periods {
  double base;  // of the smallest coordinate
  bool is_one;  // and no more than that one; files hold 1.0000001 for 1
  explicit Periods(std::span<const double> coordinates) {
    const auto [least, most] = std::ranges::minmax(coordinates);
    constexpr double little = 1e-4;
    base = std::floor(least + little);
    is_one = most - base <= 1 + little;
  }
};

class Maker {
 public:
  Maker(const Mesh& mesh, std::span<const Material> materials, std::span<const StoredTexture> textures,
        bool is_cued)
      : mesh_(mesh), materials_(materials), textures_(textures), is_cued_(is_cued) {}

  [[nodiscard]] bool is_drawable(std::span<const std::uint32_t> vertices, std::uint32_t material) const {
    if (material >= materials_.size()) return false;
    return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
      if (v >= mesh_.positions.size()) return false;
      const glm::vec3 p = mesh_.positions[v];
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
  }

  ModelFace face(const Face& face, std::uint32_t source) const {
    const auto& order = console_order(face);
    ModelFace out;
    out.material = face.material;
    out.source = source;
    for (std::size_t k = 0; k < 4; ++k) out.vertex[k] = face.vertex[order[k]];
    const auto texture = materials_[face.material].texture;
    if (texture < textures_.size()) texture_coordinates(face, textures_[texture], order, out);
    return out;
  }

  // Gives every corner of the faces and lines made from these the number of its colour.
  ModelColours number(std::span<const Face* const> faces, std::span<const Line* const> lines, Model& model) {
    sources_ = faces;
    model_ = &model;
    std::size_t count = 2 * lines.size();
    for (const Face* face : faces) count += face->corners();
    corners_.reserve(count);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const Face& face = *faces[i];
      for (std::size_t k = 0; k < face.corners(); ++k) {
        const auto corner = static_cast<std::uint32_t>(4 * i + k);
        add(face.material, model.faces[i].vertex[k], normal_of(corner), has_normals(),
            face.colour[console_order(face)[k]], corner);
      }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        add(lines[i]->material, lines[i]->vertex[k], std::nullopt, false, lines[i]->colour[k],
            static_cast<std::uint32_t>(4 * faces.size() + 2 * i + k));
      }
    }
    std::sort(corners_.begin(), corners_.end(),
              [](const CornerColour& a, const CornerColour& b) { return a.key() < b.key(); });
    ModelColours out;
    const CornerColour* last = nullptr;
    for (const auto& corner : corners_) {
      if (last == nullptr || last->key() != corner.key()) append(out, corner);
      last = &corner;
      number_of(corner.corner) = static_cast<std::uint32_t>(out.given.size() - 1);
    }
    return out;
  }

 private:
  [[nodiscard]] bool has_normals() const { return mesh_.normals.size() == mesh_.positions.size(); }
  // Of a corner of a face.
  [[nodiscard]] glm::vec3 normal_of(std::uint32_t corner) const {
    if (!has_normals()) return face_normal(mesh_, *sources_[corner / 4]);
    return unit(mesh_.normals[model_->faces[corner / 4].vertex[corner % 4]]);
  }
  [[nodiscard]] std::uint32_t& number_of(std::uint32_t corner) {
    const auto of_faces = static_cast<std::uint32_t>(4 * sources_.size());
    if (corner < of_faces) return model_->faces[corner / 4].colour[corner % 4];
    return model_->lines[(corner - of_faces) / 2].colour[corner % 2];
  }

  // Lines have no normal and are not lit.
  void add(std::uint32_t material, std::uint32_t vertex, std::optional<glm::vec3> normal, bool own_normal,
           Rgb8 colour, std::uint32_t number) {
    const Material& m = materials_[material];
    CornerColour corner;
    corner.colour = colour;
    corner.corner = number;
    const bool uses_colour = !(m.raw_texture && m.texture < textures_.size());
    if (uses_colour && m.lit && normal) {
      corner.shading = Shading::lit;
      const gte::Vertex fixed = fixed_normal(*normal);
      corner.normal = {fixed.x, fixed.y, fixed.z};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto light = std::clamp(static_cast<double>(m.self_light[static_cast<int>(c)]), 0.0, 8.0);
        corner.self_light[c] = round_saturated<std::int32_t>(light * 4096);
      }
    } else if (uses_colour && is_cued_) {
      corner.shading = Shading::cued;
    }
    if (corner.shading != Shading::constant && (is_cued_ || own_normal)) corner.vertex = vertex;
    corners_.push_back(corner);
  }

  void append(ModelColours& out, const CornerColour& corner) const {
    out.given.push_back({corner.colour.r, corner.colour.g, corner.colour.b, 0});
    if (corner.shading == Shading::constant) return;
    out.vertex.push_back(corner.vertex == none ? 0 : corner.vertex);
    out.cued = out.given.size();
    if (corner.shading == Shading::cued) return;
    out.normal.push_back({corner.normal[0], corner.normal[1], corner.normal[2], 0});
    out.exact_normal.push_back(normal_of(corner.corner));
    if (out.lit_runs.empty() || out.lit_runs.back().self_light != corner.self_light) {
      out.lit_runs.push_back({0, corner.self_light});
    }
    out.lit_runs.back().end = out.given.size();
    out.lit = out.given.size();
  }

  static void texture_coordinates(const Face& face, const StoredTexture& texture,
                                  const std::array<std::size_t, 4>& order, ModelFace& out) {
    const std::size_t n = face.corners();
    std::array<double, 4> us{}, vs{};
    for (std::size_t k = 0; k < n; ++k) {
      us[k] = face.uv[order[k]].x;
      vs[k] = face.uv[order[k]].y;
    }
    const Periods periods_u(std::span<const double>(us.data(), n)),
        periods_v(std::span<const double>(vs.data(), n));
    for (std::size_t k = 0; k < n; ++k) {
      const auto u = texture.u.coordinate(us[k], periods_u.base, periods_u.is_one);
      const auto v = texture.v.coordinate(vs[k], periods_v.base, periods_v.is_one);
      out.uv[k] = {u.whole, v.whole};
      out.rest[k] = {u.rest, v.rest};
    }
  }

  const Mesh& mesh_;
  std::span<const Material> materials_;
  std::span<const StoredTexture> textures_;
  bool is_cued_;
  std::span<const Face* const> sources_;
  Model* model_ = nullptr;
  std::vector<CornerColour> corners_;
};

void store_vertices(const Mesh& mesh, double scale, Model& model) {
  const Box3 box = bounds_of(mesh);
  model.centre = (box.low + box.high) * 0.5;
  const glm::dvec3 half = (box.high - box.low) * 0.5;
  model.radius = std::sqrt(glm::dot(half, half));
  const double most = std::max({half.x, half.y, half.z});
  model.scale = most * scale > 32767 ? 32767 / most : scale;
  model.positions = mesh.positions;
  model.vertices.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions) {
    const glm::dvec3 v = (glm::dvec3(p) - model.centre) * model.scale;
    model.vertices.push_back({round_saturated<std::int16_t>(v.x), round_saturated<std::int16_t>(v.y),
                              round_saturated<std::int16_t>(v.z), 0});
  }
}

}  // namespace

Model make_model(const Mesh& mesh, std::span<const std::uint32_t> sources,
                 std::span<const Material> materials, std::span<const StoredTexture> textures, double scale,
                 bool is_cued) {
  Model model;
  store_vertices(mesh, scale, model);
  Maker maker(mesh, materials, textures, is_cued);
  std::vector<const Face*> faces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& face = mesh.faces[i];
    if (!maker.is_drawable(std::span(face.vertex).first(face.corners()), face.material)) continue;
    model.faces.push_back(maker.face(face, i < sources.size() ? sources[i] : static_cast<std::uint32_t>(i)));
    faces.push_back(&face);
  }
  std::vector<const Line*> lines;
  for (const auto& line : mesh.lines) {
    if (!maker.is_drawable(line.vertex, line.material)) continue;
    ModelLine out;
    out.vertex = line.vertex;
    out.material = line.material;
    model.lines.push_back(out);
    lines.push_back(&line);
  }
  model.colours = maker.number(faces, lines, model);
  for (auto& face : model.faces) {
    const std::size_t n = face.corners();
    face.gouraud = std::any_of(face.colour.begin() + 1, face.colour.begin() + static_cast<std::ptrdiff_t>(n),
                               [&](std::uint32_t c) { return c != face.colour[0]; });
  }
  for (auto& line : model.lines) line.gouraud = line.colour[0] != line.colour[1];
  return model;
}

}  // namespace scene
