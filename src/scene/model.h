#pragma once
// A mesh made ready for the GTE once: 16-bit vertices, and every corner's colour given a number, so that a
// frame projects each vertex and lights each different corner once.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gte/registers.h"
#include "ot/packet.h"
#include "scene/texture.h"
#include "scene/world.h"

namespace scene {

/// What a corner's u and v leave over, eighths of a texel.
struct TexelRest {
  std::int8_t u = 0, v = 0;
};

/// A face in the console's order: clockwise on the screen when seen from its front, quads as a Z.
struct ModelFace {
  std::array<std::uint32_t, 4> vertex{};  ///< [3] = none: a triangle
  std::array<std::uint32_t, 4> colour{};  ///< indices into the colours of the frame
  std::array<ot::Uv, 4> uv{};
  std::array<TexelRest, 4> rest{};
  std::uint32_t material = 0;
  std::uint32_t source = 0;  ///< face of the scene's mesh
  bool gouraud = false;
  [[nodiscard]] bool is_quad() const { return vertex[3] != none; }
  [[nodiscard]] std::size_t corners() const { return is_quad() ? 4 : 3; }
};

struct ModelLine {
  std::array<std::uint32_t, 2> vertex{};
  std::array<std::uint32_t, 2> colour{};
  std::uint32_t material = 0;
  bool gouraud = false;
};

/// Colours that are lit against the same background light: those before `end` that no run before holds.
struct LitRun {
  std::size_t end = 0;
  std::array<std::int32_t, 3> self_light{};  ///< 1.19.12, added to BK: Material::self_light
};

/// Faces name colours by number. They stand in three runs, by what a frame has to do to them.
struct ModelColours {
  std::vector<gte::Colour> given;       ///< all, before light and fog
  std::vector<std::uint32_t> vertex;    ///< of the lit and the cued: whose depth the fog takes
  std::vector<gte::Vertex> normal;      ///< of the lit: 1.3.12
  std::vector<glm::vec3> exact_normal;  ///< of the lit, for instances that are not scaled evenly
  std::size_t lit = 0;                  ///< given[0, lit) are lit (and fogged)
  std::vector<LitRun> lit_runs;         ///< the lit, in order
  std::size_t cued = 0;                 ///< given[lit, cued) are only fogged; the rest stays as given
};

struct Model {
  glm::dvec3 centre{0.0};  ///< vertex = round((position - centre) * scale)
  double scale = 1;        ///< stored units per mesh unit
  double radius = 0;       ///< of all vertices round the centre, mesh units
  std::vector<gte::Vertex> vertices;
  std::vector<glm::vec3> positions;  ///< the same, unrounded: for the accurate transforms
  std::vector<ModelFace> faces;
  std::vector<ModelLine> lines;
  ModelColours colours;
};

/// `scale`: stored units per mesh unit wanted; less is used where 16 bits would not hold it. Faces and lines
/// with an index that is out of range, or a vertex that is not finite, are left out. `is_cued`: the world has
/// a depth cue.
[[nodiscard]] Model make_model(const Mesh& mesh, std::span<const std::uint32_t> sources,
                               std::span<const Material> materials, std::span<const StoredTexture> textures,
                               double scale, bool is_cued);

}  // namespace scene
