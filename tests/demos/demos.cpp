#include "demos/demos.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace {

struct Picture {
  std::vector<std::uint16_t> pixels;
  scene::FrameStats stats;
};

class Show {
 public:
  explicit Show(const char* name, const scene::Knobs& knobs = {})
      : scene_(demos::make(*demos::find(name))), builder_(scene_, knobs), ram_(ot::RamSize::mib8) {
    builder_.upload(gpu_);
  }

  Picture frame(std::uint32_t number, const scene::Knobs& knobs) {
    const auto stats = scene::render_frame(builder_, scene::frame_time(number), knobs, ram_, gpu_);
    REQUIRE(stats);
    Picture p;
    p.stats = *stats;
    const auto& display = gpu_.display();
    for (int y = 0; y < knobs.height; ++y)
      for (int x = 0; x < knobs.width; ++x)
        p.pixels.push_back(gpu_.vram().at(display.start_x() + x, display.start_y() + y));
    return p;
  }

 private:
  scene::Scene scene_;
  scene::FrameBuilder builder_;
  gpu::Gpu gpu_;
  ot::MainRam ram_;
};

int different(const Picture& a, const Picture& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
  return count;
}

// Pixels that differ between ordering table and z-buffer, frame by frame.
std::vector<int> ordering_errors(const char* name, int buckets, const std::vector<std::uint32_t>& frames) {
  scene::Knobs table;
  table.buckets = buckets;
  scene::Knobs depth = table;
  depth.visibility = scene::Visibility::zbuffer;
  Show show(name);
  std::vector<int> out;
  for (const auto n : frames) {
    const auto painted = show.frame(n, table);
    out.push_back(different(painted, show.frame(n, depth)));
  }
  return out;
}

}  // namespace

TEST_SUITE("demos") {
  TEST_CASE("every demo has a name of its own, a title and a sentence") {
    std::set<std::string_view> names;
    for (const auto& entry : demos::all()) {
      CHECK(names.insert(entry.name).second);
      CHECK_FALSE(entry.title.empty());
      CHECK_FALSE(entry.shows.empty());
      CHECK(demos::find(entry.name) == &entry);
      CHECK(demos::make(entry).name == entry.name);
    }
    CHECK(demos::find("no such demo") == nullptr);
  }

  TEST_CASE("every demo draws something in every display mode, fits into RAM and leaves out nothing unseen") {
    for (const auto& entry : demos::all()) {
      const std::string name(entry.name);
      CAPTURE(name);
      for (const int width : {256, 320, 368, 512, 640}) {
        for (const int height : {240, 480}) {
          CAPTURE(width);
          CAPTURE(height);
          scene::Knobs knobs;
          knobs.width = width;
          knobs.height = height;
          Show show(name.c_str(), knobs);
          const auto p = show.frame(100, knobs);
          CHECK(p.stats.lists == 1);
          CHECK(p.stats.dropped_by(scene::Drop::unrepresentable) == 0);
          CHECK(std::set(p.pixels.begin(), p.pixels.end()).size() > 20);
        }
      }
    }
  }

  TEST_CASE("no demo needs its textures shrunk") {
    for (const auto& entry : demos::all()) {
      const auto scene = demos::make(entry);
      const scene::FrameBuilder builder(scene, {});
      CHECK(builder.report().empty());
    }
  }

  TEST_CASE("frame N is the same whatever was drawn before it") {
    for (const auto& entry : demos::all()) {
      const std::string name(entry.name);
      CAPTURE(name);
      Show straight(name.c_str());
      Show jumping(name.c_str());
      jumping.frame(500, {});
      jumping.frame(3, {});
      CHECK(different(straight.frame(90, {}), jumping.frame(90, {})) == 0);
    }
  }

  TEST_CASE("crates: with 4096 buckets the ordering table shows what the z-buffer shows, pixel for pixel") {
    std::vector<std::uint32_t> frames;
    for (std::uint32_t n = 0; n < 600; n += 20) frames.push_back(n);
    for (const int pixels : ordering_errors("crates", 4096, frames)) CHECK(pixels == 0);
  }

  TEST_CASE("cyclic: no number of buckets paints the cycle right, the z-buffer does") {
    for (const int buckets : {64, 4096, 65536})
      for (const int pixels : ordering_errors("cyclic", buckets, {0, 60, 300})) CHECK(pixels > 100);
  }

  TEST_CASE("crossing: half of a wall is painted over that should be seen") {
    for (const int pixels : ordering_errors("crossing", 4096, {0, 60, 300})) CHECK(pixels > 1000);
  }

  TEST_CASE("corridor: long floor quads are painted over what stands on them; smaller pieces help") {
    scene::Knobs table;
    scene::Knobs depth;
    depth.visibility = scene::Visibility::zbuffer;
    const auto errors = [&](int subdivide) {
      table.subdivide.n = depth.subdivide.n = subdivide;
      Show show("corridor", table);
      int sum = 0;
      for (const std::uint32_t n : {0U, 120U, 240U, 360U, 480U}) {
        const auto painted = show.frame(n, table);
        sum += different(painted, show.frame(n, depth));
      }
      return sum;
    };
    const int whole = errors(1);
    const int pieces = errors(4);
    CHECK(whole > 1000);
    CHECK(pieces < whole);
  }

  TEST_CASE("glass: panes let through what is behind them, in all four modes") {
    Show show("glass");
    const auto with = show.frame(0, {});
    auto scene = demos::make(*demos::find("glass"));
    for (auto& material : scene.world.materials) material.blend = scene::Blend::opaque;
    scene::Knobs knobs;
    scene::FrameBuilder builder(scene, knobs);
    gpu::Gpu gpu;
    ot::MainRam ram(ot::RamSize::mib8);
    builder.upload(gpu);
    REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
    int changed = 0;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x)
        changed +=
            (gpu.vram().at(x, y) & 0x7fff) != (with.pixels[static_cast<std::size_t>(y * 320 + x)] & 0x7fff)
                ? 1
                : 0;
    CHECK(changed > 2000);
  }
}
