#pragma once
// Where the user has taken the camera, on top of the scene's own.

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "scene/world.h"

namespace app {

/// A camera in five numbers, as --camera takes them. At 0, 0 it looks along -z; yaw turns it to the left,
/// pitch up. It rolls as the scene's own does.
struct CameraPlace {
  glm::vec3 position{0.0F};   ///< world units
  double yaw = 0, pitch = 0;  ///< degrees; whole thousandths, so that text and number are the same
  bool operator==(const CameraPlace&) const = default;
};

/// "1.5,0,-3,90,-12.5", and back. Error: --camera, what was expected, and the text.
std::string to_text(const CameraPlace& place);
base::Result<CameraPlace> parse_camera(const std::string& text);

/// Nothing moved: the camera is the scene's, bit for bit, and the window shows what `otter render` draws.
struct CameraOffset {
  std::optional<CameraPlace> from{};      ///< in place of the scene's own, which may move
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

/// The scene's camera at another place.
scene::Camera camera_at(const scene::Camera& base, const CameraPlace& place);
/// Where the user has moved it to.
CameraPlace place_of(const scene::Camera& base, const CameraOffset& offset, float pivot_distance);
/// The camera there: the scene's own, or camera_at(place_of()).
scene::Camera moved(const scene::Camera& base, const CameraOffset& offset, float pivot_distance);

}  // namespace app
