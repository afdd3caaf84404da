#pragma once
// The inspector: maps of a frame, a slider over its draws, its wrong pixels by cause, and, while it is
// paused, the history of the pixel under the mouse.

#include "app/window/inspection.h"
#include "app/window/layout.h"
#include "app/window/window_state.h"

namespace app {

/// `picture`: where the picture is, and how many pixels it has.
void draw_inspect_panel(WindowState& state, const Inspection& inspection, Rect picture, int width, int height,
                        Rect area, float scale);

}  // namespace app
