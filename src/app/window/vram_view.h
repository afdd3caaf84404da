#pragma once
// VRAM, live: the whole 1024 x 512, with what is shown and what is drawn to outlined.

#include "app/window/layout.h"
#include "gpu/gpu.h"

namespace app {

/// Where VRAM is drawn: as large as fits, whole numbers if there is room for them.
Rect place_vram(Rect area);

/// Outlines of the display area and the drawing area, and a magnifier with coordinates under the mouse.
void draw_vram_marks(const gpu::Gpu& gpu, Rect place, float scale);

}  // namespace app
