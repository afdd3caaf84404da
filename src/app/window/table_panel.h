#pragma once
// The ordering table, or the list of a frame without one: how full its buckets are, what hangs in each, and
// everything about the command selected; what if it were left out, moved or changed.

#include <string>

#include "app/window/dock.h"
#include "app/window/lens.h"
#include "app/window/window_state.h"

namespace app {

/// What the panel asks of the window.
struct TableAsks {
  bool exports = false;  ///< write the frame with its changes as a dump
};

/// Draws the panel and changes state.lens.
TableAsks draw_table_panel(WindowState& state, Lens& lens, const Docked& docked, float scale);

}  // namespace app
