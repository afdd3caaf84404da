#pragma once
// What is in the world, in floating point: the last place where there is any. Plain data; the submit stage
// reads it, nothing here knows of packets.
//
// Conventions: right-handed world, metres or whatever the maker likes; the camera looks along its -z, +y is
// up. The submit stage turns that into the console's view space (x right, y down, z into the screen).

#include <array>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "ot/gp0.h"
#include "scene/knobs.h"  // before `none`, which GCC would find shadowed by the `none` of one of its enumerations

namespace scene {

using ot::Blend, ot::TexelFormat;

inline constexpr std::uint32_t none = 0xffffffff;  ///< "no index" wherever an index may be missing

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb8&) const = default;
};

struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Rgba8&) const = default;
};

/// A picture of any size, rows from the top. Storing in VRAM scales and quantises it (scene/texture.h).
struct Texture {
  std::string name;
  int width = 0, height = 0;
  std::vector<Rgba8> pixels;  ///< width * height
  TexelFormat depth = TexelFormat::clut8;
  bool repeats = false;                 ///< texture coordinates outside 0..1 wrap; otherwise they are clamped
  int file_width = 0, file_height = 0;  ///< of the picture it was made from, where that was another size
};

struct Material {
  std::uint32_t texture = none;  ///< index into World::textures
  Blend blend = Blend::opaque;
  bool lit = false;            ///< colours go through NCDS/NCCS; otherwise they are final
  glm::vec3 self_light{0.0F};  ///< lit: light it gives itself, added to the ambient (BK); 0..7 a channel
  bool raw_texture = false;    ///< texel unchanged by colour
  bool double_sided = false;   ///< both windings are drawn
  int bias = 0;                ///< added to the bucket number of its faces: decals, floors
};

/// A triangle or a quad. Corners run round the face, counter-clockwise seen from its front.
struct Face {
  std::array<std::uint32_t, 4> vertex{none, none, none,
                                      none};  ///< index into positions; vertex[3] none: triangle
  std::array<glm::vec2, 4> uv{};              ///< 0,0 top left of the picture .. 1,1 bottom right
  std::array<Rgb8, 4> colour{};               ///< 128 = the texel unchanged; untextured: the colour itself
  std::uint32_t material = 0;                 ///< index into World::materials
  [[nodiscard]] bool is_quad() const { return vertex[3] != none; }
  [[nodiscard]] std::size_t corners() const { return is_quad() ? 4 : 3; }
};

/// A segment or, with equal ends, a dot. Lines have no depth on the console: they are sorted, never tested.
struct Line {
  std::array<std::uint32_t, 2> vertex{};
  std::array<Rgb8, 2> colour{};
  std::uint32_t material = 0;
};

struct Mesh {
  std::vector<glm::vec3> positions;
  /// Unit length, one per position, or empty: faces are lit by their own normal.
  std::vector<glm::vec3> normals;
  std::vector<Face> faces;
  std::vector<Line> lines;
};

struct Instance {
  std::uint32_t mesh = 0;
  glm::mat4 model{1.0F};  ///< object to world; affine
};

struct Camera {
  glm::vec3 position{0.0F};
  glm::mat4 orientation{1.0F};  ///< rotation only, camera to world
  /// Half of the field of view's tangent, over the shorter side of the picture: H =
  /// (shorter / 2) / tan_half_fov.
  float tan_half_fov = 0.41421356F;
  float near_z = 0.1F;  ///< world units; never nearer than the transform allows
};

struct DirectionalLight {
  glm::vec3 direction{0, 0, -1};  ///< the way the light travels, world space
  glm::vec3 colour{1, 1, 1};      ///< 0..1
  bool at_camera = false;         ///< a headlight: direction is in camera space
};

struct DepthCue {
  bool on = false;
  Rgb8 colour{};                ///< the far colour (FC)
  float near_z = 0, far_z = 1;  ///< world units: no fog at near, only fog at far
};

struct World {
  std::vector<Mesh> meshes;
  std::vector<Texture> textures;
  std::vector<Material> materials{Material{}};
  std::vector<Instance> instances;
  Camera camera;
  std::vector<DirectionalLight> lights;  ///< the first three are used: the GTE's light matrix has three rows
  glm::vec3 ambient{0.0F};               ///< 0..1
  DepthCue depth_cue;
  Rgb8 background{};
  float units_per_world = 0;  ///< GTE units per world unit; 0: chosen so that the world fits, and reported
};

/// A world that moves: `animate` sets instances, camera and lights to the state at `seconds`
/// (frame N is N/60) and depends on nothing else, so frames can be asked for in any order.
/// Meshes and textures do not change.
struct Scene {
  std::string name;   ///< "crates"
  std::string title;  ///< "Textured crates, spinning"
  std::string shows;  ///< one sentence: what to look for
  World world;
  std::function<void(World&, double seconds)> animate;  ///< may be empty
};

}  // namespace scene
