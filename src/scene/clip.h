#pragma once
// Clipping before projection, edge by edge.
//
// A point that a plane puts on an edge depends on the two ends of that edge alone, taken in a fixed order,
// and whether an end is outside depends on that end alone. So two faces that share an edge cut it in the same
// point, whatever else they look like, and no crack can open between them. Tests hold it: "neighbours insert
// the same vertex".
//
// The planes: near (never nearer than H/2, where the GTE's quotient overflows), far (65535), the guard band,
// and the 16 bits of view-space x and y. What is left obeys the GPU's size rule without further splitting.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "scene/view.h"

namespace scene {

struct ClipVertex {
  glm::dvec3 position{0.0};           ///< view space
  std::array<float, 3> colour{};      ///< 0..255
  std::array<float, 2> uv{};          ///< 0..255, whole at the corners of a face
  std::array<float, 2> exact_uv{};    ///< with the rests
  bool is_projectable = false;        ///< project() says so: no plane cuts it off
  std::uint32_t vertex = 0xffffffff;  ///< vertex of the model it was, none for a new one
};

/// At most 3 + one per plane.
inline constexpr std::size_t clip_planes = 10;
struct ClipPolygon {
  std::array<ClipVertex, 4 + clip_planes> vertex;
  std::size_t count = 0;
  void add(const ClipVertex& v) { vertex[count++] = v; }
  [[nodiscard]] std::span<const ClipVertex> corners() const { return std::span(vertex).first(count); }
};

/// Which side of the picture or range a whole polygon may lie on.
enum class Beyond : std::uint8_t { nothing, near_plane, far_plane, picture };

class Clipper {
 public:
  /// `whole`: new vertices are rounded to whole units, as the GTE's view space is.
  Clipper(const Projection& projection, bool whole);

  /// Cuts a polygon (or, with two vertices, a line) down to the planes. `in` is used up. Returns what is
  /// left: nothing if fewer than three (two) vertices are inside.
  void clip(ClipPolygon& in, ClipPolygon& out) const;

  /// The point half way along an edge whose ends are inside; the same from both ends.
  [[nodiscard]] ClipVertex middle(const ClipVertex& a, const ClipVertex& b) const;

  /// A plane that the whole polygon is beyond, or nothing. Exact for the picture's sides, margin included,
  /// also for vertices that cannot be projected.
  [[nodiscard]] Beyond wholly_beyond(std::span<const ClipVertex> polygon) const;

 private:
  struct Plane {
    glm::dvec3 normal{0.0};
    double offset = 0;
    [[nodiscard]] double distance(glm::dvec3 p) const {
      return normal.x * p.x + normal.y * p.y + normal.z * p.z + offset;
    }
  };
  [[nodiscard]] ClipVertex cut(const Plane& plane, const ClipVertex& a, const ClipVertex& b, double at_a,
                               double at_b) const;
  [[nodiscard]] ClipVertex point_on(const ClipVertex& a, const ClipVertex& b, double t,
                                    bool near_plane) const;

  std::array<Plane, clip_planes> planes_;
  std::array<Plane, 4> picture_;
  double near_z_;
  bool whole_;
};

}  // namespace scene
