#pragma once
// Rotations as files give them, an axis and any angle in radians, and the way between two of them.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace load {

/// Radians as the fraction of a turn that angle.h wants.
constexpr double turns(double radians) { return radians / (2 * std::numbers::pi); }

/// A unit quaternion.
struct Rotation {
  double w = 1, x = 0, y = 0, z = 0;
  /// Counter-clockwise seen from the axis' tip. The axis may have any length; length 0 turns nothing.
  static Rotation about(const glm::vec3& axis, double turns);
  [[nodiscard]] glm::mat4 matrix() const;
};

/// On the shortest way from a to b, at an even speed: 0 gives a, 1 gives b.
Rotation between(const Rotation& a, const Rotation& b, double share);

}  // namespace load
