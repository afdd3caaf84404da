#pragma once
// The marks of what is selected, on the picture and on VRAM.

#include "app/window/layout.h"
#include "debug/frame_view.h"

namespace app {

/// Outlines and fills the row's shapes. `pulse`, 0..1: how strongly they are filled. Nothing is drawn outside
/// `clip`.
void draw_selection(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping,
                    Rect clip, double pulse);
/// The pixel whose history is pinned.
void draw_pin(std::uint32_t pixel, const VramMapping& mapping, Rect clip);

/// The page and the palette that the row reads from, outlined on VRAM.
void draw_sources(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping, Rect clip);

}  // namespace app
