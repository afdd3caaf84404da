// How a Gpu hands primitives to the canvas it was given.

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"

namespace gpu {

/// Needs canvas_.
bool Gpu::draw_on_canvas() {
  return canvas_->draw(current_, vram_, clut_.entries().data(), current_draw() + 1);
}

/// Needs canvas_.
void Gpu::transfer_to_canvas() { canvas_->transfer(current_, vram_); }

}  // namespace gpu
