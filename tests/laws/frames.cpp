// Frames of scenes and what is said about them.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "demos/demos.h"
#include "generate.h"
#include "gpu/gpu.h"
#include "inspect/json.h"
#include "inspect/report.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace {

using laws::Words;

/// One value of each knob that the scene can be drawn with.
struct Setting {
  std::string name, value;
};
const std::vector<std::vector<Setting>>& settings() {
  static const std::vector<std::vector<Setting>> all{
      {{"visibility", "ot"}, {"visibility", "sorted"}, {"visibility", "zbuffer"}},
      {{"buckets", "16"}, {"buckets", "512"}},
      {{"key", "average"}, {"key", "nearest"}, {"key", "farthest"}},
      {{"bias", "-2"}, {"bias", "3"}},
      {{"bucket-order", "lifo"}, {"bucket-order", "fifo"}},
      {{"depth", "16"}, {"depth", "24"}, {"depth", "float"}},
      {{"transform", "gte"}, {"transform", "double"}},
      {{"position", "integer"}, {"position", "16"}},
      {{"texture", "affine"}, {"texture", "perspective"}},
      {{"filter", "nearest"}, {"filter", "bilinear"}},
      {{"colour", "15"}, {"colour", "15-dither"}, {"colour", "24"}},
      {{"size", "256x240"}, {"size", "320x240"}}};
  return all;
}

std::vector<std::uint16_t> drawn(const scene::Scene& scene, const scene::Knobs& knobs) {
  auto gpu = std::make_unique<gpu::Gpu>();
  ot::MainRam ram(ot::RamSize::mib8);
  scene::FrameBuilder builder(scene, knobs);
  builder.upload(*gpu);
  RC_ASSERT(scene::render_frame(builder, 0.5, knobs, ram, *gpu).has_value());
  const auto pixels = gpu->vram().pixels();
  return {pixels.begin(), pixels.end()};
}

}  // namespace

TEST_SUITE("laws") {
  TEST_CASE("Knobs set in any order are the same knobs and give one frame") {
    const auto scene = demos::make(*demos::find("crates"));
    CHECK(rc::check([&scene] {
      std::vector<Setting> chosen;
      for (const auto& values : settings()) {
        if (*rc::gen::arbitrary<bool>()) chosen.push_back(*rc::gen::elementOf(values));
      }
      auto order = chosen;
      for (std::size_t n = order.size(); n > 1; --n)
        std::swap(order[n - 1], order[*rc::gen::inRange<std::size_t>(0, n)]);
      scene::Knobs one, other;
      for (const auto& s : chosen) RC_ASSERT(scene::set_knob(one, s.name, s.value).has_value());
      for (const auto& s : order) RC_ASSERT(scene::set_knob(other, s.name, s.value).has_value());
      RC_ASSERT(one == other);
      if (!scene::check_knobs(one)) return;
      RC_ASSERT(drawn(scene, one) == drawn(scene, other));
    }));
  }

  TEST_CASE("What a report says of any frame is JSON, one frame or many, whatever the scene is called") {
    CHECK(rc::check([](const std::string& name) {
      inspect::FramesJson frames;
      const auto count = *rc::gen::inRange(1, 4);
      for (int n = 0; n < count; ++n) {
        gpu::Gpu gpu;
        gpu::Trace trace;
        trace.keep_history = true;
        gpu.set_trace(&trace);
        gpu.gp0(*laws::stream());
        const auto report = inspect::inspect(trace, {.scene = name, .frame = static_cast<std::uint32_t>(n)});
        const auto json = nlohmann::json::parse(inspect::to_json(report), nullptr, false);
        RC_ASSERT(!json.is_discarded());
        RC_ASSERT(json["frame"] == n);
        RC_ASSERT(json["wrong_pixels"] == report.wrong_pixels());
        RC_ASSERT(frames.add(report));
      }
      char* text = nullptr;
      std::size_t size = 0;
      std::FILE* file = open_memstream(&text, &size);
      frames.write(file);
      std::fclose(file);
      const std::unique_ptr<char, decltype(&std::free)> owner(text, &std::free);
      const auto json = nlohmann::json::parse(text, text + size, nullptr, false);
      RC_ASSERT(!json.is_discarded());
      if (count > 1) RC_ASSERT(json["frames"].size() == static_cast<std::size_t>(count));
    }));
  }
}
