#pragma once
// Polygons of any size and shape into the triangles and quads a Mesh holds, and which of them can only be
// seen from the front.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "load/scene_words.h"

namespace load {

/// Corners of one piece, as positions in the polygon it came from; corner[3] none: a triangle.
using Piece = std::array<std::uint32_t, 4>;

/// Splits a polygon; appends to `pieces`. A flat convex quad stays one, convex polygons become fans round
/// corner 0, concave ones are cut ear by ear in the plane of their area vector. Fewer than three corners give
/// nothing. `work` is what the ear tests may still cost (one test each) and goes down; at 0 concave polygons
/// become fans too, so the time for a whole file is bounded.
void split_polygon(std::span<const glm::vec3> corners, std::uint64_t& work, std::vector<Piece>& pieces);

inline constexpr std::uint64_t split_work = 200'000'000;  ///< a second or so

/// Per face: true if it belongs to a closed surface wound outwards (every edge once in each direction,
/// positive volume), so that its back is never in sight. Positions count as equal by value.
std::vector<bool> faces_of_closed_surfaces(const Mesh& mesh);

/// A box along the axes; bounds_of: round what the instances show, in world space.
struct Bounds {
  glm::vec3 low{0.0F}, high{0.0F};
  bool empty = true;
  void include(const glm::vec3& point);
  [[nodiscard]] glm::vec3 centre() const { return (low + high) * 0.5F; }
  [[nodiscard]] float radius() const;  ///< of the sphere round the box
};
Bounds bounds_of(const World& world);

/// A camera that sees the whole sphere round `bounds` from +z.
Camera framing(const Bounds& bounds);

/// A camera on the +z side, `elevation` turns above the horizon, no farther off than it must be to see all of
/// `mesh` in a square picture while the mesh turns round the upright axis through the centre of its bounds.
Camera framing_turned(const Mesh& mesh, double elevation);

}  // namespace load
