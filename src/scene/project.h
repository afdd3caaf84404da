#pragma once
// Model vertices to the screen, once per frame and instance: through the GTE's batch door, or in float or
// double for the price of accuracy. What comes out has the same shape either way.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gte/registers.h"
#include "scene/knobs.h"
#include "scene/model.h"
#include "scene/view.h"

namespace scene {

/// Where a projected vertex lies. A face whose vertices all lie beyond the same side is not visible; a face
/// with a vertex that is not projectable goes through the clipper.
namespace outcode {
inline constexpr std::uint8_t left = 1, right = 2, above = 4, below = 8;
inline constexpr std::uint8_t sides = 15;
/// Nearer than the near plane, beyond the guard band, or a value that the GTE saturated: its
/// screen position means nothing.
inline constexpr std::uint8_t unprojectable = 16;
}  // namespace outcode

/// Pixels beyond the picture that still count as inside: filters of anti-aliasing look this far.
inline constexpr int picture_margin = 4;

/// What is asked of a projection besides screen position and z.
struct Wanted {
  bool depth = false;      ///< z_20_12
  bool fractions = false;  ///< fraction_x, fraction_y
  bool fog = false;        ///< ir0
  bool operator==(const Wanted&) const = default;
};

/// Structure of arrays, one entry a vertex; arrays that are not wanted stay empty.
/// Memory is kept from frame to frame.
struct Projected {
  std::vector<gte::ScreenXy> sxy;
  std::vector<std::uint16_t> sz;
  std::vector<std::uint32_t> flag;
  std::vector<std::uint8_t> code;
  std::vector<std::int16_t> ir0;
  std::vector<std::uint32_t> z_20_12;
  std::vector<std::uint8_t> fraction_x, fraction_y;
  void resize(std::size_t vertices, const Wanted& wanted);
};

/// One instance on its way to the screen.
struct Placement {
  const Model* model = nullptr;
  Projection projection;
  Transform transform = Transform::gte;
  gte::Registers registers;  ///< set by set_transform; lights and fog too if there are any
  Affine exact;              ///< mesh positions (not stored vertices) to view space

  /// View-space position of a vertex: whole numbers as the GTE's MAC1..3 hold them, or unrounded.
  [[nodiscard]] glm::dvec3 view_position(std::uint32_t vertex) const;
};

/// Projects all vertices of the model and gives them outcodes.
void project(const Placement& placement, const Wanted& wanted, Projected& out);

/// One point of view space that lies within all planes of the clipper.
struct ProjectedPoint {
  gte::ScreenXy sxy;
  std::uint16_t sz = 0;
  std::uint32_t z_20_12 = 0;
  std::uint8_t fraction_x = 0, fraction_y = 0;
};
/// Projects it as project() would have projected a vertex there. For the GTE it must have whole coordinates:
/// x, y in s16, z in 0..65535.
[[nodiscard]] ProjectedPoint project_point(const Placement& placement, glm::dvec3 view);

/// The colours of one instance in this frame: NCCS or NCDS for the lit, DPCS for the fogged. `fogged`:
/// registers hold DQA, DQB and FC, and projected.ir0 is there.
class Shader {
 public:
  void shade(const Placement& placement, const Projected& projected, bool fogged,
             std::vector<gte::Colour>& out);
  /// For an instance whose normals do not keep their length: new ones, in world
  /// space, instead of the model's.
  void use_world_normals(const Model& model, const glm::dmat3& normals_to_world);
  void use_model_normals() { normals_.clear(); }

 private:
  std::vector<gte::Vertex> normals_;
  std::vector<std::int16_t> ir0_;
};

}  // namespace scene
