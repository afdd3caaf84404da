#include "load/rotation.h"

#include <cmath>

#include "scene/angle.h"

namespace load {
namespace {

Rotation unit(Rotation q) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(length > 0)) return {};
  return {q.w / length, q.x / length, q.y / length, q.z / length};
}

}  // namespace

Rotation Rotation::about(const glm::vec3& axis, double turns) {
  const glm::dvec3 a(axis);
  const double length = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  if (!(length > 0)) return {};
  const double sine = scene::sin_turns(turns / 2) / length;
  return unit({scene::cos_turns(turns / 2), sine * a.x, sine * a.y, sine * a.z});
}

glm::mat4 Rotation::matrix() const {
  glm::dmat4 m(1.0);
  m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
  m[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
  m[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
  return glm::mat4(m);
}

// Halving the arc needs a square root and no arc cosine; 30 halvings are below the step of a float.
Rotation between(const Rotation& a, const Rotation& b, double share) {
  if (share <= 0) return a;
  if (share >= 1) return b;
  Rotation low = a, high = b;
  if (a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0) high = {-b.w, -b.x, -b.y, -b.z};
  Rotation middle = low;
  for (int i = 0; i < 30; ++i) {
    middle = unit({low.w + high.w, low.x + high.x, low.y + high.y, low.z + high.z});
    share *= 2;
    if (share >= 1) {
      low = middle;
      share -= 1;
    } else {
      high = middle;
    }
  }
  return middle;
}

}  // namespace load
