#include "scene/pipeline.h"

#include <chrono>
#include <optional>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/depth.h"
#include "gpu/gpu.h"
#include "ot/walker.h"
#include "scene/accurate.h"

namespace scene {
namespace {

// Tells the GPU and whoever watches it what the words of a node do not say.
class Marker {
 public:
  Marker(const FrameBuilder& builder, const Frame& frame, gpu::Gpu& gpu)
      : gpu_(gpu),
        table_address_(frame.table_address),
        buckets_(frame.buckets),
        by_bucket_(builder.plan().default_depth_of_bucket) {
    const Sorting sorting = builder.plan().sorting;
    if (sorting == Sorting::split || (sorting == Sorting::keys && gpu.trace() != nullptr))
      marks_ = builder.marks();
  }
  ~Marker() {
    gpu_.set_limits(std::nullopt);
    set_bucket(gpu::no_bucket);
    gpu_.set_default_depth(std::nullopt);
  }
  Marker(const Marker&) = delete;
  Marker& operator=(const Marker&) = delete;

  void at(std::uint32_t tag) {
    const std::uint32_t bucket = (tag - table_address_) / 4;
    if (tag >= table_address_ && bucket < buckets_) {
      set_bucket(bucket);
      if (by_bucket_) gpu_.set_default_depth(gpu::depth_of_bucket(bucket, buckets_));
    }
    if (next_ == marks_.size() || marks_[next_].tag != tag) return;
    const NodeMark& mark = marks_[next_++];
    gpu_.set_limits(mark.limits);
    set_bucket(mark.key == none ? gpu::no_bucket : mark.key);
  }

 private:
  void set_bucket(std::uint32_t bucket) {
    if (gpu_.trace() != nullptr) gpu_.trace()->bucket = bucket;
  }

  gpu::Gpu& gpu_;
  std::uint32_t table_address_, buckets_;
  bool by_bucket_;
  std::vector<NodeMark> marks_;
  std::size_t next_ = 0;
};

base::Result<void> draw_list(const FrameBuilder& builder, const Frame& frame, const ot::MainRam& ram,
                             gpu::Gpu& gpu) {
  Marker marker(builder, frame, gpu);
  const auto result =
      ot::walk(ram, frame.head, [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
        marker.at(tag);
        gpu.gp0(payload);
      });
  if (!result)
    return base::fail("the list of frame " + std::to_string(frame.number) + ": " + result.message(),
                      base::Exit::failed);
  return {};
}

}  // namespace

base::Result<void> draw_frame(FrameBuilder& builder, Frame& frame, ot::MainRam& ram, gpu::Gpu& gpu) {
  using Clock = std::chrono::steady_clock;
  if (auto used = use_targets(builder.plan(), gpu); !used) return used;
  Clock::duration drawing{};
  auto start = Clock::now();
  gpu.begin_frame(0, frame.buffer_y);
  for (;;) {
    if (auto drawn = draw_list(builder, frame, ram, gpu); !drawn) return drawn;
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
  if (end.polygons_without_depth != 0 && builder.plan().refuses_without_depth) {
    return base::fail(std::to_string(end.polygons_without_depth) +
                          " polygons without depth, the first is command " + std::to_string(frame.number) +
                          ":" + std::to_string(end.first_without_depth + 1) +
                          ": --without-depth list-order or bucket draws them",
                      base::Exit::failed);
  }
  return {};
}

base::Result<FrameStats> render_frame(FrameBuilder& builder, double seconds, const Knobs& knobs,
                                      ot::MainRam& ram, gpu::Gpu& gpu) {
  if (builder.needs_upload(knobs)) {
    builder.prepare(knobs);
    builder.upload(gpu);
  }
  // Whoever watches wants to know the depths, whether a knob needs them or not.
  auto frame =
      builder.build(seconds, knobs, ram, gpu.trace() != nullptr ? Annotate::always : Annotate::when_needed);
  if (!frame) return tl::make_unexpected(frame.error());
  if (auto drawn = draw_frame(builder, *frame, ram, gpu); !drawn) return tl::make_unexpected(drawn.error());
  return frame->stats;
}

}  // namespace scene
