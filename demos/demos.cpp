#include "demos/demos.h"

#include <algorithm>
#include <array>
#include <string>

#include "demos/scenes.h"

namespace demos {
namespace {

constexpr std::array entries{
    Entry{"crates", "Textured crates, spinning",
          "Convex objects well apart: with 4096 buckets the ordering table shows what a z-buffer shows",
          crates},
    Entry{"cyclic", "Three bars in a cycle",
          "Each bar lies over the next: no painter's order is right, a z-buffer is", cyclic},
    Entry{"crossing", "Two walls that cross",
          "Surfaces that pass through each other: one is drawn over the other's nearer half", crossing},
    Entry{"corridor", "A long textured corridor",
          "Long floor quads sort in front of what stands on them, and affine textures bend", corridor},
    Entry{"glass", "Four panes of glass",
          "The four semi-transparency modes, and what list order does to layers of them", glass},
    Entry{"highlands", "Hills in the evening haze",
          "Light and fog per vertex by the GTE on a mesh of shared vertices", highlands},
};

}  // namespace

std::span<const Entry> all() { return entries; }

const Entry* find(std::string_view name) {
  const auto* const found =
      std::find_if(entries.begin(), entries.end(), [name](const Entry& e) { return e.name == name; });
  return found != entries.end() ? found : nullptr;
}

scene::Scene make(const Entry& entry) {
  scene::Scene s = entry.make();
  s.name = std::string(entry.name);
  s.title = std::string(entry.title);
  s.shows = std::string(entry.shows);
  return s;
}

}  // namespace demos
