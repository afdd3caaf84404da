#pragma once
// The cost panel: what the frame on screen would cost with each knob set otherwise, live.

#include "app/window/cost_table.h"
#include "app/window/dock.h"
#include "app/window/window_state.h"

namespace app {

/// Draws the panel where it is docked; a click on a setting puts it into state.knobs.
void draw_cost_panel(WindowState& state, const CostTable& table, const Docked& docked, float scale);

}  // namespace app
