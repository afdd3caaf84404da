#include "app/window/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

namespace app {
namespace {

constexpr double quarter = std::numbers::pi / 2;

glm::mat4 turned(const glm::mat4& orientation, double yaw, double pitch) {
  const auto about_y = glm::rotate(glm::mat4(1.0F), static_cast<float>(yaw), glm::vec3(0, 1, 0));
  return orientation * glm::rotate(about_y, static_cast<float>(pitch), glm::vec3(1, 0, 0));
}

glm::vec3 direction(const glm::mat4& orientation, glm::vec3 v) {
  return glm::vec3(orientation * glm::vec4(v, 0));
}

glm::mat4 eye_orientation(const scene::Camera& base, const CameraOffset& offset) {
  return turned(turned(base.orientation, offset.orbit_yaw, offset.orbit_pitch), offset.look_yaw,
                offset.look_pitch);
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

void fly(CameraOffset& offset, const scene::Camera& base, glm::vec3 step, float pivot_distance) {
  offset.flown += direction(eye_orientation(base, offset), step) * pivot_distance;
}

scene::Camera moved(const scene::Camera& base, const CameraOffset& offset, float pivot_distance) {
  if (offset == CameraOffset{}) return base;
  scene::Camera camera = base;
  const auto pivot = base.position + direction(base.orientation, {0, 0, -1}) * pivot_distance;
  const auto orbited = turned(base.orientation, offset.orbit_yaw, offset.orbit_pitch);
  const float distance = pivot_distance * static_cast<float>(offset.distance);
  camera.position = pivot + direction(orbited, {0, 0, 1}) * distance + offset.flown;
  camera.orientation = eye_orientation(base, offset);
  return camera;
}

}  // namespace app
