// X3D geometry nodes in space, as polygons, lines and points.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "load/rotation.h"
#include "load/x3d/x3d.h"
#include "scene/shapes.h"

namespace load::x3d {
namespace {

using Indices = std::vector<std::int32_t>;
using pugi::xml_node;

// Coordinate, Color, TextureCoordinate and Normal of a geometry node.
bool read_lists(Context& context, const xml_node& node, Polygons& p) {
  if (const xml_node points = context.child(node, "Coordinate")) p.points = context.triples(points, "point");
  if (p.points.empty()) {
    if (const xml_node points = context.child(node, "CoordinateDouble"))
      p.points = context.triples(points, "point");
  }
  if (const xml_node colours = context.child(node, "Color")) {
    p.colours = context.triples(colours, "color");
  } else if (const xml_node with_alpha = context.child(node, "ColorRGBA")) {
    const std::vector<float> v = context.floats(with_alpha, "color");
    for (std::size_t i = 0; i + 3 < v.size(); i += 4) p.colours.emplace_back(v[i], v[i + 1], v[i + 2]);
  }
  if (const xml_node uvs = context.child(node, "TextureCoordinate")) p.uvs = context.pairs(uvs, "point");
  if (const xml_node normals = context.child(node, "Normal")) {
    p.normals = context.triples(normals, "vector");
    for (glm::vec3& n : p.normals) {
      const float length = glm::length(n);
      n = length > 0 ? n / length : glm::vec3(0, 0, 1);
    }
  }
  static constexpr std::array known{"Coordinate", "CoordinateDouble",  "Color",
                                    "ColorRGBA",  "TextureCoordinate", "Normal"};
  for (const xml_node& child : node.children()) {
    if (!context.look(node)) return false;
    const auto is = [&](const char* name) { return std::string_view(child.name()) == name; };
    if (is_element(child) && !is_silent(child) && std::none_of(known.begin(), known.end(), is))
      context.unsupported(child);
  }
  return context.spend(node, context.vertices_left, p.points.size(), "4,000,000 vertices") &&
         !p.points.empty();
}

// An index checked against the list it points into.
std::uint32_t checked(Context& context, const xml_node& node, const char* field, std::int64_t index,
                      std::size_t size) {
  if (index >= 0 && static_cast<std::size_t>(index) < size) return static_cast<std::uint32_t>(index);
  context.fail(node, std::string(field) + ": index " + std::to_string(index) + ", but there are " +
                         std::to_string(size));
  return 0;
}

// A corner whose attributes all have the point's own index.
Corner same_index(Context& context, const xml_node& node, const Polygons& p, std::int64_t index) {
  Corner c;
  c.point = checked(context, node, "point", index, p.points.size());
  if (!p.colours.empty()) c.colour = checked(context, node, "color", index, p.colours.size());
  if (!p.uvs.empty()) c.uv = checked(context, node, "texture coordinate", index, p.uvs.size());
  if (!p.normals.empty()) c.normal = checked(context, node, "normal", index, p.normals.size());
  return c;
}

// How the points of one run become polygons.
enum class Run : std::uint8_t { triangles, quads, fan, strip };

void add_polygon(Context& context, const xml_node& node, Polygons& p,
                 std::initializer_list<std::int64_t> indices) {
  for (const std::int64_t i : indices) p.corners.push_back(same_index(context, node, p, i));
  p.sizes.push_back(static_cast<std::uint32_t>(indices.size()));
}

// `at(i)`: the index of the run's i-th point.
template <class At>
void add_run(Context& context, const xml_node& node, Polygons& p, Run run, std::size_t count, At&& at) {
  const std::size_t step = run == Run::triangles ? 3 : run == Run::quads ? 4 : 1;
  const std::size_t size = run == Run::quads ? 4 : 3;
  for (std::size_t i = 0; i + size <= count && !context.error(); i += step) {
    switch (run) {
      case Run::triangles:
        add_polygon(context, node, p, {at(i), at(i + 1), at(i + 2)});
        break;
      case Run::quads:
        add_polygon(context, node, p, {at(i), at(i + 1), at(i + 2), at(i + 3)});
        break;
      case Run::fan:
        add_polygon(context, node, p, {at(0), at(i + 1), at(i + 2)});
        break;
      case Run::strip:  // every second triangle is wound the other way
        add_polygon(context, node, p, {at(i), at(i + 1 + i % 2), at(i + 2 - i % 2)});
        break;
    }
  }
}

struct SetKind {
  std::string_view name;
  Run run;
  const char* counts;   // field with the length of each run; null: all points are one run
  const char* indices;  // field with the points' indices; null: points in order
};
constexpr std::array set_kinds{SetKind{"TriangleSet", Run::triangles, nullptr, nullptr},
                               SetKind{"TriangleFanSet", Run::fan, "fanCount", nullptr},
                               SetKind{"TriangleStripSet", Run::strip, "stripCount", nullptr},
                               SetKind{"QuadSet", Run::quads, nullptr, nullptr},
                               SetKind{"IndexedTriangleSet", Run::triangles, nullptr, "index"},
                               SetKind{"IndexedTriangleFanSet", Run::fan, nullptr, "index"},
                               SetKind{"IndexedTriangleStripSet", Run::strip, nullptr, "index"},
                               SetKind{"IndexedQuadSet", Run::quads, nullptr, "index"}};

// Runs of an index list, each ended by -1 or by the list's end: visit(first, count).
template <class Visit>
void each_run(const Indices& indices, Visit&& visit) {
  for (std::size_t begin = 0; begin < indices.size();) {
    const auto end = static_cast<std::size_t>(
        std::find(indices.begin() + static_cast<std::ptrdiff_t>(begin), indices.end(), -1) - indices.begin());
    if (end > begin) visit(begin, end - begin);
    begin = end + 1;
  }
}

void read_set(Context& context, const xml_node& node, const SetKind& kind, Polygons& p) {
  if (kind.indices != nullptr) {
    const Indices indices = context.wholes(node, kind.indices);
    each_run(indices, [&](std::size_t first, std::size_t count) {
      add_run(context, node, p, kind.run, count,
              [&](std::size_t i) { return std::int64_t{indices[first + i]}; });
    });
  } else if (kind.counts != nullptr) {
    std::size_t first = 0;
    for (const std::int32_t count : context.wholes(node, kind.counts)) {
      if (count < 3 || first + static_cast<std::size_t>(count) > p.points.size()) {
        return context.fail(node, std::string(kind.counts) + ": " + std::to_string(count) + " of " +
                                      std::to_string(p.points.size() - first) +
                                      " points left, expected at least 3");
      }
      add_run(context, node, p, kind.run, static_cast<std::size_t>(count),
              [&](std::size_t i) { return static_cast<std::int64_t>(first + i); });
      first += static_cast<std::size_t>(count);
    }
  } else {
    add_run(context, node, p, kind.run, p.points.size(),
            [](std::size_t i) { return static_cast<std::int64_t>(i); });
  }
  // Shared points are smooth unless told otherwise; the others have faces of their own anyway.
  if (context.flag(node, "normalPerVertex", true)) p.crease = 0.5;
}

// One attribute of an IndexedFaceSet: per corner or per face, through an index list of its own or not.
class FaceAttribute {
 public:
  FaceAttribute(Context& context, const xml_node& node, const char* field, bool per_corner, std::size_t size)
      : context_(context), node_(node), field_(field), per_corner_(per_corner), size_(size) {
    if (size_ > 0) indices_ = context.wholes(node, field);
  }
  // Of the corner that stands at `at` in coordIndex, has point `point` and belongs to polygon `face`.
  std::uint32_t of(std::size_t at, std::int32_t point, std::size_t face) {
    if (size_ == 0) return none;
    const std::size_t place = per_corner_ ? at : face;
    std::int64_t index = per_corner_ ? std::int64_t{point} : static_cast<std::int64_t>(face);
    if (!indices_.empty()) {
      if (place >= indices_.size()) {
        context_.fail(node_, std::string(field_) + " is shorter than coordIndex");
        return none;
      }
      index = indices_[place];
    }
    return checked(context_, node_, field_, index, size_);
  }

 private:
  Context& context_;
  const xml_node& node_;
  const char* field_;
  bool per_corner_;
  std::size_t size_;
  Indices indices_;
};

void read_face_set(Context& context, const xml_node& node, Polygons& p) {
  const Indices points = context.wholes(node, "coordIndex");
  FaceAttribute colours(context, node, "colorIndex", context.flag(node, "colorPerVertex", true),
                        p.colours.size());
  FaceAttribute uvs(context, node, "texCoordIndex", true, p.uvs.size());
  FaceAttribute normals(context, node, "normalIndex", context.flag(node, "normalPerVertex", true),
                        p.normals.size());
  std::size_t face = 0;
  each_run(points, [&](std::size_t first, std::size_t count) {
    for (std::size_t at = first; at < first + count && !context.error(); ++at) {
      p.corners.push_back({checked(context, node, "coordIndex", points[at], p.points.size()),
                           colours.of(at, points[at], face), uvs.of(at, points[at], face),
                           normals.of(at, points[at], face)});
    }
    p.sizes.push_back(static_cast<std::uint32_t>(count));
    ++face;
  });
  const float crease = context.scalar(node, "creaseAngle", 0);
  if (crease > 0) p.crease = std::min(turns(double{crease}), 0.5);
}

void add_segment(Context& context, const xml_node& node, const Polygons& p, const Corner& a, const Corner& b,
                 const Look& look, Mesh& mesh) {
  if (!context.spend(node, context.faces_left, 1, "1,000,000 faces")) return;
  const auto colour = [&](const Corner& c) {
    const glm::vec3 rgb = c.colour == none ? look.line_colour : p.colours[c.colour];
    return Look{}.stored(rgb);
  };
  mesh.lines.push_back({.vertex = {a.point, b.point}, .colour = {colour(a), colour(b)}});
}

bool read_lines(Context& context, const xml_node& node, const Look& look, Mesh& mesh) {
  const std::string_view name = node.name();
  if (name != "LineSet" && name != "IndexedLineSet" && name != "PointSet") return false;
  Polygons p;
  if (!read_lists(context, node, p)) return true;
  const auto corner = [&](std::size_t i) {
    return same_index(context, node, p, static_cast<std::int64_t>(i));
  };
  if (name == "PointSet") {
    for (std::size_t i = 0; i < p.points.size() && !context.error(); ++i) {
      add_segment(context, node, p, corner(i), corner(i), look, mesh);
    }
  } else if (name == "LineSet") {
    std::size_t first = 0;
    for (const std::int32_t count : context.wholes(node, "vertexCount")) {
      if (count < 2 || first + static_cast<std::size_t>(count) > p.points.size()) {
        context.fail(node, "vertexCount: " + std::to_string(count) + " of " +
                               std::to_string(p.points.size() - first) + " points left, expected at least 2");
        return true;
      }
      for (std::size_t i = first + 1; i < first + static_cast<std::size_t>(count); ++i) {
        add_segment(context, node, p, corner(i - 1), corner(i), look, mesh);
      }
      first += static_cast<std::size_t>(count);
    }
  } else {
    const Indices points = context.wholes(node, "coordIndex");
    FaceAttribute colours(context, node, "colorIndex", context.flag(node, "colorPerVertex", true),
                          p.colours.size());
    std::size_t line = 0;
    const auto at = [&](std::size_t i) {
      return Corner{checked(context, node, "coordIndex", points[i], p.points.size()),
                    colours.of(i, points[i], line)};
    };
    each_run(points, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first + 1; i < first + count && !context.error(); ++i) {
        add_segment(context, node, p, at(i - 1), at(i), look, mesh);
      }
      ++line;
    });
  }
  mesh.positions = std::move(p.points);
  return true;
}

float size(Context& context, const xml_node& node, const char* field, float otherwise) {
  const float value = context.scalar(node, field, otherwise);
  if (!(value >= 0)) context.fail(node, std::string(field) + " is below 0");
  return value;
}

bool read_solid(Context& context, const xml_node& node, const Look& look, Mesh& mesh) {
  const std::string_view name = node.name();
  const Parts parts{.side = context.flag(node, "side", true),
                    .top = context.flag(node, "top", true),
                    .bottom = context.flag(node, "bottom", true)};
  if (name == "Box") {
    mesh = box(glm::abs(context.vector(node, "size", glm::vec3(2))));
  } else if (name == "Sphere") {
    mesh = sphere(size(context, node, "radius", 1));
  } else if (name == "Cylinder") {
    mesh = cylinder(size(context, node, "radius", 1), size(context, node, "height", 2), parts);
  } else if (name == "Cone") {
    mesh = cone(size(context, node, "bottomRadius", 1), size(context, node, "height", 2), parts);
  } else {
    return false;
  }
  for (Face& face : mesh.faces) {
    face.colour.fill(look.stored(look.colour));
    for (glm::vec2& uv : face.uv) uv = look.picture_position({uv.x, 1 - uv.y});
  }
  context.spend(node, context.faces_left, mesh.faces.size(), "1,000,000 faces");
  context.spend(node, context.vertices_left, mesh.positions.size(), "4,000,000 vertices");
  return true;
}

bool read_polygons(Context& context, const xml_node& node, const Look& look, Mesh& mesh) {
  const std::string_view name = node.name();
  const auto* kind =
      std::find_if(set_kinds.begin(), set_kinds.end(), [&](const SetKind& k) { return k.name == name; });
  if (kind == set_kinds.end() && name != "IndexedFaceSet") return false;
  Polygons p;
  if (!read_lists(context, node, p)) return true;
  if (kind != set_kinds.end()) {
    read_set(context, node, *kind, p);
  } else {
    read_face_set(context, node, p);
  }
  if (context.error()) return true;
  if (!context.flag(node, "ccw", true)) {
    std::size_t first = 0;
    for (const std::uint32_t count : p.sizes) {
      const auto begin = p.corners.begin() + static_cast<std::ptrdiff_t>(first);
      std::reverse(begin, begin + static_cast<std::ptrdiff_t>(count));
      first += count;
    }
  }
  add_polygons(context, node, p, look, mesh);
  return true;
}

}  // namespace

std::optional<Geometry> read_geometry(Context& context, const xml_node& node, const Look& look) {
  Geometry geometry;
  if (context.attribute(node, "solid")) {
    geometry.sides = context.flag(node, "solid", true) ? Geometry::Sides::front : Geometry::Sides::both;
  }
  if (read_solid(context, node, look, geometry.mesh) || read_polygons(context, node, look, geometry.mesh) ||
      read_lines(context, node, look, geometry.mesh) || read_2d(context, node, look, geometry)) {
    return geometry;
  }
  context.unsupported(node);
  return std::nullopt;
}

}  // namespace load::x3d
