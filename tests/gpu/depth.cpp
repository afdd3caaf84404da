// The z-buffer: formats, the annotation words that feed it, two passes.

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <memory>
#include <random>
#include <vector>

#include "gpu/gpu.h"
#include "random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;
using gpu::DepthFormat, gpu::DepthMapping, gpu::DepthOptions, gpu::DepthTest;

constexpr std::uint32_t red = 0x0000ff, green = 0x00ff00;

std::uint32_t at(int x, int y) { return static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 16; }

Words depths(std::initializer_list<double> zs) {
  Words words;
  std::array<std::uint32_t, 4> fixed{};
  std::size_t n = 0;
  for (const double z : zs) fixed[n++] = static_cast<std::uint32_t>(z * 4096);
  words.push_back(0xe7000000 | fixed[0] >> 24 | fixed[1] >> 24 << 8 | fixed[2] >> 24 << 16);
  if (n == 4) words.push_back(0xe7000000 | fixed[3] >> 24);
  for (std::uint32_t v = 0; v < n; ++v) words.push_back((0xe8 + v) << 24 | (fixed[v] & 0xffffff));
  return words;
}

struct Bench {
  std::unique_ptr<gpu::Gpu> gpu = std::make_unique<gpu::Gpu>();
  explicit Bench(const std::optional<DepthOptions>& options) {
    gpu->gp0(Words{0xe3000000, 0xe4000000 | 1023 | 511 << 10});
    gpu->set_depth(options);
    gpu->begin_frame();
  }
  /// A square of 8 x 8 with the same depth in its corners, or in each two.
  void square(std::uint32_t colour, double left_z, double right_z, std::uint32_t opcode = 0x28) const {
    gpu->gp0(depths({left_z, right_z, left_z, right_z}));
    gpu->gp0(Words{opcode << 24 | colour, at(0, 0), at(8, 0), at(0, 8), at(8, 8)});
  }
  [[nodiscard]] std::uint16_t pixel(int x, int y) const { return gpu->vram().at(x, y); }
};

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("Stored hyperbolic depth spends most of its codes near the near plane") {
    const DepthOptions o{.format = DepthFormat::bits32, .near_z = 10, .far_z = 1000};
    CHECK(gpu::stored_depth(o, 10) == 0);
    CHECK(gpu::stored_depth(o, 20) == 2169175402);
    CHECK(gpu::stored_depth(o, 40) == 3253763102);
    CHECK(gpu::stored_depth(o, 100) == 3904515723);
    CHECK(gpu::stored_depth(o, 500) == 4251583787);
    CHECK(gpu::stored_depth(o, 1000) == 4294967295);
  }

  TEST_CASE("Stored depth saturates at near and far, in every format") {
    for (const DepthFormat format :
         {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
      for (const DepthMapping mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
        DepthOptions o{.format = format, .mapping = mapping, .near_z = 10, .far_z = 1000};
        const std::uint32_t largest = gpu::stored_depth(o, 1000);
        CHECK(gpu::stored_depth(o, 3) == 0);
        CHECK(gpu::stored_depth(o, 1e9) == largest);
        CHECK(largest == (format == DepthFormat::float32
                              ? std::bit_cast<std::uint32_t>(1.0F)
                              : static_cast<std::uint32_t>(gpu::depth_scale(format))));
        o.reversed = true;
        CHECK(gpu::stored_depth(o, 3) == largest);
        CHECK(gpu::stored_depth(o, 1e9) == 0);
      }
    }
  }

  TEST_CASE("Linear 16-bit depth is the rounded share of the range") {
    const DepthOptions o{
        .format = DepthFormat::bits16, .mapping = DepthMapping::linear, .near_z = 0.5, .far_z = 65535.5};
    CHECK(gpu::stored_depth(o, 1000.5) == 1000);
    CHECK(gpu::stored_depth(o, 1001.0) == 1001);  // halves round up
  }

  TEST_CASE("With a z-buffer the nearer surface wins in either order, without one the later") {
    for (const bool reversed : {false, true}) {
      Bench near_first(DepthOptions{.reversed = reversed}), far_first(DepthOptions{.reversed = reversed}),
          console(std::nullopt);
      near_first.square(red, 100, 100);
      near_first.square(green, 200, 200);
      far_first.square(green, 200, 200);
      far_first.square(red, 100, 100);
      console.square(red, 100, 100);
      console.square(green, 200, 200);
      CHECK(near_first.pixel(4, 4) == 0x1f);
      CHECK(far_first.pixel(4, 4) == 0x1f);
      CHECK(console.pixel(4, 4) == 0x3e0);
    }
  }

  TEST_CASE("Of equal depths the first wins with less, the last with lequal") {
    for (const DepthTest test : {DepthTest::less, DepthTest::lequal}) {
      Bench bench(DepthOptions{.test = test});
      bench.square(red, 100, 100);
      bench.square(green, 100, 100);
      CHECK(bench.pixel(4, 4) == (test == DepthTest::less ? 0x1f : 0x3e0));
    }
  }

  TEST_CASE(
      "Rows of any length, hidden at their start, in their middle or wholly, show where nothing nearer is") {
    // Bars from x = 0 to 64 a pixel longer in every row, then a far surface over all of it, then a wall
    // before all.
    for (const auto format :
         {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
      CAPTURE(static_cast<int>(format));
      for (const auto test : {DepthTest::less, DepthTest::lequal}) {
        const Bench bench(DepthOptions{.format = format, .test = test});
        const auto quad = [&](std::uint32_t colour, double z, int left, int top, int right, int bottom) {
          bench.gpu->gp0(depths({z, z, z, z}));
          bench.gpu->gp0(
              Words{0x28000000 | colour, at(left, top), at(right, top), at(left, bottom), at(right, bottom)});
        };
        for (int row = 0; row < 65; ++row) quad(red, 100, 0, row, row, row + 1);
        quad(red, 100, 80, 0, 96, 65);
        quad(green, 200, 0, 0, 130, 65);
        std::size_t wrong = 0;
        for (int y = 0; y < 65; ++y) {
          for (int x = 0; x < 140; ++x) {
            const bool is_red = x < y || (x >= 80 && x < 96);
            wrong += bench.pixel(x, y) != (x >= 130 ? 0 : is_red ? 0x1f : 0x3e0) ? 1U : 0U;
          }
        }
        CHECK(wrong == 0);
        quad(0x0000ff, 50, 0, 0, 140, 65);
        quad(0x00ff00, 50, 0, 0, 140, 65);
        CHECK(bench.pixel(0, 30) == (test == DepthTest::less ? 0x1f : 0x3e0));
        CHECK(bench.pixel(139, 30) == (test == DepthTest::less ? 0x1f : 0x3e0));
      }
    }
  }

  TEST_CASE(
      "Of two surfaces at or behind far the first wins with less, the last with lequal, in every format") {
    for (const DepthFormat format :
         {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
      for (const DepthMapping mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
        for (const DepthTest test : {DepthTest::less, DepthTest::lequal}) {
          for (const double z : {1000.0, 5000.0}) {
            for (const bool reversed : {false, true}) {
              const DepthOptions o{
                  .format = format, .mapping = mapping, .test = test, .reversed = reversed, .far_z = 1000};
              Bench bench(o);
              bench.square(red, z, z);
              bench.square(green, z, z);
              CHECK(bench.pixel(4, 4) == (test == DepthTest::less ? 0x1f : 0x3e0));
              CHECK_FALSE(bench.gpu->depth_plane()->is_empty(4, 4));
              CHECK(bench.gpu->depth_plane()->stored(4, 4) == gpu::stored_depth(o, 1000));
            }
          }
        }
      }
    }
  }

  TEST_CASE("A surface at or behind far still covers an empty pixel") {
    for (const DepthFormat format :
         {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
      Bench bench(DepthOptions{.format = format, .far_z = 1000});
      bench.square(red, 5000, 5000);
      CHECK(bench.pixel(4, 4) == 0x1f);
    }
  }

  TEST_CASE("Crossing surfaces are cut where they are equally deep, perspective-correctly") {
    // Left to right 100 .. 400 against a constant 160: 1/z is affine, so the cut is where 1/100 + t (1/400 -
    // 1/100) = 1/160: t = 0.5, column 4. Interpolating z itself would cut at t = 0.2.
    for (const DepthMapping mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
      Bench bench(DepthOptions{.format = DepthFormat::bits32, .mapping = mapping});
      bench.square(red, 100, 400);
      bench.square(green, 160, 160);
      for (int x = 0; x < 8; ++x) {
        if (x != 4) CHECK(bench.pixel(x, 3) == (x < 4 ? 0x1f : 0x3e0));
      }
    }
  }

  TEST_CASE("The stored depth at a vertex is the vertex's own") {
    for (const DepthFormat format : {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32}) {
      for (const DepthMapping mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
        for (const bool reversed : {false, true}) {
          const DepthOptions o{
              .format = format, .mapping = mapping, .reversed = reversed, .near_z = 10, .far_z = 3000};
          Bench bench(o);
          bench.square(red, 123.25, 1777.5);
          CHECK(bench.gpu->depth_plane()->stored(0, 0) == gpu::stored_depth(o, 123.25));
        }
      }
    }
  }

  TEST_CASE("Annotation words change no pixel of the console's picture") {
    tests::RandomWords with(3), without(3);
    const auto a = std::make_unique<gpu::Gpu>(), b = std::make_unique<gpu::Gpu>();
    Words words, stripped;
    with.state(words);
    for (int i = 0; i < 300; ++i) with.polygon(words, 0x20 + with.below(32), true);
    a->gp0(words);
    for (const std::uint32_t word : words) stripped.push_back(word);
    // Feed word by word, leaving out what opens as E7h-EFh.
    std::size_t left = 0;
    for (const std::uint32_t word : words) {
      if (left == 0) {
        const std::uint32_t opcode = word >> 24;
        if (opcode >= 0xe7 && opcode <= 0xef) continue;
        const bool is_polygon = opcode >> 5 == 1;
        const std::size_t n = (opcode & 8) != 0 ? 4 : 3;
        left = is_polygon ? n + ((opcode & 4) != 0 ? n : 0) + ((opcode & 16) != 0 ? n : 1) : 1;
      }
      --left;
      b->gp0(word);
    }
    CHECK(std::equal(a->vram().pixels().begin(), a->vram().pixels().end(), b->vram().pixels().begin()));
  }

  TEST_CASE("Depth serves the next polygon only; one without is drawn in list order and counted") {
    Bench bench(DepthOptions{});
    bench.square(red, 100, 100);
    bench.gpu->gp0(Words{0x28000000 | green, at(0, 0), at(8, 0), at(0, 8), at(8, 8)});
    CHECK(bench.pixel(4, 4) == 0x3e0);
    const gpu::FrameEnd end = bench.gpu->end_frame();
    CHECK(end.polygons_without_depth == 1);
    CHECK(end.first_without_depth == 1);
  }

  TEST_CASE("A polygon that brings depth for some of its vertices only is one without") {
    for (unsigned brought = 1; brought < 15; ++brought) {  // bit v: E8h+v comes; 15 would be all
      CAPTURE(brought);
      Bench bench(DepthOptions{});
      for (std::uint32_t v = 0; v < 4; ++v) {
        if ((brought >> v & 1) != 0) bench.gpu->gp0((0xe8 + v) << 24 | 100U << 12);
      }
      bench.gpu->gp0(Words{0x28000000 | green, at(0, 0), at(8, 0), at(0, 8), at(8, 8)});
      CHECK(bench.gpu->end_frame().polygons_without_depth == 1);
      CHECK(bench.gpu->depth_plane()->is_empty(4, 4));
    }
  }

  TEST_CASE("A default depth serves polygons that bring none") {
    Bench bench(DepthOptions{});
    bench.square(red, 100, 100);
    bench.gpu->set_default_depth(200U << 12);
    bench.gpu->gp0(Words{0x28000000 | green, at(0, 0), at(8, 0), at(0, 8), at(8, 8)});
    CHECK(bench.pixel(4, 4) == 0x1f);
    CHECK(bench.gpu->end_frame().polygons_without_depth == 0);
  }

  TEST_CASE("Semi-transparent polygons wait for the opaque ones and are drawn far to near") {
    Bench bench(DepthOptions{});
    bench.gpu->gp0(0xe1000000);              // average
    bench.square(0xff0000, 100, 100, 0x2a);  // near, blue, issued first
    bench.square(green, 200, 200, 0x2a);     // farther
    bench.square(red, 300, 300);             // opaque behind both
    bench.square(0xffffff, 400, 400, 0x2a);  // hidden
    CHECK(bench.pixel(4, 4) == 0x1f);
    CHECK(bench.gpu->end_frame().queued == 3);
    // ((red + green) / 2 + blue) / 2: r 31 -> 15 -> 7, g 31 -> 15 -> 7, b 31 -> 15
    CHECK(bench.pixel(4, 4) == (7 | 7 << 5 | 15 << 10));
  }

  TEST_CASE("One textured polygon draws its opaque texels in the first pass and the others in the second") {
    Bench bench(DepthOptions{});
    for (int v = 0; v < 8; ++v) {
      for (int u = 0; u < 8; ++u) bench.gpu->vram().at(640 + u, v) = u < 4 ? 0x001f : 0x801f;
    }
    bench.gpu->gp0(depths({100, 100, 100, 100}));
    bench.gpu->gp0(Words{0x2f000000, at(0, 0), 0, at(8, 0), 8 | (10 | 2 << 7) << 16, at(0, 8), 8 << 8,
                         at(8, 8), 8 | 8 << 8});
    CHECK(bench.pixel(2, 2) == 0x1f);
    CHECK(bench.pixel(6, 2) == 0);
    CHECK_FALSE(bench.gpu->depth_plane()->is_empty(2, 2));
    CHECK(bench.gpu->depth_plane()->is_empty(6, 2));
    bench.gpu->end_frame();
    CHECK(bench.pixel(6, 2) == (0x8000 | 15));
    CHECK(bench.gpu->depth_plane()->is_empty(6, 2));
  }

  TEST_CASE("A fill flushes the queue before it") {
    Bench bench(DepthOptions{});
    bench.square(red, 100, 100, 0x2a);
    bench.gpu->gp0(Words{0x02ffffff, 0, at(16, 4)});
    CHECK(bench.pixel(4, 2) == 0x7fff);
    CHECK(bench.pixel(4, 6) == 15);
  }

  TEST_CASE("Depth changes nothing but which opaque fragment wins") {
    tests::RandomWords random(77);
    std::vector<Words> polygons;
    for (int i = 0; i < 60; ++i) {
      random.place(150);
      Words one;
      random.polygon(one, random.coin() ? 0x20 : 0x30, true);
      polygons.push_back(one);
    }
    Bench all(DepthOptions{});
    std::vector<std::unique_ptr<Bench>> alone;
    for (const Words& one : polygons) {
      all.gpu->gp0(one);
      alone.push_back(std::make_unique<Bench>(std::nullopt));
      for (std::uint16_t& pixel : alone.back()->gpu->vram().pixels()) pixel = 0x8000;  // nobody
      alone.back()->gpu->gp0(one);
    }
    std::size_t foreign = 0, missed = 0;
    for (std::size_t i = 0; i < gpu::Vram::size; ++i) {
      bool covered = false, found = false;
      for (const auto& one : alone) {
        const std::uint16_t pixel = one->gpu->vram().pixels()[i];
        if (pixel == 0x8000) continue;
        covered = true;
        found |= pixel == all.gpu->vram().pixels()[i];
      }
      foreign += covered && !found ? 1U : 0U;
      missed += !covered && all.gpu->vram().pixels()[i] != 0 ? 1U : 0U;
    }
    CHECK(foreign == 0);
    CHECK(missed == 0);
  }

  TEST_CASE("Nothing is allocated for depth until it is asked for") {
    gpu::Gpu gpu;
    CHECK(gpu.depth_plane() == nullptr);
    CHECK(gpu.depth_bytes() == 0);
    CHECK(gpu.queue_bytes() == 0);
    gpu.set_depth(DepthOptions{});
    CHECK(gpu.depth_bytes() > 0);
    CHECK(gpu.queue_bytes() == 0);
    gpu.set_depth(std::nullopt);
    CHECK(gpu.depth_bytes() == 0);
  }

  TEST_CASE("in a frame, depth begins anew under what a fill, a copy or an upload wrote") {
    const Words fill{0x02000000, 0, at(16, 4)}, copy{0x80000000, at(32, 0), 0, at(8, 4)},
        upload{0xa0000000, at(0, 0), at(2, 1), 0x11111111};
    for (const Words& words : {fill, copy, upload}) {
      const Bench bench(DepthOptions{});
      bench.square(red, 100, 100);
      CHECK_FALSE(bench.gpu->depth_plane()->is_empty(0, 0));
      bench.gpu->gp0(words);
      CHECK(bench.gpu->depth_plane()->is_empty(0, 0));
      CHECK_FALSE(bench.gpu->depth_plane()->is_empty(0, 7));
      bench.square(green, 200, 200);
      CHECK(bench.pixel(0, 0) == 0x03e0);
      CHECK(bench.pixel(0, 7) == 0x001f);
    }
  }

  TEST_CASE("where mask bits refuse a copy, depth stays as it is") {
    const Bench bench(DepthOptions{});
    bench.gpu->gp0(0xe6000001);  // what is drawn sets bit 15
    bench.square(red, 100, 100);
    bench.gpu->gp0(Words{0xe6000002, 0x80000000, at(32, 0), 0, at(8, 8)});
    CHECK(bench.pixel(0, 0) == 0x801f);
    CHECK_FALSE(bench.gpu->depth_plane()->is_empty(0, 0));
  }

  TEST_CASE("a frame clears the depths that the frame before it drew, and no others") {
    const Bench bench(DepthOptions{});
    CHECK(bench.gpu->depth_plane()->touched_bytes() == 0);
    bench.square(red, 100, 100);
    const auto touched = bench.gpu->depth_plane()->touched_bytes();
    CHECK(touched >= 8 * 8 * 4);
    CHECK(touched <= 9 * 8 * 4);
    bench.gpu->begin_frame();
    CHECK(bench.gpu->depth_plane()->touched_bytes() == 0);
    for (int y = 0; y < 512; ++y) {
      for (int x = 0; x < 1024; ++x) REQUIRE(bench.gpu->depth_plane()->is_empty(x, y));
    }
    bench.square(green, 200, 200);
    CHECK(bench.pixel(0, 0) == 0x03e0);
  }

  TEST_CASE(
      "whatever is drawn, with offsets and drawing areas anywhere, the next frame begins with empty depths") {
    std::mt19937 random(11);
    const auto any = [&random](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    const Bench bench(DepthOptions{});
    for (int n = 0; n < 200; ++n) {
      const auto area = [&](std::uint32_t code, int x, int y) {
        bench.gpu->gp0(code | static_cast<std::uint32_t>(y) << 10 | static_cast<std::uint32_t>(x));
      };
      area(0xe3000000, any(0, 700), any(0, 600));
      area(0xe4000000, any(300, 1023), any(300, 1023));
      bench.gpu->gp0(0xe5000000 | static_cast<std::uint32_t>(any(0, 2047)) << 11 |
                     static_cast<std::uint32_t>(any(0, 2047)));
      for (int k = 0; k < 4; ++k) {
        bench.gpu->gp0(depths({100.0 + k, 200, 300}));
        const auto corner = [&] { return at(any(0, 1000), any(0, 500)); };
        const auto a = corner(), b = corner(), c = corner();
        bench.gpu->gp0(Words{0x20000000 | red, a, b, c});
      }
      bench.gpu->begin_frame();
      bool is_empty = true;
      for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 1024; ++x) is_empty = is_empty && bench.gpu->depth_plane()->is_empty(x, y);
      }
      REQUIRE(is_empty);
    }
  }
}
