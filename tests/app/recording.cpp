#include "app/recording.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "demos/demos.h"
#include "ot/main_ram.h"
#include "scene/accurate.h"
#include "scene/pipeline.h"

namespace {

/// VRAM after drawing frames 0 .. frames-1 of a scene.
std::unique_ptr<gpu::Gpu> drawn(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs) {
  auto gpu = std::make_unique<gpu::Gpu>();
  ot::MainRam ram(ot::RamSize::mib8);
  scene::FrameBuilder builder(scene, knobs);
  builder.upload(*gpu);
  for (std::uint32_t n = 0; n < frames; ++n) {
    REQUIRE(scene::render_frame(builder, scene::frame_time(n), knobs, ram, *gpu));
  }
  return gpu;
}

/// VRAM after replaying a dump, on its way through a file of that format.
std::unique_ptr<gpu::Gpu> replayed(const gpu::Dump& dump, gpu::DumpFormat format, const scene::Knobs& knobs) {
  auto parsed = gpu::parse_dump(gpu::write_dump(dump, format));
  REQUIRE(parsed);
  auto gpu = std::make_unique<gpu::Gpu>();
  gpu->set_depth(scene::depth_options(knobs));
  gpu::replay(*parsed, *gpu);
  return gpu;
}

bool same_vram(const gpu::Gpu& a, const gpu::Gpu& b) {
  return std::ranges::equal(a.vram().pixels(), b.vram().pixels());
}

}  // namespace

TEST_SUITE("app") {
  TEST_CASE("a recording of every demo replays to the VRAM of the live frames, in both formats") {
    for (const auto& demo : demos::all()) {
      CAPTURE(std::string(demo.name));
      const auto scene = demos::make(demo);
      const scene::Knobs knobs;
      const auto live = drawn(scene, 3, knobs);
      const auto dump = app::record(scene, 3, knobs, scene::Annotate::when_needed);
      REQUIRE(dump);
      CHECK(same_vram(*replayed(*dump, gpu::DumpFormat::standard, knobs), *live));
      CHECK(same_vram(*replayed(*dump, gpu::DumpFormat::v1, knobs), *live));
    }
  }

  TEST_CASE("an annotated recording replays both ways, and without depths it draws the same picture") {
    const auto scene = demos::make(*demos::find("crossing"));
    const scene::Knobs plain;
    scene::Knobs depth;
    depth.visibility = scene::Visibility::zbuffer;
    const auto dump = app::record(scene, 2, plain, scene::Annotate::always);
    REQUIRE(dump);
    CHECK(same_vram(*replayed(*dump, gpu::DumpFormat::standard, plain), *drawn(scene, 2, plain)));
    const auto deep = replayed(*dump, gpu::DumpFormat::standard, depth);
    CHECK_FALSE(same_vram(*deep, *drawn(scene, 2, plain)));
    CHECK(same_vram(*deep, *drawn(scene, 2, depth)));
  }

  TEST_CASE("an interlaced recording replays to the live frames") {
    const auto scene = demos::make(*demos::find("glass"));
    scene::Knobs tall;
    tall.width = 640;
    tall.height = 480;
    const auto dump = app::record(scene, 3, tall, scene::Annotate::when_needed);
    REQUIRE(dump);
    CHECK(same_vram(*replayed(*dump, gpu::DumpFormat::standard, tall), *drawn(scene, 3, tall)));
  }
}
