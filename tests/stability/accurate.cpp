// The accurate settings: floating point from the scene to the sample, so that a frame is not one hash
// everywhere. How far it may differ is stated, and held by constants that every build must meet.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "demos/demos.h"
#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/frame.h"
#include "scene/pipeline.h"
#include "stability/measure.h"

using stability::Measure;

namespace {

constexpr std::size_t across = 4, down = 2;
using Means = std::array<double, across * down>;  // of red + green + blue, 0..765, in blocks of the picture

scene::Knobs most_accurate() {
  scene::Knobs knobs;
  knobs.visibility = scene::Visibility::zbuffer;
  knobs.depth = scene::DepthFormat::float32;
  knobs.transform = scene::Transform::float64;
  knobs.position = scene::Position::fine;
  knobs.texture = scene::TextureAddress::perspective;
  knobs.filter = scene::Filter::mipmap_linear;
  knobs.colour = scene::Colour::bits24;
  knobs.antialias = {scene::AntialiasKind::msaa, 4};
  knobs.resolution = 2;
  return knobs;
}

Means means_of(const gpu::canvas::Canvas& canvas) {
  Means sum{};
  const auto samples = canvas.samples();
  const auto pixels = canvas.layer(0);
  const auto width = static_cast<std::size_t>(canvas.width()),
             height = static_cast<std::size_t>(canvas.height());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t x = i / samples % width, y = i / samples / width;
    const auto c = pixels[i];
    sum[y * down / height * across + x * across / width] += (c & 255) + (c >> 8 & 255) + (c >> 16 & 255);
  }
  for (auto& value : sum) value /= static_cast<double>(pixels.size() / sum.size());
  return sum;
}

std::string text(const Means& means) {
  std::string out;
  for (const double mean : means) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%s%.3f", out.empty() ? "" : ", ", mean);
    out += number.data();
  }
  return out;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Frame 0 with the most accurate settings is the same picture in every build, to a tolerance") {
    // Compilers and mathematical libraries may round a sine or a square root their own way, and a sample on
    // an edge may fall to either side. Who changes a scene or a rule on purpose puts the printed values here.
    struct Row {
      std::string_view demo;
      Means expected;
    };
    constexpr std::array<Row, 5> rows{{
        {"crates", {145.582, 170.876, 175.582, 175.767, 137.003, 171.123, 189.258, 144.863}},
        {"cyclic", {108.000, 193.574, 168.007, 108.000, 127.747, 215.208, 192.464, 130.066}},
        {"crossing", {172.931, 250.198, 241.243, 166.172, 168.702, 252.541, 249.151, 153.533}},
        {"corridor", {308.500, 131.911, 116.615, 274.677, 246.517, 254.387, 257.296, 217.167}},
        {"glass", {238.367, 250.192, 295.973, 237.487, 211.189, 216.358, 254.181, 211.195}},
    }};
    Measure error{
        "8. Order",
        "frame 0 of the same five with float64 transform, 1/256 pixel, perspective, mip maps, 24-bit "
        "colour, float depth, msaa-4, x2: mean of each eighth of the picture",
        "an accurate picture that depends on the compiler",
        "within 1/20 of a level of 255, over the three channels",
        "levels",
        0.05};
    const auto knobs = most_accurate();
    for (const auto& row : rows) {
      scene::FrameBuilder builder(demos::make(*demos::find(row.demo)), knobs);
      ot::MainRam ram(ot::RamSize::mib8);
      gpu::Gpu gpu;
      builder.upload(gpu);
      REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
      REQUIRE(gpu.canvas() != nullptr);
      const auto seen = means_of(*gpu.canvas());
      double worst = 0;
      for (std::size_t i = 0; i < seen.size(); ++i)
        worst = std::max(worst, std::abs(seen[i] - row.expected[i]));
      CAPTURE(std::string(row.demo));
      CHECK_MESSAGE(worst <= 0.05, text(seen));
      // The page is the same in every build: what is below the tolerance counts as none.
      error.see(worst <= 0.05 ? 0 : worst, gpu.canvas()->layer(0).size());
    }
  }

  TEST_CASE("Every demo can be drawn at any time, however far") {
    Measure failed{
        "11. Cameras and scenes",
        "every demo at 17 times from -1e18 to 1e300 seconds, infinity and NaN, OT and accurate settings",
        "a conversion that overflows, a camera of NaN, a crash",
        "a frame",
        "frames",
        0};
    for (const auto& demo : demos::all()) {
      for (const auto& knobs : {scene::Knobs{}, most_accurate()}) {
        scene::FrameBuilder builder(demos::make(demo), knobs);
        ot::MainRam ram(ot::RamSize::mib8);
        gpu::Gpu gpu;
        builder.upload(gpu);
        for (const double seconds :
             {-1e18, -1.0, 0.0, 1e-310, 1.0, 3600.0, 1e6, 16777217.0, 2147483648.0, 1e10, 9007199254740993.0,
              9.3e18, 1.9e19, 1e30, 1e300, HUGE_VAL, std::nan("")}) {
          CAPTURE(std::string(demo.name));
          CAPTURE(seconds);
          failed.see(scene::render_frame(builder, seconds, knobs, ram, gpu) ? 0 : 1);
        }
      }
    }
  }
}
