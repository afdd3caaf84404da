#pragma once
// Keys that are held move the camera. One of them, D, also has a meaning when tapped: a tap is shorter than a
// fifth of a second, and only after that does holding count.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace app {

/// What the held keys, the controller's sticks and triggers ask of the camera now, each -1..1.
struct Motion {
  double orbit_x = 0, orbit_y = 0;  ///< right and up
  double look_x = 0, look_y = 0;
  glm::vec3 fly{0.0F};  ///< x right, y up, z backwards
  [[nodiscard]] bool any() const {
    return orbit_x != 0 || orbit_y != 0 || look_x != 0 || look_y != 0 || fly != glm::vec3(0.0F);
  }
};

class HeldKeys {
 public:
  static constexpr double tap_seconds = 0.2;

  /// True if the key moves the camera as soon as it is down, so that it must not be
  /// looked up in the key table.
  bool press(std::string_view key, double now);
  /// True if this ends a tap: the key's meaning in the key table counts.
  bool release(std::string_view key, double now);
  void release_all() { since_ = {}; }
  [[nodiscard]] bool any() const;
  [[nodiscard]] Motion motion(double now) const;

 private:
  static constexpr std::size_t count = 10;
  std::array<std::optional<double>, count> since_;
  static std::size_t index(std::string_view key);
};

}  // namespace app
