// Truth of frames drawn on the accurate canvas: sub-pixel corners, perspective texture, 24 bits.

#include "gpu/canvas/canvas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "../oracle/ray_caster.h"
#include "demos/demos.h"
#include "inspect/maps.h"
#include "random_triangles.h"
#include "stage.h"
#include "watcher.h"

namespace {

// A canvas as large as VRAM, with whatever else is asked for.
gpu::canvas::Options fine(gpu::canvas::Options options = {}) {
  options.width = 1024;
  options.height = 512;
  options.fraction_bits = 8;
  return options;
}

struct CanvasStage : tests::Stage {
  explicit CanvasStage(const gpu::canvas::Options& options) {
    gpu().set_canvas(options);
    gpu().begin_frame();
  }
};

}  // namespace

TEST_SUITE("inspect") {
  // The corners (0.5, 0), (8.5, 0), (0.5, 8): row 0 begins at the first pixel right of 0.5 and ends
  // before 8.5.
  TEST_CASE("a canvas frame is watched at the sub-pixel corners it is drawn with") {
    CanvasStage stage(fine());
    stage.raw_polygon({{0, 0, 409600, 128, 0}, {8, 0, 409600, 128, 0}, {0, 8, 409600, 128, 0}},
                      {.bucket = 1});
    const auto report = stage.report();
    // Row y covers x from 1 to the last below 8.5 - y: 8 - y pixels, of which the drawing area keeps x <= 7.
    CHECK(report.fragments == 7 + 7 + 6 + 5 + 4 + 3 + 2 + 1);
    CHECK(report.pixels_drawn == report.fragments);
    CHECK(report.wrong_pixels() == 0);
  }

  TEST_CASE(
      "with sub-pixel corners the wrong pixels are those an independent ray caster finds: 1,024 random "
      "scenes") {
    tests::RandomTriangles random(33);
    constexpr int size = 8;
    std::uint64_t wrong = 0;
    for (int frame = 0; frame < 4; ++frame) {
      CanvasStage stage(fine());
      std::vector<std::uint32_t> expected;
      for (int scene = 0; scene < 256; ++scene) {
        const int left = scene % 16 * size, top = scene / 16 * size;
        stage.move_to(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top));
        std::vector<std::array<oracle::Corner, 3>> surfaces;
        const auto kind = tests::all_kinds[static_cast<std::size_t>(scene) % tests::all_kinds.size()];
        for (const auto& t : random.scene(kind, 2 + scene % 5, size)) {
          std::array<oracle::Corner, 3> c;
          std::array<tests::Corner, 3> drawn;
          for (std::size_t i = 0; i < 3; ++i) {
            c[i] = {t[i].x, t[i].y, std::max(t[i].z, 1U)};
            drawn[i] = {t[i].x >> 8, t[i].y >> 8, c[i].z, static_cast<std::uint8_t>(t[i].x & 255),
                        static_cast<std::uint8_t>(t[i].y & 255)};
          }
          surfaces.push_back(c);
          stage.raw_polygon({drawn[0], drawn[1], drawn[2]}, {.bucket = 1});
        }
        for (int y = 0; y < size; ++y) {
          for (int x = 0; x < size; ++x) {
            std::optional<oracle::Rational> last, nearest;
            for (const auto& surface : surfaces) {
              const auto z = oracle::cast_ray(surface, x, y);
              if (!z) continue;
              last = *z;
              if (!nearest || *z < *nearest) nearest = *z;
            }
            if (last != nearest) expected.push_back(static_cast<std::uint32_t>((top + y) * 1024 + left + x));
          }
        }
      }
      std::vector<std::uint32_t> found;
      for (const auto& pixel : stage.report().wrong) found.push_back(pixel.pixel);
      std::sort(expected.begin(), expected.end());
      REQUIRE(found == expected);
      wrong += found.size();
    }
    CHECK(wrong > 1000);
  }

  TEST_CASE("what loses the depth test on a canvas is told, and a hole in a texture is not") {
    gpu::canvas::Options options = fine();
    options.depth = gpu::DepthOptions{};
    CanvasStage stage(options);
    stage.gpu().vram().at(641, 0) = 0x7fff;
    stage.quad(0, 0, 4, 4, 100);
    stage.quad(0, 0, 4, 4, 200);
    stage.quad(0, 0, 4, 2, 300, {.texel = ot::Uv{0, 0}});  // texel 0000h
    stage.quad(0, 0, 4, 2, 300, {.texel = ot::Uv{1, 0}});
    stage.gpu().end_frame();
    const auto& history = stage.trace().history;
    CHECK(history.size() == 16 + 16 + 8);
    CHECK(std::count_if(history.begin(), history.end(), [](const auto& e) { return e.rejected; }) == 16 + 8);
    CHECK(stage.trace().last_writer[0] == 1);
  }

  TEST_CASE("nobody watches a canvas of more samples than VRAM has pixels") {
    for (const bool fine_pixels : {false, true}) {
      gpu::canvas::Options options = fine();
      fine_pixels ? options.scale = 2 : (options.layers.push_back({1, 0}), 2);
      CHECK_FALSE(options.can_be_watched());
      CanvasStage stage(options);
      stage.quad(0, 0, 4, 4, 100);
      CHECK(stage.trace().history.empty());
    }
  }

  TEST_CASE(
      "a 32-bit z-buffer shows no wrong pixel on any demo with every accurate knob that keeps the pixels") {
    for (const auto& entry : demos::all()) {
      CAPTURE(entry.name);
      scene::Knobs knobs{.visibility = scene::Visibility::zbuffer, .depth = scene::DepthFormat::bits32};
      knobs.position = scene::Position::fine;
      knobs.texture = scene::TextureAddress::perspective;
      knobs.filter = scene::Filter::bilinear;
      knobs.colour = scene::Colour::bits24;
      const auto report = tests::Watcher(entry, knobs).frame(33);
      CHECK(report.wrong_pixels() == 0);
      CHECK(report.pixels_drawn > 1000);
      CHECK(report.polygons_judged > 0);
    }
  }

  TEST_CASE("finer positions leave the table's wrong pixels wrong, each with its cause") {
    const auto& entry = *demos::find("cyclic");
    scene::Knobs knobs;
    knobs.position = scene::Position::fine;
    const auto report = tests::Watcher(entry, knobs).frame(0);
    CHECK(report.wrong_pixels() > 0);
    CHECK(report.count(inspect::Cause::cyclic_overlap) == report.wrong_pixels());
  }
}
