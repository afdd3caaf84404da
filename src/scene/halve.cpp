#include "scene/halve.h"

#include <cmath>

namespace scene {

Halver::Halver(const Subdivide& by, const Projection& projection, const Clipper& clipper)
    : clipper_(clipper), by_(by.by), limit_(by.n), h_(projection.h) {}

bool Halver::halves(glm::dvec3 a, glm::dvec3 b) const {
  const double x = h_ * (a.x / a.z - b.x / b.z), y = h_ * (a.y / a.z - b.y / b.z);
  const double length = std::sqrt(x * x + y * y);
  if (by_ == SubdivideBy::size) return length > limit_;
  return length * std::abs(a.z - b.z) > limit_ * 2 * (a.z + b.z);
}

bool Halver::middle_of(const ClipVertex& a, const ClipVertex& b, ClipVertex& middle) const {
  if (!halves(a.position, b.position)) return false;
  middle = clipper_.middle(a, b);
  return middle.position != a.position && middle.position != b.position;
}

}  // namespace scene
