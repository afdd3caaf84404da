// How a Gpu hands primitives to its canvas.

#include "gpu/canvas/canvas.h"
#include "gpu/depth_queue.h"
#include "gpu/gpu.h"
#include "gpu/raster.h"

namespace gpu {

void Gpu::set_canvas(const std::optional<canvas::Options>& options) {
  const bool stays = options ? canvas_ != nullptr && canvas_->options() == *options : canvas_ == nullptr;
  if (stays) return;
  canvas_ = options ? std::make_unique<canvas::Canvas>(*options) : nullptr;
  queue_ = nullptr;
}

/// Needs canvas_.
bool Gpu::draw_on_canvas(const Surface& surface, const Primitive& primitive, Pass pass) {
  canvas_->watch(trace_);
  canvas_->set_limits(limits_);
  return canvas_->draw(primitive, pass, vram_, surface.clut, surface.draw + 1);
}

/// Needs canvas_.
void Gpu::transfer_to_canvas() { canvas_->transfer(current_, vram_); }

}  // namespace gpu
