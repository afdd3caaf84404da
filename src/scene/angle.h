#pragma once
// Angles and numbers that come out the same on every machine. std::sin differs between libraries, and the
// cast of a large float to an integer is undefined; frames must be neither.
//
// Not modelled: the console library's 4096-step angles. Angles here are fractions
// of a turn in floating point.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace scene {

/// Sine of an angle in turns (1 = once round). Looked up in a table that integer arithmetic made at compile
/// time (4096 steps, 30 fraction bits) and interpolated linearly; the error stays below 4e-7. Any finite
/// angle; NaN and infinite give 0.
double sin_turns(double turns);
double cos_turns(double turns);

/// The smallest non-negative angle in turns with that sine and cosine direction, 0 <= result < 1; (0, 0)
/// gives 0. Error below 1e-6 turns. The inverse of (cos_turns, sin_turns), for imported orientations.
double turns_of(double y, double x);

/// Rotations, right-handed, column vectors: rotation_y(0.25) takes +z to +x.
glm::mat4 rotation_x(double turns);
glm::mat4 rotation_y(double turns);
glm::mat4 rotation_z(double turns);
/// Round any axis; a zero axis gives the identity.
glm::mat4 rotation(glm::vec3 axis, double turns);

glm::mat4 translation(glm::vec3 offset);
glm::mat4 scaling(glm::vec3 factors);

/// The orientation of a camera at `from` that looks at `to`, +y up on the picture (any up if it looks
/// straight up or down; the identity if the two are equal).
glm::mat4 looking(glm::vec3 from, glm::vec3 to, glm::vec3 up = {0, 1, 0});

/// Rounds to the nearest integer, halves up, and saturates at the limits of Int; NaN gives 0.
template <std::integral Int>
constexpr Int round_saturated(double value) {
  if (!(value == value)) return 0;
  constexpr auto low = static_cast<double>(std::numeric_limits<Int>::min());
  constexpr auto high = static_cast<double>(std::numeric_limits<Int>::max());
  const double rounded = std::floor(value + 0.5);
  if (rounded <= low) return std::numeric_limits<Int>::min();
  if (rounded >= high) return std::numeric_limits<Int>::max();
  return static_cast<Int>(rounded);
}

/// The same towards minus infinity, as the console's right shifts do.
template <std::integral Int>
constexpr Int floor_saturated(double value) {
  if (!(value == value)) return 0;
  constexpr auto low = static_cast<double>(std::numeric_limits<Int>::min());
  constexpr auto high = static_cast<double>(std::numeric_limits<Int>::max());
  const double rounded = std::floor(value);
  if (rounded <= low) return std::numeric_limits<Int>::min();
  if (rounded >= high) return std::numeric_limits<Int>::max();
  return static_cast<Int>(rounded);
}

}  // namespace scene
