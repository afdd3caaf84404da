#pragma once
// One maker per demo; each lives in the file of its name.

#include "scene/world.h"

namespace demos {

scene::Scene crates();

}  // namespace demos
