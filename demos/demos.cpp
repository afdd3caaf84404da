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
