#pragma once
// What moves in an X3D scene, and where everything stands at a given time.

#include <array>
#include <cstdint>
#include <vector>

#include "load/rotation.h"
#include "load/x3d/x3d.h"
#include "scene/world.h"

namespace load::x3d {

/// The fields of a node that place something, as the file gives them or as an interpolator sets them.
struct TransformFields {
  glm::vec3 centre{0.0F}, scale{1.0F}, translation{0.0F};
  Rotation rotation, scale_orientation;
};
struct ViewFields {
  glm::vec3 position{0, 0, 10};
  Rotation orientation;
  float field_of_view = 0.785398F;  ///< radians, over the shorter side of the picture
};
struct LightFields {
  glm::vec3 direction{0, 0, -1}, colour{1.0F};
  float intensity = 1;
};
struct Fields {
  std::vector<TransformFields> transforms;
  ViewFields view;
  std::vector<LightFields> lights;
};

/// One place in the tree; parents stand before their children.
struct Place {
  std::uint32_t parent = none, transform = none;
};

/// Which place each thing has. World::instances and World::lights are set in these orders.
struct Layout {
  std::vector<Place> places{{}};
  std::vector<std::uint32_t> instances;  ///< place of each
  std::vector<std::uint32_t> lights;
  std::uint32_t view = none;  ///< none: the camera stays as it is
  bool has_headlight = true;  ///< it comes after the lights
  bool is_mirrored = false;   ///< a picture of 2D nodes: y runs down from the camera's height
};

/// Sets instances, lights and camera.
void arrange(const Layout& layout, const Fields& fields, World& world);

/// TimeSensor. Time 0 is the first frame.
struct Clock {
  double start = 0, cycle = 1;
  bool loops = false, is_on = true;
};

/// An interpolator: values over keys, driven by a clock.
struct Track {
  enum class Kind : std::uint8_t { linear, rotation, spline } kind = Kind::linear;
  std::uint32_t clock = none;
  std::vector<float> keys;
  std::vector<std::array<float, 4>> values;      ///< one per key; 1, 3 or 4 (axis, radians) are used
  std::vector<Rotation> rotations;               ///< kind rotation: the same as quaternions
  std::vector<std::array<float, 4>> velocities;  ///< kind spline: tangents in value units per key step
  bool is_closed = false;                        ///< kind spline: the end joins the beginning
};

/// Where a track's value goes.
struct Binding {
  enum class Field : std::uint8_t {
    translation,
    rotation,
    scale,
    centre,
    scale_orientation,
    view_position,
    view_orientation,
    view_field_of_view,
    light_direction,
    light_colour,
    light_intensity
  } field;
  std::uint32_t index = 0, track = 0;
};

struct Animation {
  std::vector<Clock> clocks;
  std::vector<Track> tracks;
  std::vector<Binding> bindings;
  /// `fields` as the bindings set them at `seconds`; those without a binding, or
  /// before a clock's start, stay.
  void set(Fields& fields, double seconds) const;
};

/// A track's value at a fraction of its clock.
std::array<float, 4> sample(const Track& track, double fraction);
/// The same of a rotation track.
Rotation sample_rotation(const Track& track, double fraction);

/// DEF'd nodes that a ROUTE may lead to, as indices into Fields.
struct Targets {
  std::map<pugi::xml_node, std::uint32_t> transforms, lights;
  pugi::xml_node view;
};
/// Reads TimeSensors, interpolators and ROUTEs of the whole tree. What cannot be animated is a warning.
Animation read_animation(Context& context, const pugi::xml_node& root, const Targets& targets);

Rotation read_rotation(Context& context, const pugi::xml_node& node, const char* field);

}  // namespace load::x3d
