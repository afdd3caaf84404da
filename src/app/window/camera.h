#pragma once
// Where the user has taken the camera, on top of the scene's own.

#include <glm/vec3.hpp>

#include "scene/world.h"

namespace app {

/// Nothing moved: the camera is the scene's, bit for bit, and the window shows what `otter render` draws.
struct CameraOffset {
  double orbit_yaw = 0, orbit_pitch = 0;  ///< radians round the pivot, pitch within a quarter turn
  double look_yaw = 0, look_pitch = 0;    ///< radians round the eye
  double distance = 1;                    ///< to the pivot, times the scene's own
  glm::vec3 flown{0.0F};                  ///< world units
  bool operator==(const CameraOffset&) const = default;
};

/// Radians, or steps of the distance: what a drag, a key held for a frame or a stick adds.
void orbit(CameraOffset& offset, double yaw, double pitch);
void look(CameraOffset& offset, double yaw, double pitch);
void zoom(CameraOffset& offset, double steps);

/// How far the camera is from what it looks at: from its position to the middle of all instances, along its
/// view axis; at least 1/100 of the world's size, so that it is never 0.
float pivot_distance(const scene::World& world);

/// Moves by `step` (x right, y up, z backwards; times the pivot distance) along the axes of the moved camera.
void fly(CameraOffset& offset, const scene::Camera& base, glm::vec3 step, float pivot_distance);

/// The scene's camera as the user has moved it.
scene::Camera moved(const scene::Camera& base, const CameraOffset& offset, float pivot_distance);

}  // namespace app
