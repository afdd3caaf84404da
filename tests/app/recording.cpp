#include "app/commands/recording.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "demos/demos.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"
#include "scene/plan.h"

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
std::unique_ptr<gpu::Gpu> replayed(const dump::Dump& dump, dump::DumpFormat format,
                                   const scene::Knobs& knobs) {
  auto parsed = dump::parse_dump(dump::write_dump(dump, format));
  REQUIRE(parsed);
  auto gpu = std::make_unique<gpu::Gpu>();
  gpu->set_depth(scene::depth_options(knobs));
  dump::replay(*parsed, *gpu);
  return gpu;
}

struct Recorded {
  dump::Dump dump;
  app::SnapCost snapped;
};

/// What whoever reads the recording gets.
base::Result<Recorded> recorded(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs,
                                scene::Annotate annotate) {
  std::vector<std::byte> file;
  dump::DumpWriter writer(dump::DumpFormat::standard, [&](std::span<const std::byte> bytes) {
    file.insert(file.end(), bytes.begin(), bytes.end());
  });
  const auto snapped = app::record(scene, frames, knobs, annotate, writer);
  if (!snapped) return tl::make_unexpected(snapped.error());
  auto dump = dump::parse_dump(file);
  REQUIRE(dump);
  CHECK(writer.words() == dump->words.size());
  CHECK(writer.held_bytes() == static_cast<std::uint64_t>(dump->held_bytes()));
  return Recorded{std::move(*dump), *snapped};
}

// Two flat quads that pierce each other.
scene::Scene flat_crossing() {
  scene::Scene scene;
  scene.name = "flat crossing";
  auto& world = scene.world;
  world.materials[0].double_sided = true;
  world.camera.position = {0, 0, 4};
  scene::Mesh mesh;
  mesh.positions = {{-1.3F, -1, -1}, {1.2F, -1, 1},  {1.2F, 1, 0.7F}, {-1.3F, 1, -0.8F},
                    {-1, -1.2F, 1},  {1, -1, -1.1F}, {1, 1, -0.9F},   {-1, 0.9F, 1}};
  mesh.faces.resize(2);
  mesh.faces[0].vertex = {0, 1, 2, 3};
  mesh.faces[0].colour.fill({200, 40, 40});
  mesh.faces[1].vertex = {4, 5, 6, 7};
  mesh.faces[1].colour.fill({40, 40, 200});
  world.meshes.push_back(std::move(mesh));
  world.instances.resize(1);
  return scene;
}

// Frames 0 and 1 have a frame buffer each.
std::uint64_t pixels_that_differ(const gpu::Gpu& a, const gpu::Gpu& b) {
  std::uint64_t count = 0;
  const auto x = a.vram().pixels(), y = b.vram().pixels();
  for (std::size_t i = 0; i < x.size(); ++i) count += (x[i] & 0x7fff) != (y[i] & 0x7fff) ? 1 : 0;
  return count;
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
      const auto recording = recorded(scene, 3, knobs, scene::Annotate::when_needed);
      REQUIRE(recording);
      CHECK(same_vram(*replayed(recording->dump, dump::DumpFormat::standard, knobs), *live));
      CHECK(same_vram(*replayed(recording->dump, dump::DumpFormat::v1, knobs), *live));
    }
  }

  TEST_CASE("an annotated recording replays both ways, and without depths it draws the same picture") {
    const auto scene = demos::make(*demos::find("crossing"));
    const scene::Knobs plain;
    scene::Knobs depth;
    depth.visibility = scene::Visibility::zbuffer;
    const auto recording = recorded(scene, 2, plain, scene::Annotate::always);
    REQUIRE(recording);
    CHECK(same_vram(*replayed(recording->dump, dump::DumpFormat::standard, plain), *drawn(scene, 2, plain)));
    const auto deep = replayed(recording->dump, dump::DumpFormat::standard, depth);
    CHECK_FALSE(same_vram(*deep, *drawn(scene, 2, plain)));
    CHECK(same_vram(*deep, *drawn(scene, 2, depth)));
  }

  TEST_CASE("an interlaced recording replays to the live frames") {
    const auto scene = demos::make(*demos::find("glass"));
    scene::Knobs tall;
    tall.width = 640;
    tall.height = 480;
    const auto recording = recorded(scene, 3, tall, scene::Annotate::when_needed);
    REQUIRE(recording);
    CHECK(same_vram(*replayed(recording->dump, dump::DumpFormat::standard, tall), *drawn(scene, 3, tall)));
  }

  const scene::Knobs bsp{.visibility = scene::Visibility::bsp};

  TEST_CASE("a recording of split polygons replays, and says how many pixels that costs") {
    for (const auto* name : {"cyclic", "crossing", "corridor"}) {
      CAPTURE(name);
      const auto scene = demos::make(*demos::find(name));
      const auto recording = recorded(scene, 2, bsp, scene::Annotate::when_needed);
      REQUIRE(recording);
      const auto& cost = recording->snapped;
      CHECK(cost.pieces > 0);
      const auto live = drawn(scene, 2, bsp);
      const auto replay = replayed(recording->dump, dump::DumpFormat::standard, {});
      CHECK(cost.pixels == pixels_that_differ(*live, *replay));
      CHECK(cost.worst_pixels <= cost.pixels);
      CHECK(cost.pixels <= 2 * cost.worst_pixels);
      CHECK((cost.largest > 0) == (cost.pixels > 0));
    }
  }

  TEST_CASE("flat polygons that are split lose nothing by being recorded") {
    const auto scene = flat_crossing();
    const auto recording = recorded(scene, 1, bsp, scene::Annotate::when_needed);
    REQUIRE(recording);
    CHECK(recording->snapped.pieces > 2);
    CHECK(recording->snapped.pixels == 0);
    const auto replay = replayed(recording->dump, dump::DumpFormat::standard, {});
    CHECK(same_vram(*replay, *drawn(scene, 1, bsp)));
    CHECK_FALSE(same_vram(*replay, *drawn(scene, 1, {})));
  }

  TEST_CASE("a recording in the order of bsp that split nothing is exact") {
    for (const auto* name : {"crates", "glass"}) {
      CAPTURE(name);
      const auto scene = demos::make(*demos::find(name));
      const auto recording = recorded(scene, 2, bsp, scene::Annotate::when_needed);
      REQUIRE(recording);
      CHECK(recording->snapped == app::SnapCost{});
      CHECK(same_vram(*replayed(recording->dump, dump::DumpFormat::standard, {}), *drawn(scene, 2, bsp)));
    }
  }

  TEST_CASE(
      "bsp writes no depths into the list unless it is asked to, and with them a z-buffer can replay it") {
    const auto scene = demos::make(*demos::find("cyclic"));
    const auto plain = recorded(scene, 1, bsp, scene::Annotate::when_needed);
    const auto annotated = recorded(scene, 1, bsp, scene::Annotate::always);
    REQUIRE(plain);
    REQUIRE(annotated);
    scene::Knobs depth;
    depth.visibility = scene::Visibility::zbuffer;
    depth.depth = scene::DepthFormat::bits32;
    const auto end_of = [&](const dump::Dump& dump) {
      gpu::Gpu gpu;
      gpu.set_depth(scene::depth_options(depth));
      return dump::replay(dump, gpu).polygons_without_depth;
    };
    CHECK(end_of(plain->dump) > 0);
    CHECK(end_of(annotated->dump) == 0);
  }
}
