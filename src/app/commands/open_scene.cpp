#include "app/commands/open_scene.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "demos/demos.h"
#include "load/load.h"

namespace app {

std::string scene_names() {
  std::string names;
  for (const auto& demo : demos::all()) names.append(names.empty() ? "" : ", ").append(demo.name);
  return names;
}

base::Result<scene::Scene> open_scene(const std::string& name) {
  if (const auto* demo = demos::find(name)) return demos::make(*demo);
  std::error_code ignored;
  const bool is_path = name.find_first_of("./") != std::string::npos;
  if (!is_path && !std::filesystem::exists(name, ignored)) {
    return base::fail(name + ": no such scene; expected one of " + scene_names() + ", or a file");
  }
  auto loaded = load::load(name);
  if (!loaded) return tl::make_unexpected(loaded.error());
  for (const auto& warning : loaded->warnings) std::fprintf(stderr, "otter: %s\n", warning.c_str());
  return std::move(loaded->scene);
}

}  // namespace app
