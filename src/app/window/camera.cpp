#include "app/window/camera.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

namespace app {
namespace {

constexpr double quarter = std::numbers::pi / 2;

// The angles of a rotation: yaw about y, then pitch about x, then roll about z.
struct Angles {
  double yaw = 0, pitch = 0, roll = 0;
};

glm::mat4 rotation(const Angles& angles) {
  const auto by_yaw = glm::rotate(glm::mat4(1.0F), static_cast<float>(angles.yaw), glm::vec3(0, 1, 0));
  const auto by_pitch = glm::rotate(by_yaw, static_cast<float>(angles.pitch), glm::vec3(1, 0, 0));
  if (angles.roll == 0) return by_pitch;
  return glm::rotate(by_pitch, static_cast<float>(angles.roll), glm::vec3(0, 0, 1));
}

glm::vec3 direction(const glm::mat4& orientation, glm::vec3 v) {
  return glm::vec3(orientation * glm::vec4(v, 0));
}

Angles angles_of(const glm::mat4& orientation) {
  const auto forward = direction(orientation, {0, 0, -1});
  const auto right = direction(orientation, {1, 0, 0});
  Angles angles;
  angles.pitch = std::asin(std::clamp(static_cast<double>(forward.y), -1.0, 1.0));
  const bool is_upright = std::hypot(forward.x, forward.z) > 1e-4F;  // else yaw and roll turn about one axis
  angles.yaw = is_upright ? std::atan2(-forward.x, -forward.z) : std::atan2(-right.z, right.x);
  const auto level = rotation({angles.yaw, angles.pitch, 0});
  const double roll =
      std::atan2(glm::dot(right, direction(level, {0, 1, 0})), glm::dot(right, direction(level, {1, 0, 0})));
  angles.roll = std::abs(roll) < 1e-5 ? 0 : roll;  // what rounding leaves of none
  return angles;
}

constexpr double degree = std::numbers::pi / 180;

double thousandths(double degrees) {
  const double rounded = std::round(degrees * 1000) / 1000;
  return rounded == 0 ? 0 : rounded;  // no -0
}

scene::Camera start_of(const scene::Camera& base, const CameraOffset& offset) {
  return offset.from ? camera_at(base, *offset.from) : base;
}

void turn(double& yaw, double& pitch, double by_yaw, double by_pitch) {
  yaw = std::remainder(yaw + by_yaw, 4 * quarter);
  pitch = std::clamp(pitch + by_pitch, -quarter, quarter);
}

}  // namespace

void orbit(CameraOffset& offset, double yaw, double pitch) {
  turn(offset.orbit_yaw, offset.orbit_pitch, yaw, pitch);
}

void look(CameraOffset& offset, double yaw, double pitch) {
  turn(offset.look_yaw, offset.look_pitch, yaw, pitch);
}

void zoom(CameraOffset& offset, double steps) {
  offset.distance = std::clamp(offset.distance * std::pow(0.9, steps), 0.05, 20.0);
}

float pivot_distance(const scene::World& world) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (const auto& instance : world.instances) {
    for (const auto& position : world.meshes[instance.mesh].positions) {
      const auto point = glm::vec3(instance.model * glm::vec4(position, 1));
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  const float size = glm::length(high - low);
  if (world.instances.empty() || !std::isfinite(size) || size <= 0) return 1;
  const auto forward = direction(world.camera.orientation, {0, 0, -1});
  const float ahead = glm::dot((low + high) * 0.5F - world.camera.position, forward);
  return std::clamp(ahead, size / 100, size * 2);
}

scene::Camera camera_at(const scene::Camera& base, const CameraPlace& place) {
  scene::Camera camera = base;
  camera.position = place.position;
  camera.orientation = rotation({place.yaw * degree, place.pitch * degree, angles_of(base.orientation).roll});
  return camera;
}

CameraPlace place_of(const scene::Camera& base, const CameraOffset& offset, float pivot_distance) {
  const auto start = start_of(base, offset);
  const auto angles = angles_of(start.orientation);
  const auto pitched = [&](double by) { return std::clamp(angles.pitch + by, -quarter, quarter); };
  const auto pivot = start.position + direction(start.orientation, {0, 0, -1}) * pivot_distance;
  const auto orbited = rotation({angles.yaw + offset.orbit_yaw, pitched(offset.orbit_pitch), 0});
  const float distance = pivot_distance * static_cast<float>(offset.distance);
  const double yaw = std::remainder(angles.yaw + offset.orbit_yaw + offset.look_yaw, 4 * quarter);
  return {pivot + direction(orbited, {0, 0, 1}) * distance + offset.flown, thousandths(yaw / degree),
          thousandths(pitched(offset.orbit_pitch + offset.look_pitch) / degree)};
}

scene::Camera moved(const scene::Camera& base, const CameraOffset& offset, float pivot_distance) {
  if (offset == CameraOffset{}) return base;
  const bool is_only_placed = offset == CameraOffset{.from = offset.from};
  return camera_at(base, is_only_placed ? *offset.from : place_of(base, offset, pivot_distance));
}

void fly(CameraOffset& offset, const scene::Camera& base, glm::vec3 step, float pivot_distance) {
  offset.flown += direction(moved(base, offset, pivot_distance).orientation, step) * pivot_distance;
}

std::string to_text(const CameraPlace& place) {
  std::string text;
  const auto add = [&text](auto number) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(text.empty() ? "" : ",").append(digits.data(), end);
  };
  for (int axis = 0; axis < 3; ++axis) add(place.position[axis]);
  add(place.yaw);
  add(place.pitch);
  return text;
}

base::Result<CameraPlace> parse_camera(const std::string& text) {
  std::array<double, 5> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [rest, error] = std::from_chars(at, end, numbers[i]);
    const bool is_last = i + 1 == numbers.size();
    const bool goes_on = is_last ? rest == end : rest != end && *rest == ',';
    if (error != std::errc() || !goes_on || !std::isfinite(numbers[i]) || std::abs(numbers[i]) > 1e9) {
      return base::fail("--camera: expected X,Y,Z,YAW,PITCH, numbers such as 0,1.5,4,90,-10, got '" + text +
                        "'");
    }
    at = is_last ? rest : rest + 1;
  }
  if (std::abs(numbers[4]) > 90) {
    return base::fail("--camera: expected a pitch of -90..90 degrees, got '" + text + "'");
  }
  return CameraPlace{glm::vec3(numbers[0], numbers[1], numbers[2]), thousandths(numbers[3]),
                     thousandths(numbers[4])};
}

}  // namespace app
