#pragma once
// The knob panel: every row of scene::knob_table() as a widget, live.

#include <string>

#include "app/window/layout.h"
#include "app/window/window_state.h"

namespace app {

/// Draws the panel and changes state.knobs. `scene` is what the command line would call the scene.
void draw_knob_panel(WindowState& state, const std::string& scene, Rect area, float scale);

}  // namespace app
