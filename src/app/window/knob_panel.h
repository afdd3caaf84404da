#pragma once
// The knob panel: every row of scene::knob_table() as a widget, live.

#include <string>

#include "app/subject.h"
#include "app/window/dock.h"
#include "app/window/window_state.h"

namespace app {

/// Draws it where it is docked, and changes state.knobs. Knobs that do nothing for the subject are grey and
/// say why. `command`: what draws the picture without a window.
void draw_knob_panel(WindowState& state, const Subject& subject, const std::string& command,
                     const Docked& docked, float scale);

}  // namespace app
