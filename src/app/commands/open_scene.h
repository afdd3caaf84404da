#pragma once
// SCENE|FILE on the command line.

#include <string>

#include "base/result.h"
#include "scene/world.h"

namespace app {

/// The demo of that name, or else the file of that name. What a file holds and Otter does not draw is named
/// on stderr, a line each. Error (exit 2): names the scenes there are.
base::Result<scene::Scene> open_scene(const std::string& name);

/// "crates, cyclic, ...".
std::string scene_names();

}  // namespace app
