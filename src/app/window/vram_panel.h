#pragma once
// What stands beside VRAM: how it is read, and what of it the frame reads and writes.

#include <span>

#include "app/window/dock.h"
#include "app/window/window_state.h"
#include "debug/accesses.h"

namespace app {

/// Draws the panel and changes state.vram and what is selected. `view`: of the frame, or nullptr. True: VRAM
/// is to be saved as it is shown.
bool draw_vram_panel(WindowState& state, const debug::FrameView* view,
                     std::span<const debug::Access> accesses, const Docked& docked, float scale);

/// Reads VRAM as the command does: its page is shown, in its format and with its palette.
void show_page_of(VramState& vram, const gpu::Primitive& primitive);

}  // namespace app
