#pragma once
// Camera and units: what turns a world in floating point into the registers of the GTE.
//
// View space is the console's: x right, y down, z into the screen, in GTE units. All arithmetic here is
// double with defined rounding, so the registers come out the same on every machine.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "gte/registers.h"
#include "scene/world.h"

namespace scene {

/// OTZ counts 0..65535 for z 0..32767, so bucket = OTZ * buckets >> 16, a plain shift for powers of two.
inline constexpr std::int16_t zsf3 = 2731;  ///< 4096 * 65536 / (3 * 32768), rounded
inline constexpr std::int16_t zsf4 = 2048;  ///< 4096 * 65536 / (4 * 32768)

/// The picture and the projection. The picture is 4:3 on the screen whatever its pixels, so x is stretched
/// for modes whose pixels are not square.
struct Projection {
  int width = 320, height = 240;
  std::uint16_t h = 290;      ///< H: (height / 2) / tan_half_fov, rounded
  double stretch_x = 1;       ///< width / (height * 4 / 3)
  std::int32_t near_z = 146;  ///< least z of a projected vertex: the camera's, but above H / 2
};

/// Vertices are projected within this rectangle; edges that leave it are cut there. Rounding a cut to whole
/// units moves it by less than a pixel for each of the (at most three) planes it lies on, so any two points
/// obey the GPU's size rule (1023 x 511), and all are inside the GTE's -1024..1023.
struct GuardBand {
  double half_width = 507, half_height = 252;  ///< from the picture's centre
};
inline constexpr GuardBand guard_band;

[[nodiscard]] Projection projection_of(const Camera& camera, int width, int height, double units);

/// World to view space, in GTE units.
struct View {
  Projection projection;
  double units = 1;          ///< GTE units per world unit
  glm::dmat3 turn{1.0};      ///< world axes to view axes, stretch included, units not
  glm::dvec3 position{0.0};  ///< of the camera, world units
};
[[nodiscard]] View view_of(const Camera& camera, int width, int height, double units);

/// An affine map: out = linear * in + offset.
struct Affine {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
};
/// Model to view space: `model` after the map from stored 16-bit vertices (p = centre + v / scale).
[[nodiscard]] Affine to_view(const View& view, const glm::mat4& model, glm::dvec3 centre, double scale);

/// Fills RT, TR, OFX, OFY, H, ZSF. False if the matrix does not fit into 1.3.12 or the offset into 2^28
/// units, or one of them is not finite: then the instance cannot be drawn.
[[nodiscard]] bool set_transform(gte::Registers& registers, const Affine& map, const Projection& projection);

/// Fills DQA and DQB so that IR0 is 0 at cue.near_z and 1.0 at cue.far_z (world units; between them it runs
/// with 1/z, as the GTE's does), and FC.
void set_depth_cue(gte::Registers& registers, const DepthCue& cue, const View& view);

/// Fills LLM, LCM and BK. `normals_to_world` turns stored normals into world space.
void set_lights(gte::Registers& registers, const World& world, const glm::dmat3& normals_to_world);

/// GTE units per world unit: world.units_per_world if it is above 0; otherwise chosen so that everything, the
/// camera included, lies within 30000 units of everything else.
[[nodiscard]] double choose_units(const World& world);

/// The box round all finite positions of a mesh.
struct Box3 {
  glm::dvec3 low{0.0}, high{0.0};
};
[[nodiscard]] Box3 bounds_of(const Mesh& mesh);

}  // namespace scene
