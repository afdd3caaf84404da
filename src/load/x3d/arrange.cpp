// Where everything in an X3D scene stands, from the fields of its nodes.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "load/x3d/animation.h"
#include "scene/angle.h"

namespace load::x3d {
namespace {

// [ISO/IEC 19775-1, Transform]: P' = T C R SR S -SR -C P
glm::mat4 matrix(const TransformFields& f) {
  const glm::mat4 stretch_axes = f.scale_orientation.matrix();
  return translation(f.translation + f.centre) * f.rotation.matrix() * stretch_axes * scaling(f.scale) *
         glm::transpose(stretch_axes) * translation(-f.centre);
}

std::vector<glm::mat4> place_matrices(const Layout& layout, const Fields& fields) {
  std::vector<glm::mat4> out;
  out.reserve(layout.places.size());
  for (const Place& place : layout.places) {
    const glm::mat4 outer = place.parent == none ? glm::mat4(1) : out[place.parent];
    out.push_back(place.transform == none ? outer : outer * matrix(fields.transforms[place.transform]));
  }
  return out;
}

// The turning part of a matrix that may also stretch; the identity where nothing of it is left.
glm::mat4 rotation_of(const glm::mat4& m) {
  const glm::vec3 x(m[0]), y(m[1]);
  const float x_length = glm::length(x);
  const glm::vec3 right = x / x_length;
  const glm::vec3 up = y - glm::dot(y, right) * right;
  const float up_length = glm::length(up);
  if (!(x_length > 0 && up_length > 0) || !std::isfinite(x_length + up_length)) return glm::mat4(1);
  const glm::vec3 top = up / up_length;
  return {glm::vec4(right, 0), glm::vec4(top, 0), glm::vec4(glm::cross(right, top), 0), {0, 0, 0, 1}};
}

float tan_half(float field_of_view) {
  const double half = turns(std::clamp(double{field_of_view}, 1e-3, 3.1)) / 2;
  return static_cast<float>(sin_turns(half) / cos_turns(half));
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

}  // namespace

void arrange(const Layout& layout, const Fields& fields, World& world) {
  const std::vector<glm::mat4> places = place_matrices(layout, fields);
  if (layout.view != none) {
    const glm::mat4 view =
        places[layout.view] * translation(fields.view.position) * fields.view.orientation.matrix();
    world.camera.position = glm::vec3(view[3]);
    world.camera.orientation = rotation_of(view);
    world.camera.tan_half_fov = tan_half(fields.view.field_of_view);
  }
  glm::mat4 picture(1);
  if (layout.is_mirrored) {
    picture = translation({0, 2 * world.camera.position.y, 0}) * scaling({1, -1, 1});
  }
  for (std::size_t i = 0; i < layout.instances.size(); ++i) {
    world.instances[i].model = picture * places[layout.instances[i]];
  }
  world.lights.clear();
  for (std::size_t i = 0; i < layout.lights.size(); ++i) {
    const LightFields& light = fields.lights[i];
    const glm::vec3 direction(places[layout.lights[i]] * glm::vec4(light.direction, 0));
    world.lights.push_back({.direction = unit_or(direction, {0, 0, -1}),
                            .colour = glm::clamp(light.colour * light.intensity, 0.0F, 1.0F)});
  }
  if (layout.has_headlight) world.lights.push_back({.at_camera = true});
}

}  // namespace load::x3d
