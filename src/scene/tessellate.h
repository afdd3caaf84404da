#pragma once
// What a mesh has to become before its vertices are rounded to 16 bits, once and not per frame:
//   - with `--subdivide n`, textured faces are cut into n x n (affine texture coordinates bend less);
//   - faces that repeat a texture more often than 8-bit coordinates can say are cut at whole u and v.
//
// No crack may open at a cut. Every point on an edge is computed from the edge's two end positions, taken in
// a fixed order, and an edge is cut for all the faces that lie at it, also those that did not ask for it.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/texture.h"
#include "scene/world.h"

namespace scene {

struct Tessellated {
  Mesh mesh;
  std::vector<std::uint32_t> sources;  ///< for each face, the face of the given mesh it is a part of
};

/// The point t of the way from a to b, 0 < t < 1; edge_point(b, a, 1 - t) is the same to the bit. (t is
/// rounded to a multiple of 2^-30, so that 1 - t is exact.)
[[nodiscard]] glm::vec3 edge_point(glm::vec3 a, glm::vec3 b, double t);

/// Nothing if the mesh can stay as it is. `report` gets a line if a face repeats its texture too often to be
/// cut (more than 64 times one way); such a face shows its texture stretched. Faces that cannot be drawn
/// (make_model leaves them out) are left out here, too.
[[nodiscard]] std::optional<Tessellated> tessellate(const Mesh& mesh, std::span<const Material> materials,
                                                    std::span<const StoredTexture> textures, int subdivide,
                                                    std::vector<std::string>& report);

}  // namespace scene
