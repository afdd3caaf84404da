#pragma once
// A loader speaks of nothing but what a scene holds, so it uses the scene's words as its own.

#include "scene/world.h"

namespace load {
using namespace scene;
}
