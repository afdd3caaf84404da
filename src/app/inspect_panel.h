#pragma once
// The inspector: a slider over the draws of a frame, and the history of the pixel under the mouse.

#include "app/inspection.h"
#include "app/layout.h"
#include "app/window_state.h"

namespace app {

/// `picture`: where the picture is, and how many pixels it has.
void draw_inspect_panel(WindowState& state, const Inspection& inspection, Rect picture, int width, int height,
                        Rect area, float scale);

}  // namespace app
