// What a z-buffered frame adds: the depth plane, and a second pass for what lets light through.

#include "gpu/gpu.h"

namespace gpu {

void Gpu::set_depth(const std::optional<DepthOptions>& options) {
  depth_ = options ? std::make_unique<DepthPlane>(*options) : nullptr;
}

void Gpu::begin_frame() {
  next_command_ = 0;
  frame_ = {};
  if (depth_) depth_->clear();
}

FrameEnd Gpu::end_frame() { return frame_; }

std::uint64_t Gpu::queue_bytes() const { return 0; }

}  // namespace gpu
