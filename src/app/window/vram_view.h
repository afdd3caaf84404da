#pragma once
// VRAM in place of the picture: any part of the 1024 x 512, as large as wanted, with what is shown, drawn to,
// read and written outlined.

#include <cstdint>
#include <span>

#include "app/window/layout.h"
#include "app/window/window_state.h"
#include "gpu/gpu.h"

namespace app {

/// Where VRAM is drawn: as large as fits, whole numbers if there is room for them.
Rect place_vram(Rect area);

/// What of it is there with this zoom.
VramMapping vram_mapping(const VramState& state, Rect place);
/// Nearer or farther, so that what is at `across`, `down` (0..1 of the place) stays there.
void zoom_vram(VramState& state, double steps, double across, double down);
/// Moves what is shown by so much of the place, within VRAM.
void pan_vram(VramState& state, double across, double down);
/// Shows a rectangle of VRAM as large as fits.
void show_rectangle(VramState& state, int x, int y, int width, int height);

/// Outlines of the display area and the drawing area, the grid of texture pages, and a magnifier with
/// coordinates under the mouse. `vram`: 1024 x 512.
void draw_vram_marks(const gpu::Gpu& gpu, std::span<const std::uint16_t> vram, const VramMapping& mapping,
                     bool grid, float scale);

}  // namespace app
