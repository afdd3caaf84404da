#pragma once
// A demo, drawn and judged frame by frame.

#include <doctest/doctest.h>

#include "demos/demos.h"
#include "gpu/gpu.h"
#include "inspect/report.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace tests {

class Watcher {
 public:
  Watcher(const demos::Entry& entry, const scene::Knobs& knobs)
      : scene_(demos::make(entry)), knobs_(knobs), builder_(scene_, knobs) {
    trace_.keep_history = true;
    builder_.upload(gpu_);
    gpu_.set_trace(&trace_);
  }

  inspect::Report frame(std::uint32_t number) {
    trace_.clear();
    auto stats = scene::render_frame(builder_, scene::frame_time(number), knobs_, ram_, gpu_);
    REQUIRE(stats.has_value());
    splits_ += stats->splits;
    const auto order = knobs_.visibility == scene::Visibility::bsp       ? inspect::Order::exact
                       : knobs_.visibility == scene::Visibility::zbuffer ? inspect::Order::depth
                                                                         : inspect::Order::list;
    return inspect::inspect(trace_, {.order = order, .scene = scene_.name, .frame = number});
  }
  [[nodiscard]] std::uint32_t splits() const { return splits_; }
  [[nodiscard]] const gpu::Trace& trace() const { return trace_; }

 private:
  scene::Scene scene_;
  scene::Knobs knobs_;
  ot::MainRam ram_{ot::RamSize::mib8};
  scene::FrameBuilder builder_;
  gpu::Gpu gpu_;
  gpu::Trace trace_;
  std::uint32_t splits_ = 0;
};

}  // namespace tests
