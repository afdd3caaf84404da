// X3D's Geometry2D nodes, in the plane z = 0.   [ISO/IEC 19775-1, Geometry2D component]

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "load/rotation.h"
#include "load/x3d/x3d.h"
#include "scene/angle.h"

namespace load::x3d {
namespace {

using pugi::xml_node;

constexpr int steps_per_turn = 64;

struct Sweep {
  double from = 0, width = 1;  // turns
  [[nodiscard]] int steps() const { return std::max(2, static_cast<int>(std::ceil(width * steps_per_turn))); }
  [[nodiscard]] glm::vec3 at(int step, float radius) const {
    const double angle = from + width * step / steps();
    return {static_cast<float>(cos_turns(angle)) * radius, static_cast<float>(sin_turns(angle)) * radius, 0};
  }
};

// Counter-clockwise from the one angle to the other; a whole turn if they are the same.
Sweep read_sweep(Context& context, const xml_node& node) {
  const double from = turns(double{context.scalar(node, "startAngle", 0)});
  const double to = turns(double{context.scalar(node, "endAngle", 1.570796F)});
  double width = to - from;
  if (width == 0 || std::abs(width) >= 1) return {from, 1};
  if (width < 0) width += 1;
  return {from, width};
}

class Drawing {
 public:
  Drawing(Context& context, const xml_node& node, const Look& look, Geometry& geometry)
      : context_(context), node_(node), look_(look), mesh_(geometry.mesh) {}

  void polyline(const std::vector<glm::vec3>& points) {
    if (!room(points.size())) return;
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), points.begin(), points.end());
    for (std::uint32_t i = 1; i < points.size(); ++i) line(first + i - 1, first + i);
  }

  void dots(const std::vector<glm::vec2>& points) {
    if (!room(points.size())) return;
    for (const glm::vec2& p : points) {
      mesh_.positions.emplace_back(p, 0);
      line(static_cast<std::uint32_t>(mesh_.positions.size() - 1),
           static_cast<std::uint32_t>(mesh_.positions.size() - 1));
    }
  }

  // Polygons of `size` corners each, filled.
  void fill(std::vector<glm::vec3> points, std::uint32_t size) {
    if (!context_.spend(node_, context_.vertices_left, points.size(), "4,000,000 vertices")) return;
    Polygons p;
    p.points = std::move(points);
    const std::size_t whole = p.points.size() - p.points.size() % size;
    for (std::uint32_t i = 0; i < whole; ++i) p.corners.push_back({.point = i});
    p.sizes.assign(whole / size, size);
    add_polygons(context_, node_, p, look_, mesh_);
  }

 private:
  bool room(std::size_t count) {
    return context_.spend(node_, context_.vertices_left, count, "4,000,000 vertices") &&
           context_.spend(node_, context_.faces_left, count, "1,000,000 faces");
  }
  void line(std::uint32_t a, std::uint32_t b) {
    const Rgb8 colour = Look{}.stored(look_.line_colour);
    mesh_.lines.push_back({.vertex = {a, b}, .colour = {colour, colour}});
  }

  Context& context_;
  const xml_node& node_;
  Look look_;
  Mesh& mesh_;
};

std::vector<glm::vec3> flat(const std::vector<glm::vec2>& points) {
  std::vector<glm::vec3> out;
  out.reserve(points.size());
  for (const glm::vec2& p : points) out.emplace_back(p, 0);
  return out;
}

std::vector<glm::vec3> arc(const Sweep& sweep, float radius) {
  std::vector<glm::vec3> points;
  for (int i = 0; i <= sweep.steps(); ++i) points.push_back(sweep.at(i, radius));
  return points;
}

void triangles(Context& context, const xml_node& node, Drawing& drawing) {
  drawing.fill(flat(context.pairs(node, "vertices")), 3);
}
void rectangle(Context& context, const xml_node& node, Drawing& drawing) {
  const std::vector<glm::vec2> sizes = context.pairs(node, "size");
  const glm::vec3 half = glm::vec3(sizes.empty() ? glm::vec2(2) : sizes[0], 0) * 0.5F;
  drawing.fill({-half, {half.x, -half.y, 0}, half, {-half.x, half.y, 0}}, 4);
}
void disk(Context& context, const xml_node& node, Drawing& drawing) {
  const float inner = context.scalar(node, "innerRadius", 0), outer = context.scalar(node, "outerRadius", 1);
  const Sweep round;
  if (inner == outer) return drawing.polyline(arc(round, outer));
  std::vector<glm::vec3> points;
  for (int i = 0; i < round.steps(); ++i) {
    points.insert(points.end(),
                  {round.at(i, outer), round.at(i + 1, outer), round.at(i + 1, inner), round.at(i, inner)});
  }
  drawing.fill(std::move(points), 4);
}
void circle(Context& context, const xml_node& node, Drawing& drawing) {
  drawing.polyline(arc({}, context.scalar(node, "radius", 1)));
}
void open_arc(Context& context, const xml_node& node, Drawing& drawing) {
  drawing.polyline(arc(read_sweep(context, node), context.scalar(node, "radius", 1)));
}
void closed_arc(Context& context, const xml_node& node, Drawing& drawing) {
  std::vector<glm::vec3> points = arc(read_sweep(context, node), context.scalar(node, "radius", 1));
  const std::vector<std::string> closure = context.strings(node, "closureType");
  if (closure.empty() || closure[0] != "CHORD") points.emplace_back(0);
  const auto corners = static_cast<std::uint32_t>(points.size());
  drawing.fill(std::move(points), corners);
}
void polyline(Context& context, const xml_node& node, Drawing& drawing) {
  drawing.polyline(flat(context.pairs(node, "lineSegments")));
}
void dots(Context& context, const xml_node& node, Drawing& drawing) {
  drawing.dots(context.pairs(node, "point"));
}

struct Planar {
  std::string_view name;
  void (*draw)(Context&, const xml_node&, Drawing&);
};
constexpr std::array planar_kinds{
    Planar{"TriangleSet2D", &triangles}, Planar{"Rectangle2D", &rectangle}, Planar{"Disk2D", &disk},
    Planar{"Circle2D", &circle},         Planar{"Arc2D", &open_arc},        Planar{"ArcClose2D", &closed_arc},
    Planar{"Polyline2D", &polyline},     Planar{"Polypoint2D", &dots}};

const Planar* kind_of(std::string_view name) {
  const auto* kind =
      std::find_if(planar_kinds.begin(), planar_kinds.end(), [&](const Planar& k) { return k.name == name; });
  return kind == planar_kinds.end() ? nullptr : kind;
}

}  // namespace

bool is_2d_node(std::string_view name) { return kind_of(name) != nullptr; }

bool read_2d(Context& context, const xml_node& node, const Look& look, Geometry& geometry) {
  const Planar* kind = kind_of(node.name());
  if (kind == nullptr) return false;
  Look unlit = look;
  unlit.material.lit = false;
  unlit.material.self_light = glm::vec3(0);
  unlit.colour = look.material.texture == none ? look.line_colour : glm::vec3(1);
  Drawing drawing(context, node, unlit, geometry);
  kind->draw(context, node, drawing);
  geometry.is_2d = true;
  if (!context.attribute(node, "solid")) geometry.sides = Geometry::Sides::both;
  return true;
}

}  // namespace load::x3d
