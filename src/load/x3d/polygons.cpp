// Polygons of X3D geometry into the faces of a mesh: normals, default texture coordinates, pieces.

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>

#include "load/distinct.h"
#include "load/faces.h"
#include "load/text.h"
#include "load/x3d/x3d.h"
#include "scene/angle.h"

namespace load::x3d {
namespace {

// Polygons round one point beyond which a crease is no longer looked for: all of them are smoothed.
constexpr std::size_t most_neighbours = 64;

glm::vec3 unit_normal(const Polygons& p, std::size_t first, std::size_t count) {
  glm::dvec3 sum{0.0};
  const auto at = [&](std::size_t i) { return glm::dvec3(p.points[p.corners[first + i % count].point]); };
  for (std::size_t i = 0; i < count; ++i) sum += glm::cross(at(i) - at(0), at(i + 1) - at(0));
  const double length = glm::length(sum);
  return length > 0 ? glm::vec3(sum / length) : glm::vec3(0);
}

// Normals where none are given: of each corner, the mean of the polygons round its point that lie within the
// crease angle of its own.
void make_normals(Polygons& p) {
  std::vector<std::uint32_t> polygon_of(p.corners.size());
  std::vector<glm::vec3> flat;
  std::size_t first = 0;
  for (const std::uint32_t count : p.sizes) {
    std::fill_n(polygon_of.begin() + static_cast<std::ptrdiff_t>(first), count,
                static_cast<std::uint32_t>(flat.size()));
    flat.push_back(unit_normal(p, first, count));
    first += count;
  }
  // Corners sorted by point: start[i] .. start[i + 1] are those of point i.
  std::vector<std::uint32_t> start(p.points.size() + 1), of_point(p.corners.size());
  for (const Corner& c : p.corners) ++start[c.point + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t i = 0; i < p.corners.size(); ++i) of_point[next[p.corners[i].point]++] = i;

  const auto least_cosine = static_cast<float>(cos_turns(p.crease));
  for (std::size_t point = 0; point < p.points.size(); ++point) {
    const std::uint32_t begin = start[point], end = start[point + 1];
    const bool all = p.crease >= 0.5 || end - begin > most_neighbours;
    for (std::uint32_t i = begin; i < end; ++i) {
      Corner& corner = p.corners[of_point[i]];
      if (all && i > begin) {
        corner.normal = p.corners[of_point[begin]].normal;
        continue;
      }
      const glm::vec3 own = flat[polygon_of[of_point[i]]];
      glm::vec3 sum{0.0F};
      for (std::uint32_t j = begin; j < end; ++j) {
        const glm::vec3& other = flat[polygon_of[of_point[j]]];
        if (all || glm::dot(own, other) >= least_cosine) sum += other;
      }
      const float length = glm::length(sum);
      corner.normal = static_cast<std::uint32_t>(p.normals.size());
      p.normals.push_back(length > 0 ? sum / length : own);
    }
  }
}

// The picture laid over the bounding box: its width along the longest side, its height along the second
// longest. [ISO/IEC 19775-1, IndexedFaceSet]
void make_uvs(Polygons& p) {
  Bounds bounds;
  for (const Corner& c : p.corners) bounds.include(p.points[c.point]);
  const glm::vec3 size = bounds.high - bounds.low;
  int longest = 0;
  for (int i = 1; i < 3; ++i) longest = size[i] > size[longest] ? i : longest;
  int second = longest == 0 ? 1 : 0;
  for (int i = 0; i < 3; ++i) second = i != longest && size[i] > size[second] ? i : second;
  if (!(size[longest] > 0)) return;
  p.uvs.reserve(p.points.size());
  for (const glm::vec3& point : p.points) {
    const glm::vec3 from = (point - bounds.low) / size[longest];
    p.uvs.emplace_back(from[longest], from[second]);
  }
  for (Corner& c : p.corners) c.uv = c.point;
}

// Puts a vertex into the mesh for each point and normal that occur together. Until then the vertices of the
// faces from `first_face` on are numbers of corners in `used`.
void add_vertices(const Polygons& p, const std::vector<Corner>& used, std::size_t first_face, Mesh& mesh) {
  if (p.normals.empty()) {
    mesh.positions = p.points;
    for (std::size_t f = first_face; f < mesh.faces.size(); ++f) {
      for (std::uint32_t& v : mesh.faces[f].vertex) v = v == none ? none : used[v].point;
    }
    return;
  }
  std::vector<std::uint64_t> keys;
  keys.reserve(used.size());
  for (const Corner& c : used) keys.push_back(std::uint64_t{c.normal} << 32U | c.point);
  const Distinct vertices = number_distinct(keys);
  const auto before = static_cast<std::uint32_t>(mesh.positions.size());
  for (const std::uint32_t first : vertices.first) {
    const Corner& c = used[first];
    mesh.positions.push_back(p.points[c.point]);
    mesh.normals.push_back(c.normal == none ? glm::vec3(0, 0, 1) : p.normals[c.normal]);
  }
  for (std::size_t f = first_face; f < mesh.faces.size(); ++f) {
    for (std::uint32_t& v : mesh.faces[f].vertex) v = v == none ? none : before + vertices.number[v];
  }
}

}  // namespace

glm::vec2 Look::picture_position(const glm::vec2& uv) const {
  // [ISO/IEC 19775-1, TextureTransform]: Tc' = -C S R C T Tc
  const glm::vec2 moved = uv + uv_offset + uv_centre;
  const auto sine = static_cast<float>(sin_turns(uv_turns)), cosine = static_cast<float>(cos_turns(uv_turns));
  const glm::vec2 turned{cosine * moved.x - sine * moved.y, sine * moved.x + cosine * moved.y};
  const glm::vec2 out = turned * uv_scale - uv_centre;
  return {out.x, 1 - out.y};
}

Rgb8 Look::stored(const glm::vec3& rgb) const {
  const float full = material.texture == none ? 255 : 128;
  return {to_byte(rgb.r, full), to_byte(rgb.g, full), to_byte(rgb.b, full)};
}

void add_polygons(Context& context, const pugi::xml_node& node, Polygons& p, const Look& look, Mesh& mesh) {
  if (look.material.texture != none && p.uvs.empty()) make_uvs(p);
  if (!look.material.lit) p.normals.clear();
  if (look.material.lit && p.normals.empty() && p.crease >= 0) make_normals(p);
  std::vector<Corner> used;
  const std::size_t first_face = mesh.faces.size();
  std::vector<glm::vec3> polygon;
  std::vector<Piece> pieces;
  std::size_t first = 0;
  for (const std::uint32_t count : p.sizes) {
    polygon.clear();
    pieces.clear();
    for (std::size_t i = first; i < first + count; ++i) polygon.push_back(p.points[p.corners[i].point]);
    split_polygon(polygon, context.split_work_left, pieces);
    if (!context.spend(node, context.faces_left, pieces.size(), "1,000,000 faces")) return;
    for (const Piece& piece : pieces) {
      Face face;
      for (std::size_t i = 0; i < 4 && piece[i] != none; ++i) {
        const Corner& c = p.corners[first + piece[i]];
        face.vertex[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(c);
        if (c.uv != none) face.uv[i] = look.picture_position(p.uvs[c.uv]);
        face.colour[i] = look.stored(c.colour == none ? look.colour : p.colours[c.colour]);
      }
      mesh.faces.push_back(face);
    }
    first += count;
  }
  add_vertices(p, used, first_face, mesh);
}

}  // namespace load::x3d
