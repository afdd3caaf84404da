#include "scene/accurate.h"

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"

namespace scene {

namespace canvas = gpu::canvas;

base::Result<void> check_size(const canvas::Options& options) {
  const auto bytes = canvas::Canvas::frame_bytes(options);
  if (bytes <= canvas_limit_bytes) return {};
  return base::fail("--resolution and --antialias ask for a frame of " + std::to_string(bytes) +
                    " bytes; expected at most " + std::to_string(canvas_limit_bytes));
}

base::Result<void> use_targets(const Plan& plan, gpu::Gpu& gpu) {
  auto wanted = plan.canvas;
  if (wanted && gpu.canvas() != nullptr) wanted->trace = gpu.canvas()->options().trace;
  if (wanted) {
    if (auto checked = check_size(*wanted); !checked) return checked;
  }
  if (wanted && plan.sorting == Sorting::split &&
      (wanted->layers.size() > 1 || !wanted->samples.empty() || wanted->temporal || wanted->scale > 4)) {
    return base::fail(
        "--visibility bsp splits polygons for one sample at the centre of each pixel: expected --antialias "
        "none "
        "or fxaa, and --resolution 1, 2 or 4");
  }
  const auto* plane = gpu.depth_plane();
  if (plan.depth != (plane != nullptr ? std::optional(plane->options()) : std::nullopt))
    gpu.set_depth(plan.depth);
  gpu.set_canvas(wanted);
  return {};
}

}  // namespace scene
