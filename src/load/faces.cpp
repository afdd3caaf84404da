#include "load/faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

#include "load/distinct.h"
#include "scene/angle.h"

namespace load {
namespace {

using glm::dvec2, glm::dvec3;

// Twice the area, pointing to the front (Newell); right for any simple polygon, flat or not.
dvec3 area_vector(std::span<const glm::vec3> corners) {
  dvec3 sum{0.0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += glm::cross(dvec3(corners[i]) - dvec3(corners[0]),
                      dvec3(corners[(i + 1) % corners.size()]) - dvec3(corners[0]));
  }
  return sum;
}

// The polygon seen along the largest axis of its normal, counter-clockwise.
std::vector<dvec2> flatten(std::span<const glm::vec3> corners, const dvec3& normal) {
  const dvec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const bool flip = normal[drop] < 0;
  std::vector<dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& p : corners) {
    const dvec2 q{p[(drop + 1) % 3], p[(drop + 2) % 3]};
    flat.push_back(flip ? dvec2{q.y, q.x} : q);
  }
  return flat;
}

double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Every corner turns left, and the border goes round once: a star turns left everywhere too.
bool is_convex(const std::vector<dvec2>& p) {
  const std::size_t n = p.size();
  int direction_changes = 0;
  bool rising = p[0].y > p[n - 1].y;
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
    const double dy = p[(i + 1) % n].y - p[i].y;
    if (dy != 0 && (dy > 0) != rising) {
      rising = dy > 0;
      ++direction_changes;
    }
  }
  return direction_changes <= 3;
}

// The four corners lie in one plane, to a thousandth of the polygon's size.
bool is_flat(std::span<const glm::vec3> corners, const dvec3& normal) {
  const double off = glm::dot(dvec3(corners[3]) - dvec3(corners[0]), normal);
  const double length = glm::length(normal);
  return std::abs(off) <= 1e-3 * length * std::sqrt(length);
}

void fan(std::size_t corners, std::vector<Piece>& pieces) {
  for (std::uint32_t i = 1; i + 1 < corners; ++i) pieces.push_back({0, i, i + 1, none});
}

bool holds(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

void cut_ears(const std::vector<dvec2>& p, std::uint64_t& work, std::vector<Piece>& pieces) {
  // What is left is a ring: taking a corner out costs nothing.
  const auto count = static_cast<std::uint32_t>(p.size());
  std::vector<std::uint32_t> before(count), after(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    before[i] = (i + count - 1) % count;
    after[i] = (i + 1) % count;
  }
  std::uint32_t b = 0;
  std::size_t left = count, misses = 0;
  while (left > 3) {
    const std::uint32_t a = before[b], c = after[b];
    const bool stuck = misses > left || work < left;  // self-crossing, or too dear: any corner will do
    bool is_ear = stuck || turn(p[a], p[b], p[c]) > 0;
    if (is_ear && !stuck) {
      work -= left;
      for (std::uint32_t q = after[c]; q != a; q = after[q]) {
        if (p[q] == p[a] || p[q] == p[b] || p[q] == p[c]) continue;
        if (holds(p[a], p[b], p[c], p[q])) {
          is_ear = false;
          break;
        }
      }
    }
    if (is_ear) {
      pieces.push_back({a, b, c, none});
      after[a] = c;
      before[c] = a;
      --left;
      misses = 0;
    } else {
      if (work > 0) --work;
      ++misses;
    }
    b = c;
  }
  const std::array<std::uint32_t, 3> last{before[b], b, after[b]};
  const auto least = std::min_element(last.begin(), last.end()) - last.begin();
  const auto at = [&](std::ptrdiff_t i) { return last[static_cast<std::size_t>((least + i) % 3)]; };
  pieces.push_back({at(0), at(1), at(2), none});
}

// Positions by value: the number of the first position with the same coordinates.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
  std::vector<std::array<std::uint32_t, 3>> keys;
  keys.reserve(positions.size());
  for (const glm::vec3& p : positions) {
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v + 0.0F); };  // + 0: no -0
    keys.push_back({bits(p.x), bits(p.y), bits(p.z)});
  }
  const Distinct same = number_distinct(keys);
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = same.first[same.number[i]];
  return first;
}

struct Forest {  // union-find: which positions hang together
  std::vector<std::uint32_t> parent;
  explicit Forest(std::size_t size) : parent(size) { std::iota(parent.begin(), parent.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent[root(a)] = root(b); }
};

}  // namespace

void split_polygon(std::span<const glm::vec3> corners, std::uint64_t& work, std::vector<Piece>& pieces) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) return fan(3, pieces);
  const dvec3 normal = area_vector(corners);
  if (normal == dvec3{0.0}) return fan(corners.size(), pieces);
  const std::vector<dvec2> flat = flatten(corners, normal);
  if (!is_convex(flat)) return cut_ears(flat, work, pieces);
  if (corners.size() == 4 && is_flat(corners, normal)) {
    pieces.push_back({0, 1, 2, 3});
    return;
  }
  fan(corners.size(), pieces);
}

std::vector<bool> faces_of_closed_surfaces(const Mesh& mesh) {
  const std::vector<std::uint32_t> same = weld(mesh.positions);
  Forest surfaces(mesh.positions.size());
  std::vector<std::uint64_t> edges;
  edges.reserve(mesh.faces.size() * 4);
  const auto each_edge = [&](const Face& face, auto&& visit) {
    const std::size_t n = face.corners();
    for (std::size_t i = 0; i < n; ++i) visit(same[face.vertex[i]], same[face.vertex[(i + 1) % n]]);
  };
  for (const Face& face : mesh.faces) {
    each_edge(face, [&](std::uint32_t a, std::uint32_t b) {
      surfaces.join(a, b);
      if (a != b) edges.push_back(std::uint64_t{a} << 32U | b);
    });
  }
  std::sort(edges.begin(), edges.end());

  std::vector<bool> is_open(mesh.positions.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint64_t back = edges[i] << 32U | edges[i] >> 32U;
    const bool once =
        (i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]);
    if (!once || !std::binary_search(edges.begin(), edges.end(), back)) {
      is_open[surfaces.root(static_cast<std::uint32_t>(edges[i] >> 32U))] = true;
    }
  }
  std::vector<double> volume(mesh.positions.size());
  for (const Face& face : mesh.faces) {
    const std::uint32_t root = surfaces.root(same[face.vertex[0]]);
    const dvec3 origin = mesh.positions[root];
    const auto at = [&](int i) {
      return dvec3(mesh.positions[face.vertex[static_cast<std::size_t>(i)]]) - origin;
    };
    volume[root] += glm::dot(at(0), glm::cross(at(1), at(2)));
    if (face.is_quad()) volume[root] += glm::dot(at(0), glm::cross(at(2), at(3)));
  }
  std::vector<bool> closed(mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::uint32_t root = surfaces.root(same[mesh.faces[i].vertex[0]]);
    closed[i] = !is_open[root] && volume[root] > 0;
  }
  return closed;
}

void Bounds::include(const glm::vec3& point) {
  low = empty ? point : glm::min(low, point);
  high = empty ? point : glm::max(high, point);
  empty = false;
}

float Bounds::radius() const { return glm::length(high - low) * 0.5F; }

Bounds bounds_of(const World& world) {
  Bounds bounds;
  std::vector<Bounds> local(world.meshes.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    for (const glm::vec3& p : world.meshes[i].positions) local[i].include(p);
  }
  for (const Instance& instance : world.instances) {
    const Bounds& box = local[instance.mesh];
    for (unsigned corner = 0; corner < 8 && !box.empty; ++corner) {
      const glm::vec3 p{corner & 1U ? box.high.x : box.low.x, corner & 2U ? box.high.y : box.low.y,
                        corner & 4U ? box.high.z : box.low.z};
      bounds.include(glm::vec3(instance.model * glm::vec4(p, 1)));
    }
  }
  return bounds;
}

Camera framing(const Bounds& bounds) {
  constexpr float sin_half_fov = 0.38268343F;  // of 45 degrees
  Camera camera;
  const float radius = std::max(bounds.radius(), 1e-6F);
  camera.position = bounds.centre() + glm::vec3(0, 0, radius / sin_half_fov);
  camera.near_z = (radius / sin_half_fov - radius) * 0.5F;
  return camera;
}

Camera framing_turned(const Mesh& mesh, double elevation) {
  Bounds bounds;
  for (const glm::vec3& p : mesh.positions) bounds.include(p);
  const glm::vec3 centre = bounds.centre();
  float radius = 1e-6F;  // of the upright cylinder that the turning mesh fills
  for (const glm::vec3& p : mesh.positions)
    radius = std::max(radius, glm::length(glm::vec2(p.x - centre.x, p.z - centre.z)));

  Camera camera;
  camera.orientation = rotation_x(-elevation);
  constexpr float margin = 1.05F;
  float distance = 0, nearest = 0;
  for (int step = 0; step < 64; ++step) {
    const auto x = static_cast<float>(sin_turns(step / 64.0)) * radius;
    const auto z = static_cast<float>(cos_turns(step / 64.0)) * radius;
    for (const float y : {bounds.low.y - centre.y, bounds.high.y - centre.y}) {
      const glm::vec3 seen(glm::transpose(camera.orientation) * glm::vec4(x, y, z, 0));
      const float side = std::max(std::abs(seen.x), std::abs(seen.y)) * margin;
      distance = std::max(distance, seen.z + side / camera.tan_half_fov);
      nearest = std::max(nearest, seen.z);
    }
  }
  camera.position = centre + glm::vec3(camera.orientation * glm::vec4(0, 0, distance, 0));
  camera.near_z = (distance - nearest) * 0.5F;
  return camera;
}

}  // namespace load
