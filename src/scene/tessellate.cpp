#include "scene/tessellate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

namespace scene {
namespace {

constexpr double most_periods = 64;  // that a face is cut into, each way
constexpr float close = 1e-4F;       // a point nearer to a line than this lies on it

bool comes_first(glm::vec3 a, glm::vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

// A corner of a face or of a part of it.
struct FacePoint {
  std::uint32_t vertex = 0;
  glm::vec2 uv{0.0F};
  glm::vec3 colour{0.0F};
};
using Polygon = std::vector<FacePoint>;

bool is_sound(const Mesh& mesh, const Face& face, std::size_t materials) {
  if (face.material >= materials) return false;
  return std::all_of(face.vertex.begin(), face.vertex.begin() + static_cast<std::ptrdiff_t>(face.corners()),
                     [&](std::uint32_t v) {
                       if (v >= mesh.positions.size()) return false;
                       const glm::vec3 p = mesh.positions[v];
                       return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
                     });
}

Polygon polygon_of(const Face& face) {
  Polygon out;
  for (std::size_t k = 0; k < face.corners(); ++k)
    out.push_back({face.vertex[k], face.uv[k], {face.colour[k].r, face.colour[k].g, face.colour[k].b}});
  return out;
}

// A mesh that grows while faces are cut.
class Cutter {
 public:
  Cutter(const Mesh& mesh, std::vector<std::uint32_t>& sources) : sources_(sources) {
    out_.positions = mesh.positions;
    if (mesh.normals.size() == mesh.positions.size()) out_.normals = mesh.normals;
    out_.lines = mesh.lines;
  }

  [[nodiscard]] glm::vec3 position(const FacePoint& p) const { return out_.positions[p.vertex]; }

  /// A new vertex between two.
  FacePoint between(const FacePoint& a, const FacePoint& b, double t) {
    const auto f = static_cast<float>(t);
    FacePoint out;
    out.vertex = static_cast<std::uint32_t>(out_.positions.size());
    out_.positions.push_back(edge_point(position(a), position(b), t));
    if (!out_.normals.empty()) {
      const glm::vec3 n = glm::mix(out_.normals[a.vertex], out_.normals[b.vertex], f);
      const float length = std::sqrt(glm::dot(n, n));
      out_.normals.push_back(length > 0 ? n / length : out_.normals[a.vertex]);
    }
    out.uv = glm::mix(a.uv, b.uv, f);
    out.colour = glm::mix(a.colour, b.colour, f);
    return out;
  }

  void add_face(std::span<const FacePoint> polygon, std::uint32_t material, std::uint32_t source) {
    Face face;
    face.material = material;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const auto channel = [](float c) { return static_cast<std::uint8_t>(c + 0.5F); };
      face.vertex[k] = polygon[k].vertex;
      face.uv[k] = polygon[k].uv;
      face.colour[k] = {channel(polygon[k].colour.r), channel(polygon[k].colour.g),
                        channel(polygon[k].colour.b)};
    }
    out_.faces.push_back(face);
    sources_.push_back(source);
  }

  // Convex, but with points in the middle of its sides: all triangles meet in a new point in the middle, so
  // that none of them is flat and no point is left out.
  void add_polygon(const Polygon& polygon, std::uint32_t material, std::uint32_t source) {
    if (polygon.size() < 3) return;
    if (polygon.size() == 3 || (polygon.size() == 4 && has_four_corners(polygon)))
      return add_face(polygon, material, source);
    FacePoint middle = between(polygon[0], polygon[polygon.size() / 2], 0.5);
    glm::dvec3 sum{0.0};
    glm::vec2 uv{0.0F};
    glm::vec3 colour{0.0F};
    const auto n = static_cast<float>(polygon.size());
    for (const auto& p : polygon) {
      sum += glm::dvec3(position(p));
      uv += p.uv / n;
      colour += p.colour / n;
    }
    out_.positions[middle.vertex] = glm::vec3(sum / static_cast<double>(n));
    middle.uv = uv;
    middle.colour = colour;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::array triangle{middle, polygon[k], polygon[(k + 1) % polygon.size()]};
      add_face(triangle, material, source);
    }
  }

  Mesh take() { return std::move(out_); }

 private:
  [[nodiscard]] bool has_four_corners(const Polygon& p) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec3 a(position(p[(k + 1) % 4]) - position(p[k]));
      const glm::dvec3 b(position(p[(k + 3) % 4]) - position(p[k]));
      const glm::dvec3 normal = glm::cross(a, b);
      if (glm::dot(normal, normal) <= 1e-8 * glm::dot(a, a) * glm::dot(b, b)) return false;
    }
    return true;
  }

  Mesh out_;
  std::vector<std::uint32_t>& sources_;
};

// ---- n x n

// The grid of points of one face: quads [row][column] from corner 0 along 0-1 and
// 0-3, triangles the half of it.
class FaceGrid {
 public:
  FaceGrid(Cutter& cutter, const Polygon& face, int n) : cutter_(cutter), face_(face), n_(n) {
    points_.resize(static_cast<std::size_t>((n + 1) * (n + 1)));
    const bool quad = face.size() == 4;
    for (int row = 0; row <= n; ++row) {
      // Both ends of a row lie on edges of the face; what is between depends on them.
      const int last = quad ? n : n - row;
      const FacePoint left = on_edge(0, quad ? 3 : 2, row);
      const FacePoint right = on_edge(1, 2, row);
      at(0, row) = left;
      if (last > 0) at(last, row) = right;
      for (int column = 1; column < last; ++column)
        at(column, row) = row == 0 ? on_edge(0, 1, column)
                          : row == n && quad
                              ? on_edge(3, 2, column)
                              : cutter_.between(left, right, static_cast<double>(column) / last);
    }
  }
  FacePoint& at(int column, int row) { return points_[static_cast<std::size_t>(row * (n_ + 1) + column)]; }

 private:
  FacePoint on_edge(std::size_t from, std::size_t to, int k) {
    if (k == 0) return face_[from];
    if (k == n_) return face_[to];
    return cutter_.between(face_[from], face_[to], static_cast<double>(k) / n_);
  }
  Cutter& cutter_;
  const Polygon& face_;
  int n_;
  std::vector<FacePoint> points_;
};

Mesh subdivided(const Mesh& mesh, std::span<const std::uint32_t> given, std::size_t materials, int n,
                std::vector<std::uint32_t>& sources) {
  Cutter cutter(mesh, sources);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    if (!is_sound(mesh, face, materials)) continue;
    const Polygon polygon = polygon_of(face);
    FaceGrid grid(cutter, polygon, n);
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < (face.is_quad() ? n : n - row); ++column) {
        const auto& a = grid.at(column, row);
        const auto& b = grid.at(column + 1, row);
        const auto& d = grid.at(column, row + 1);
        if (face.is_quad()) {
          cutter.add_face(std::array{a, b, grid.at(column + 1, row + 1), d}, face.material, given[f]);
          continue;
        }
        cutter.add_face(std::array{a, b, d}, face.material, given[f]);
        if (column + row < n - 1)
          cutter.add_face(std::array{b, grid.at(column + 1, row + 1), d}, face.material, given[f]);
      }
    }
  }
  return cutter.take();
}

// ---- whole u and v

// Where a face must be cut: at multiples of these; 0: nowhere.
struct Periods {
  std::array<int, 2> of{};  // u, v
  [[nodiscard]] bool any() const { return of[0] != 0 || of[1] != 0; }
};

int period_of(const TexelAxis& axis, const Polygon& polygon, int which, bool& too_many) {
  if (!axis.repeats) return 0;
  float low = polygon[0].uv[which];
  float high = low;
  for (const auto& p : polygon) {
    low = std::min(low, p.uv[which]);
    high = std::max(high, p.uv[which]);
  }
  if (!(high - std::floor(low) > static_cast<float>(axis.periods()) + close)) return 0;
  if (!((high - low) / static_cast<float>(axis.periods()) <= static_cast<float>(most_periods)) ||
      !(std::abs(low) < 1e5F)) {
    too_many = true;
    return 0;
  }
  return axis.periods();
}

// The multiples of `period` strictly between two coordinates, whose magnitude period_of() limits.
std::vector<float> lines_between(float a, float b, int period) {
  std::vector<float> out;
  const auto step = static_cast<float>(period);
  const float low = std::min(a, b);
  const float high = std::max(a, b);
  for (int i = static_cast<int>(std::floor(low / step)) + 1; static_cast<float>(i) * step < high; ++i)
    out.push_back(static_cast<float>(i) * step);
  return out;
}

// Fractions of the way, from the end that comes first, at which an edge is cut. Edges are known by the
// positions of their ends: neighbours need not share vertices.
class EdgeCuts {
 public:
  void add(glm::vec3 a, glm::vec3 b, double t) {
    auto& cuts = cuts_[key(a, b)];
    if (comes_first(b, a)) t = 1 - t;
    if (std::none_of(cuts.begin(), cuts.end(), [t](double other) { return std::abs(other - t) < 1e-6; }))
      cuts.push_back(t);
  }
  /// From a to b.
  [[nodiscard]] std::vector<double> between(glm::vec3 a, glm::vec3 b) const {
    const auto found = cuts_.find(key(a, b));
    if (found == cuts_.end()) return {};
    auto out = found->second;
    std::sort(out.begin(), out.end());
    if (comes_first(b, a)) {
      std::reverse(out.begin(), out.end());
      for (auto& t : out) t = 1 - t;
    }
    return out;
  }
  [[nodiscard]] bool empty() const { return cuts_.empty(); }

 private:
  using Key = std::array<float, 6>;
  static Key key(glm::vec3 a, glm::vec3 b) {
    if (comes_first(b, a)) std::swap(a, b);
    return {a.x, a.y, a.z, b.x, b.y, b.z};
  }
  std::map<Key, std::vector<double>> cuts_;
};

class Repeats {
 public:
  Repeats(const Mesh& mesh, std::span<const Material> materials, std::span<const StoredTexture> textures)
      : mesh_(mesh), materials_(materials), textures_(textures) {
    periods_.resize(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) find(f);
  }

  [[nodiscard]] bool needed() const { return !edges_.empty(); }
  [[nodiscard]] bool too_many() const { return too_many_; }

  Mesh cut(std::span<const std::uint32_t> given, std::vector<std::uint32_t>& sources) const {
    Cutter cutter(mesh_, sources);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const Face& face = mesh_.faces[f];
      if (!is_sound(mesh_, face, materials_.size())) continue;
      std::vector<Polygon> parts{with_edge_points(cutter, polygon_of(face), periods_[f])};
      for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
        if (periods_[f].of[axis] != 0) parts = slice(cutter, parts, axis, periods_[f].of[axis]);
      for (const auto& part : parts) cutter.add_polygon(part, face.material, given[f]);
    }
    return cutter.take();
  }

 private:
  void find(std::size_t f) {
    const Face& face = mesh_.faces[f];
    if (!is_sound(mesh_, face, materials_.size())) return;
    const auto texture = materials_[face.material].texture;
    if (texture >= textures_.size()) return;
    Polygon polygon = polygon_of(face);
    Periods& periods = periods_[f];
    periods.of = {period_of(textures_[texture].u, polygon, 0, too_many_),
                  period_of(textures_[texture].v, polygon, 1, too_many_)};
    for (auto& p : polygon) snap(p, periods);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const FacePoint& a = polygon[k];
      const FacePoint& b = polygon[(k + 1) % polygon.size()];
      for (int axis = 0; axis < 2; ++axis) {
        const int period = periods.of[static_cast<std::size_t>(axis)];
        if (period == 0) continue;
        for (const float line : lines_between(a.uv[axis], b.uv[axis], period))
          edges_.add(mesh_.positions[a.vertex], mesh_.positions[b.vertex],
                     static_cast<double>(line - a.uv[axis]) / static_cast<double>(b.uv[axis] - a.uv[axis]));
      }
    }
  }

  Polygon with_edge_points(Cutter& cutter, Polygon polygon, const Periods& periods) const {
    for (auto& p : polygon) snap(p, periods);
    Polygon out;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const FacePoint& a = polygon[k];
      const FacePoint& b = polygon[(k + 1) % polygon.size()];
      out.push_back(a);
      for (const double t : edges_.between(cutter.position(a), cutter.position(b))) {
        out.push_back(cutter.between(a, b, t));
        snap(out.back(), periods);
      }
    }
    return out;
  }

  // A point made for a line lies on the line, whatever the arithmetic: otherwise a slice would cut the edge
  // once more, for one of its faces only.
  static void snap(FacePoint& p, const Periods& periods) {
    for (int axis = 0; axis < 2; ++axis) {
      const auto step = static_cast<float>(periods.of[static_cast<std::size_t>(axis)]);
      if (step == 0) continue;
      const float line = std::floor(p.uv[axis] / step + 0.5F) * step;
      if (std::abs(line - p.uv[axis]) < close) p.uv[axis] = line;
    }
  }

  // The same to the bit for both parts that the edge belongs to.
  static FacePoint crossing(Cutter& cutter, const FacePoint& a, const FacePoint& b, double at_a,
                            double at_b) {
    if (comes_first(cutter.position(b), cutter.position(a))) return crossing(cutter, b, a, at_b, at_a);
    return cutter.between(a, b, at_a / (at_a - at_b));
  }

  static std::vector<Polygon> slice(Cutter& cutter, const std::vector<Polygon>& parts, std::size_t axis,
                                    int period) {
    const auto along = static_cast<int>(axis);
    std::vector<Polygon> out;
    for (Polygon rest : parts) {
      const auto [low, high] = std::minmax_element(
          rest.begin(), rest.end(),
          [along](const FacePoint& a, const FacePoint& b) { return a.uv[along] < b.uv[along]; });
      for (const float line : lines_between(low->uv[along], high->uv[along], period)) {
        Polygon below;
        Polygon above;
        for (std::size_t k = 0; k < rest.size(); ++k) {
          const FacePoint& a = rest[k];
          const FacePoint& b = rest[(k + 1) % rest.size()];
          const float at_a = a.uv[along] - line;
          const float at_b = b.uv[along] - line;
          if (at_a <= 0) below.push_back(a);
          if (at_a >= 0) above.push_back(a);
          if (at_a * at_b < 0) {
            FacePoint p = crossing(cutter, a, b, static_cast<double>(at_a), static_cast<double>(at_b));
            p.uv[along] = line;
            below.push_back(p);
            above.push_back(p);
          }
        }
        out.push_back(std::move(below));
        rest = std::move(above);
      }
      out.push_back(std::move(rest));
    }
    return out;
  }

  const Mesh& mesh_;
  std::span<const Material> materials_;
  std::span<const StoredTexture> textures_;
  std::vector<Periods> periods_;
  EdgeCuts edges_;
  bool too_many_ = false;
};

}  // namespace

glm::vec3 edge_point(glm::vec3 a, glm::vec3 b, double t) {
  constexpr double steps = 1 << 30;
  t = std::floor(t * steps + 0.5) / steps;
  if (comes_first(b, a)) {
    std::swap(a, b);
    t = 1 - t;
  }
  return glm::vec3(glm::dvec3(a) + (glm::dvec3(b) - glm::dvec3(a)) * t);
}

std::optional<Tessellated> tessellate(const Mesh& mesh, std::span<const Material> materials,
                                      std::span<const StoredTexture> textures, int subdivide,
                                      std::vector<std::string>& report) {
  std::optional<Tessellated> out;
  std::vector<std::uint32_t> sources(mesh.faces.size());
  for (std::size_t f = 0; f < sources.size(); ++f) sources[f] = static_cast<std::uint32_t>(f);
  const bool is_textured = std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    return face.material < materials.size() && materials[face.material].texture < textures.size();
  });
  if (!is_textured) return out;
  if (subdivide > 1) {
    out.emplace();
    out->mesh = subdivided(mesh, sources, materials.size(), subdivide, out->sources);
    sources = out->sources;
  }
  const Mesh& so_far = out ? out->mesh : mesh;
  const Repeats repeats(so_far, materials, textures);
  if (repeats.too_many())
    report.push_back("a face repeats its texture more than 64 times: it is shown stretched");
  if (!repeats.needed()) return out;
  Tessellated cut;
  cut.mesh = repeats.cut(sources, cut.sources);
  return cut;
}

}  // namespace scene
