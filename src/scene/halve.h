#pragma once
// Polygons in pieces, chosen by what is on the screen: `--subdivide size-N` and `error-N`.
//
// An edge is halved, in view space, for all the faces that lie at it: whether and where depends on its two
// ends alone. So no crack opens between neighbours, however differently the rest of them is cut.

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scene/clip.h"
#include "scene/knobs.h"

namespace scene {

class Halver {
 public:
  /// `by`: size or error. The clipper makes the new points, and the projection says how long an edge is.
  Halver(const Subdivide& by, const Projection& projection, const Clipper& clipper);

  /// Whether an edge is too long, or its middle too far from where affine interpolation puts it: texture
  /// coordinates run along the edge on the screen by L |za - zb| / (2 (za + zb)) pixels of its L too far.
  [[nodiscard]] bool halves(glm::dvec3 a, glm::dvec3 b) const;

  /// Calls draw(a, b, c) for every piece, wound like the whole. All corners lie inside the clipper's planes.
  /// Pieces wholly outside the picture are left out.
  template <class Draw>
  void triangle(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c, const Draw& draw) const {
    pieces({a, b, c}, draw, 0);
  }

 private:
  using Three = std::array<ClipVertex, 3>;

  // Every step halves an edge, so this depth is never met; it bounds the stack whatever the rounding does.
  static constexpr int deepest = 48;

  template <class Draw>
  void pieces(const Three& t, const Draw& draw, int depth) const;
  /// Not where rounding would put the middle on an end.
  [[nodiscard]] bool middle_of(const ClipVertex& a, const ClipVertex& b, ClipVertex& middle) const;

  const Clipper& clipper_;
  SubdivideBy by_;
  double limit_, h_;
};

template <class Draw>
void Halver::pieces(const Three& t, const Draw& draw, int depth) const {
  if (depth > 0 && clipper_.wholly_beyond(t) != Beyond::nothing) return;
  Three middle;  // of the edge from corner k to the next
  std::array<bool, 3> has{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && depth < deepest; ++k) {
    has[k] = middle_of(t[k], t[(k + 1) % 3], middle[k]);
    count += has[k] ? 1 : 0;
  }
  const auto next = [&](const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    pieces({a, b, c}, draw, depth + 1);
  };
  if (count == 0) return draw(t[0], t[1], t[2]);
  if (count == 3) {
    next(t[0], middle[0], middle[2]);
    next(middle[0], t[1], middle[1]);
    next(middle[2], middle[1], t[2]);
    return next(middle[0], middle[1], middle[2]);
  }
  // Turned so that edge 0 is halved, and edge 1 too if there are two.
  std::size_t first = 0;
  while (!has[first] || (count == 2 && !has[(first + 1) % 3])) ++first;
  const auto &a = t[first], &b = t[(first + 1) % 3], &c = t[(first + 2) % 3];
  const auto& on_ab = middle[first];
  if (count == 1) {
    next(a, on_ab, c);
    return next(on_ab, b, c);
  }
  const auto& on_bc = middle[(first + 1) % 3];
  next(on_ab, b, on_bc);
  if (glm::distance(a.position, on_bc.position) < glm::distance(on_ab.position, c.position)) {
    next(a, on_ab, on_bc);
    return next(a, on_bc, c);
  }
  next(a, on_ab, c);  // the shorter diagonal makes the stouter pieces
  next(on_ab, on_bc, c);
}

}  // namespace scene
