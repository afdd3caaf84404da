#pragma once
// What a scene comes to before any frame: models in 16 bits, textures packed beside the frame buffers.

#include <cstdint>
#include <string>
#include <vector>

#include "scene/model.h"
#include "scene/plan.h"
#include "scene/submit.h"
#include "scene/texture.h"
#include "scene/world.h"

namespace scene {

/// Depends on the picture's size, which says how much of VRAM is left for textures, and on the pieces that
/// faces are cut into once and for all. Materials refer to the textures, so it can be moved but not copied.
struct Content {
  Content() = default;
  Content(const World& world, int width, int height, int pieces);
  Content(Content&&) = default;
  Content& operator=(Content&&) = default;

  int width = 0, height = 0, pieces = 1;
  double units = 1;  ///< GTE units per world unit
  TexturePack pack;
  std::vector<PacketMaterial> materials;
  std::vector<Model> models;  ///< one per mesh
  Shown shown;                ///< what they have
  std::vector<std::string>
      report;  ///< for the user, once: scale, textures that were shrunk, repeats that were split

 private:
  void add_model(const World& world, std::uint32_t index, double largest_instance);
};

/// GP0 words that upload the textures, GP1 words that set display mode and ranges.
[[nodiscard]] std::vector<std::uint32_t> upload_gp0(const Content& content);
[[nodiscard]] std::vector<std::uint32_t> display_gp1(const Content& content);

}  // namespace scene
