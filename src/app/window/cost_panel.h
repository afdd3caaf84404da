#pragma once
// The cost panel: what the frame on screen would cost with each knob set otherwise, live.

#include "app/window/cost_table.h"
#include "app/window/layout.h"
#include "app/window/window_state.h"

namespace app {

/// Draws the panel; a click on a setting puts it into state.knobs.
void draw_cost_panel(WindowState& state, const CostTable& table, Rect area, float scale);

}  // namespace app
