#pragma once
// One maker per demo; each lives in the file of its name.

#include "scene/world.h"

namespace demos {

scene::Scene crates();
scene::Scene cyclic();
scene::Scene crossing();
scene::Scene corridor();
scene::Scene glass();
scene::Scene highlands();

}  // namespace demos
