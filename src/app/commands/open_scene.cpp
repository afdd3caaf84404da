#include "app/commands/open_scene.h"

#include <filesystem>
#include <utility>

#include "app/commands/arguments.h"
#include "base/message.h"
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
  std::error_code fault;
  const bool is_path = name.find_first_of("./") != std::string::npos;
  if (!is_path && std::filesystem::status(name, fault).type() == std::filesystem::file_type::not_found) {
    return base::fail(name + ": no such scene; expected one of " + scene_names() + ", or a file");
  }
  auto loaded = load::load(name);
  if (!loaded) return tl::make_unexpected(loaded.error());
  for (const auto& warning : loaded->warnings) base::warn("otter", warning);
  if (auto apart = guard_inputs(loaded->files); !apart) return tl::make_unexpected(apart.error());
  return std::move(loaded->scene);
}

}  // namespace app
