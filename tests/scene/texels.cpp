// A picture on a wall shows each of its columns where it belongs, and nothing else.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace {

constexpr int width = 300, left = 10;  // of the wall on the screen, pixels

/// A wall 300 x 30 pixels large that shows a picture of `columns` columns, each in a colour of its own,
/// `times` times side by side.
scene::Scene wall(int columns, bool repeats, float times = 1) {
  scene::Scene s;
  scene::World& w = s.world;
  w.units_per_world = 100;
  scene::Texture picture{"columns", columns, 1, {}, scene::TexelFormat::clut8, repeats};
  for (int i = 0; i < columns; ++i) {
    // 31 is no column's red: the background.
    picture.pixels.push_back(
        {static_cast<std::uint8_t>(i % 16 * 8), static_cast<std::uint8_t>(i / 16 * 8), 128, 255});
  }
  w.textures.push_back(picture);
  scene::Material material;
  material.texture = 0;
  material.raw_texture = true;
  material.double_sided = true;
  w.materials = {material};
  w.background = {255, 0, 0};
  // H = 120 / tan: a distance of H units per pixel makes a unit a pixel.
  w.camera.tan_half_fov = 0.5F;
  const float scale = 0.01F, distance = 240 * scale;
  scene::Mesh mesh;
  const auto x0 = static_cast<float>(left - 160) * scale, x1 = static_cast<float>(left + width - 160) * scale;
  mesh.positions = {
      {x0, 0.15F, -distance}, {x0, -0.15F, -distance}, {x1, -0.15F, -distance}, {x1, 0.15F, -distance}};
  scene::Face face;
  face.vertex = {0, 1, 2, 3};
  face.uv = {glm::vec2{0, 0}, {0, 1}, {times, 1}, {times, 0}};
  face.colour.fill({128, 128, 128});
  mesh.faces.push_back(face);
  w.meshes.push_back(mesh);
  w.instances.push_back({0, glm::mat4(1.0F)});
  return s;
}

/// The column of the picture that each pixel of the wall's middle row shows; -1: none.
std::vector<int> columns_shown(const scene::Scene& scene, bool exact) {
  scene::Knobs knobs;
  knobs.colour = exact ? scene::Colour::bits24 : scene::Colour::bits15;
  if (exact) knobs.texture = scene::TextureAddress::perspective;
  scene::FrameBuilder builder(scene, knobs);
  ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
  std::vector<int> shown;
  for (int x = left; x < left + width; ++x) {
    int red = 0, green = 0;
    if (exact) {
      const auto pixel = gpu.canvas()->layer(0)[static_cast<std::size_t>(120 * 320 + x)];
      red = static_cast<int>(pixel >> 3 & 31);
      green = static_cast<int>(pixel >> 11 & 31);
    } else {
      const auto pixel = gpu.vram().at(x, 120);
      red = pixel & 31;
      green = pixel >> 5 & 31;
    }
    shown.push_back(red == 31 ? -1 : green * 16 + red);
  }
  return shown;
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE(
      "with exact coordinates each pixel shows the column that it lies in, first and last ones included") {
    for (const int columns : {8, 32, 100, 255, 256}) {
      for (const bool repeats : {false, true}) {
        CAPTURE(columns);
        CAPTURE(repeats);
        const auto shown = columns_shown(wall(columns, repeats), true);
        for (int x = 0; x < width; ++x) {
          // A border between columns may lie on a sample point, give or take the 1/256 that coordinates have.
          const double at = static_cast<double>(x) * columns / width;
          CAPTURE(x);
          CHECK(shown[static_cast<std::size_t>(x)] >= static_cast<int>(std::floor(at - 1.0 / 128)));
          CHECK(shown[static_cast<std::size_t>(x)] <= static_cast<int>(std::floor(at + 1.0 / 128)));
        }
      }
    }
  }

  TEST_CASE("on the console's path no pixel shows the opposite edge, and columns are off by half a texel") {
    for (const int columns : {8, 32, 100, 255, 256}) {
      for (const bool repeats : {false, true}) {
        CAPTURE(columns);
        CAPTURE(repeats);
        const auto shown = columns_shown(wall(columns, repeats), false);
        CHECK(std::is_sorted(shown.begin(), shown.end()));
        CHECK(shown.front() == 0);
        CHECK(shown.back() >= columns - 2);
        for (int x = 0; x < width; ++x) {
          const double at = (x + 0.0) * columns / width - 0.5;
          CHECK(std::abs(shown[static_cast<std::size_t>(x)] - at) <= 1.01);
        }
      }
    }
    CHECK(columns_shown(wall(8, true), false).back() == 7);
    CHECK(columns_shown(wall(100, false), false).back() == 99);
  }

  TEST_CASE("a picture three times side by side goes on without a seam") {
    const auto shown = columns_shown(wall(8, true, 3), true);
    for (int x = 0; x < width; ++x) {
      const double at = x * 24.0 / width;
      if (at - std::floor(at) < 0.01) continue;  // a border
      CHECK(shown[static_cast<std::size_t>(x)] == static_cast<int>(at) % 8);
    }
  }
}
