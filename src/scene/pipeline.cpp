#include "scene/pipeline.h"

#include <chrono>

#include "gpu/gpu.h"
#include "ot/walker.h"

namespace scene {
namespace {

std::optional<gpu::DepthOptions> depth_options(const Knobs& knobs) {
  if (knobs.visibility != Visibility::zbuffer) return std::nullopt;
  gpu::DepthOptions options;
  options.format = static_cast<gpu::DepthFormat>(knobs.depth);
  options.mapping = static_cast<gpu::DepthMapping>(knobs.depth_mapping);
  options.test = static_cast<gpu::DepthTest>(knobs.depth_test);
  options.reversed = knobs.depth_reversed;
  options.near_z = knobs.near_z;
  options.far_z = knobs.far_z;
  return options;
}

void use_depth(const Knobs& knobs, gpu::Gpu& gpu) {
  const auto wanted = depth_options(knobs);
  const auto* plane = gpu.depth_plane();
  const auto current = plane != nullptr ? std::optional(plane->options()) : std::nullopt;
  if (wanted != current) gpu.set_depth(wanted);
}

Result<void> draw_list(const Frame& frame, const ot::MainRam& ram, gpu::Gpu& gpu) {
  const auto result = ot::walk(
      ram, frame.head, [&](std::uint32_t, std::span<const std::uint32_t> payload) { gpu.gp0(payload); });
  if (!result)
    return fail("the list of frame " + std::to_string(frame.number) + ": " + result.message(), Exit::failed);
  return {};
}

}  // namespace

Result<void> draw_frame(FrameBuilder& builder, Frame& frame, const Knobs& knobs, ot::MainRam& ram,
                        gpu::Gpu& gpu) {
  using Clock = std::chrono::steady_clock;
  use_depth(knobs, gpu);
  Clock::duration drawing{};
  auto start = Clock::now();
  gpu.begin_frame();
  for (;;) {
    if (auto drawn = draw_list(frame, ram, gpu); !drawn) return drawn;
    drawing += Clock::now() - start;
    if (frame.nearer_lists == 0) break;
    if (auto next = builder.next(frame, ram); !next) return next;
    start = Clock::now();
  }
  start = Clock::now();
  const auto end = gpu.end_frame();
  gpu.gp1(FrameBuilder::show_gp1(frame));
  drawing += Clock::now() - start;
  frame.stats.raster_ms = std::chrono::duration<double, std::milli>(drawing).count();
  if (end.polygons_without_depth != 0) {
    return fail(std::to_string(end.polygons_without_depth) +
                    " polygons without depth, the first is drawing command " +
                    std::to_string(end.first_without_depth) + ": --bucket-depth draws them at their bucket's",
                Exit::failed);
  }
  return {};
}

Result<FrameStats> render_frame(FrameBuilder& builder, double seconds, const Knobs& knobs, ot::MainRam& ram,
                                gpu::Gpu& gpu) {
  if (builder.needs_upload(knobs)) {
    builder.prepare(knobs);
    builder.upload(gpu);
  }
  auto frame = builder.build(seconds, knobs, ram);
  if (!frame) return tl::make_unexpected(frame.error());
  if (auto drawn = draw_frame(builder, *frame, knobs, ram, gpu); !drawn)
    return tl::make_unexpected(drawn.error());
  return frame->stats;
}

}  // namespace scene
