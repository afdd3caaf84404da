// How a Gpu hands primitives to its canvas.

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"

namespace gpu {

void Gpu::set_canvas(const std::optional<canvas::Options>& options) {
  if (!options) {
    canvas_ = nullptr;
  } else if (canvas_ == nullptr || canvas_->options() != *options) {
    canvas_ = std::make_unique<canvas::Canvas>(*options);
  }
}

/// Needs canvas_.
bool Gpu::draw_on_canvas() {
  canvas_->watch(trace_);
  canvas_->set_limits(limits_);
  return canvas_->draw(current_, vram_, clut_.entries(), current_draw() + 1);
}

/// Needs canvas_.
void Gpu::transfer_to_canvas() { canvas_->transfer(current_, vram_); }

}  // namespace gpu
