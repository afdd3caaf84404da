// The demos, judged: what each way of visibility gets right.

#include <doctest/doctest.h>

#include "demos/demos.h"
#include "gpu/gpu.h"
#include "inspect/report.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace {

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

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("bsp shows no wrong pixel on any demo, those made of cycles and crossings included") {
    for (const auto& entry : demos::all()) {
      CAPTURE(entry.name);
      Watcher watcher(entry, {.visibility = scene::Visibility::bsp});
      for (const std::uint32_t frame : {0U, 17U, 100U}) {
        const auto report = watcher.frame(frame);
        CHECK(report.wrong_pixels() == 0);
        CHECK(report.polygons_judged > 0);
        CHECK(report.polygons_without_depth == 0);
      }
      if (entry.name == "cyclic" || entry.name == "crossing") CHECK(watcher.splits() > 0);
    }
  }

  TEST_CASE("bsp draws as many samples of polygons as the ordering table does") {
    for (const auto& entry : demos::all()) {
      CAPTURE(entry.name);
      Watcher split(entry, {.visibility = scene::Visibility::bsp}), whole(entry, {});
      CHECK(split.frame(10).fragments == whole.frame(10).fragments);
    }
  }

  TEST_CASE("every wrong pixel of ot and sorted has a cause, and knows its keys") {
    for (const auto& entry : demos::all()) {
      CAPTURE(entry.name);
      for (const auto visibility : {scene::Visibility::ot, scene::Visibility::sorted}) {
        const auto report = Watcher(entry, {.visibility = visibility}).frame(5);
        std::uint64_t sum = 0;
        for (const auto count : report.causes) sum += count;
        CHECK(sum == report.wrong_pixels());
        CHECK(report.buckets.known);
        CHECK(report.count(inspect::Cause::list_order) == 0);
      }
    }
  }
}
