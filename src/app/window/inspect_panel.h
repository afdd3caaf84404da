#pragma once
// The inspector: maps of a frame, a slider over its draws, its wrong pixels by cause, and, while it is
// paused, the history of the pixel under the mouse.

#include "app/window/dock.h"
#include "app/window/inspection.h"
#include "app/window/layout.h"
#include "app/window/window_state.h"

namespace app {

void draw_inspect_panel(WindowState& state, const Inspection& inspection, const Docked& docked, float scale);

/// `picture`: where the picture of so many pixels is. The pixel under the mouse outlined, and its history
/// beside it, the last lines of it if it is long.
void draw_history(const Inspection& inspection, Rect picture, int width, int height);

}  // namespace app
