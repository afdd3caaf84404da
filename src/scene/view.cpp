#include "scene/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "scene/angle.h"

namespace scene {
namespace {

bool is_finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_finite(const glm::dmat3& m) { return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]); }

gte::S3_12 fixed_1_3_12(double value) { return {round_saturated<std::int16_t>(value * 4096)}; }

}  // namespace

Projection projection_of(const Camera& camera, int width, int height, double units) {
  Projection p;
  p.width = width;
  p.height = height;
  const double tangent = camera.tan_half_fov > 0 ? static_cast<double>(camera.tan_half_fov) : 1.0;
  const int half_height = height / 2;
  p.h = std::max<std::uint16_t>(1, round_saturated<std::uint16_t>(half_height / tangent));
  p.stretch_x = width * 3.0 / (height * 4.0);
  p.near_z = std::clamp(round_saturated<std::int32_t>(camera.near_z * units), p.h / 2 + 1, 65534);
  return p;
}

View view_of(const Camera& camera, int width, int height, double units) {
  View view;
  view.projection = projection_of(camera, width, height, units);
  view.units = units;
  view.position = glm::dvec3(camera.position);
  const glm::dmat3 to_world{glm::dvec3(camera.orientation[0]), glm::dvec3(camera.orientation[1]),
                            glm::dvec3(camera.orientation[2])};
  const glm::dmat3 axes{glm::dvec3(view.projection.stretch_x, 0, 0), glm::dvec3(0, -1, 0),
                        glm::dvec3(0, 0, -1)};
  view.turn = axes * glm::transpose(to_world);
  return view;
}

Affine to_view(const View& view, const glm::mat4& model, glm::dvec3 centre, double scale) {
  const glm::dmat3 linear{glm::dvec3(model[0]), glm::dvec3(model[1]), glm::dvec3(model[2])};
  const glm::dvec3 origin = linear * centre + glm::dvec3(model[3]);
  return {view.turn * linear * (view.units / scale), view.turn * (origin - view.position) * view.units};
}

bool set_transform(gte::Registers& registers, const Affine& map, const Projection& projection) {
  constexpr double farthest = 1 << 28;  // with it no sum of the GTE leaves 43 bits
  if (!is_finite(map.linear) || !is_finite(map.offset)) return false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double value = map.linear[column][row];
      if (std::abs(value) >= 8) return false;
      registers.rt[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = fixed_1_3_12(value);
    }
    if (std::abs(map.offset[row]) > farthest) return false;
    registers.tr[static_cast<std::size_t>(row)] = round_saturated<std::int32_t>(map.offset[row]);
  }
  registers.ofx.raw = projection.width / 2 * 65536;
  registers.ofy.raw = projection.height / 2 * 65536;
  registers.h = projection.h;
  registers.zsf3.raw = zsf3;
  registers.zsf4.raw = zsf4;
  return true;
}

void set_depth_cue(gte::Registers& registers, const DepthCue& cue, const View& view) {
  // IR0 = far/(far-near) * (1 - near/z), z in GTE units, and q = H * 65536 / z is
  // what DQA is multiplied with.
  const double near_z = cue.near_z * view.units;
  const double far_z = cue.far_z * view.units;
  const double slope = far_z > near_z ? far_z / (far_z - near_z) : 1;
  registers.dqb.raw = round_saturated<std::int32_t>(slope * 4096 * 4096);
  registers.dqa.raw = round_saturated<std::int16_t>(-slope * near_z * 256 / view.projection.h);
  const std::array channels{cue.colour.r, cue.colour.g, cue.colour.b};
  for (std::size_t i = 0; i < 3; ++i) registers.fc[i].raw = channels[i] << 4;
}

void set_lights(gte::Registers& registers, const World& world, const glm::dmat3& normals_to_world) {
  registers.llm = {};
  registers.lcm = {};
  const glm::dmat3 camera{glm::dvec3(world.camera.orientation[0]), glm::dvec3(world.camera.orientation[1]),
                          glm::dvec3(world.camera.orientation[2])};
  for (std::size_t i = 0; i < std::min<std::size_t>(3, world.lights.size()); ++i) {
    const auto& light = world.lights[i];
    glm::dvec3 towards = -glm::dvec3(light.direction);
    if (light.at_camera) towards = camera * towards;
    const double length = std::sqrt(glm::dot(towards, towards));
    if (!(length > 0)) continue;
    const glm::dvec3 row = glm::transpose(normals_to_world) * (towards / length);
    for (int axis = 0; axis < 3; ++axis) {
      registers.llm[i][static_cast<std::size_t>(axis)] = fixed_1_3_12(row[axis]);
      registers.lcm[static_cast<std::size_t>(axis)][i] = fixed_1_3_12(light.colour[axis]);
    }
  }
  for (int c = 0; c < 3; ++c)
    registers.bk[static_cast<std::size_t>(c)].raw =
        round_saturated<std::int32_t>(std::clamp(static_cast<double>(world.ambient[c]), 0.0, 8.0) * 4096);
}

Box3 bounds_of(const Mesh& mesh) {
  constexpr double huge = std::numeric_limits<double>::infinity();
  Box3 box{glm::dvec3(huge), glm::dvec3(-huge)};
  for (const auto& p : mesh.positions) {
    const glm::dvec3 point(p);
    if (!is_finite(point)) continue;
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
  }
  return box.low.x > box.high.x ? Box3{} : box;
}

double choose_units(const World& world) {
  if (world.units_per_world > 0 && std::isfinite(world.units_per_world))
    return static_cast<double>(world.units_per_world);
  glm::dvec3 low(world.camera.position);
  glm::dvec3 high = low;
  for (const auto& instance : world.instances) {
    if (instance.mesh >= world.meshes.size()) continue;
    const Box3 box = bounds_of(world.meshes[instance.mesh]);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec4 p((corner & 1) != 0 ? box.high.x : box.low.x,
                        (corner & 2) != 0 ? box.high.y : box.low.y,
                        (corner & 4) != 0 ? box.high.z : box.low.z, 1.0);
      const glm::dvec3 placed(instance.model * p);
      if (!is_finite(placed)) continue;
      low = glm::min(low, placed);
      high = glm::max(high, placed);
    }
  }
  const double size = std::sqrt(glm::dot(high - low, high - low));
  constexpr double reach = 30000;
  return size > 0 && std::isfinite(size) ? std::clamp(reach / size, 1e-30, 1e30) : 1000;
}

}  // namespace scene
