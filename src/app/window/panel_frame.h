#pragma once
// The frame of a docked panel: its title, a button that moves it to the other side and one that closes it.

#include <string>

#include "app/window/dock.h"
#include "app/window/window_state.h"

namespace app {

/// Begins the panel where it is docked. True: it is not folded, and what follows is drawn in it, until
/// end_panel(). False: nothing is to be drawn; end_panel() is due all the same.
bool begin_panel(WindowState& state, const Docked& docked);
void end_panel();

/// A tooltip whose lines end where a reader's eye does.
void wrapped_tooltip(const std::string& text);

/// The strips between columns and picture: dragged they change the columns' widths.
void draw_edges(WindowState& state, const DockLayout& layout, Rect area, float scale);

}  // namespace app
