// Every kernel, on every dispatch target, against the plain rasterizer: all of VRAM
// after every batch of commands.

#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "gpu/gpu.h"
#include "gpu/kernels.h"
#include "random_words.h"
#include "tests/oracle/plain_gpu.h"

namespace {

struct Restore {
  std::string name{gpu::target_name()};
  ~Restore() { gpu::use_target(name); }
};

/// Feeds the same words to both and tells the first pixel that differs.
struct Pair {
  gpu::Gpu fast;
  oracle::PlainGpu plain;

  void feed(const std::vector<std::uint32_t>& words) {
    fast.gp0(words);
    plain.gp0(words);
  }
  void check() const {
    std::size_t differing = 0, first = 0;
    for (std::size_t i = 0; i < gpu::Vram::size; ++i) {
      if (fast.vram().pixels()[i] != plain.vram[i] && differing++ == 0) first = i;
    }
    CAPTURE(first % 1024);
    CAPTURE(first / 1024);
    CHECK(differing == 0);
  }
};

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("Every dispatch target draws random commands like the plain rasterizer, bit for bit") {
    const Restore restore;
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      REQUIRE(gpu::use_target(target));
      const auto both = std::make_unique<Pair>();
      tests::RandomWords random(20);
      both->feed(random.noise());
      for (int batch = 0; batch < 12; ++batch) {
        std::vector<std::uint32_t> words;
        random.state(words);
        for (int i = 0; i < 300; ++i) random.command(words);
        both->feed(words);
        both->check();
      }
    }
  }

  TEST_CASE(
      "Every console mode is drawn by its own kernel like the plain rasterizer, on every dispatch target") {
    const Restore restore;
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      REQUIRE(gpu::use_target(target));
      const auto both = std::make_unique<Pair>();
      tests::RandomWords random(4);
      both->feed(random.noise());
      both->feed({0xe3000000, 0xe4000000 | 500 | 255 << 10});
      for (std::uint32_t opcode = 0x20; opcode < 0x40; ++opcode) {
        for (std::uint32_t variant = 0; variant < 4 * 3 * 2 * 2; ++variant) {
          // Blend, texture format, dither, mask test; pages beside the drawing area,
          // so that blocks may be used.
          const std::uint32_t blend = variant & 3, format = variant / 4 % 3, dither = variant / 12 % 2;
          std::vector<std::uint32_t> words{0xe1000000 | dither << 9 | blend << 5,
                                           0xe6000000 | (variant / 24 * 2)};
          both->feed(words);
          for (int i = 0; i < 3; ++i) {
            words.clear();
            random.place(60);
            random.polygon(words, opcode);
            if ((opcode & 4) != 0) {
              const std::size_t page = (opcode & 16) != 0 ? 5 : 4;
              words[page] = (words[page] & 0xffff) | (10 | blend << 5 | format << 7) << 16;
            }
            both->feed(words);
          }
        }
      }
      both->check();
      std::size_t used = 0, possible = 0;
      for (std::size_t i = 0; i < gpu::Mode::count; ++i) {
        if (gpu::Mode::at(i).depth) continue;
        ++possible;
        used += both->fast.counters().kernels[i] != 0 ? 1U : 0U;
      }
      CHECK(used == possible);
      CHECK(both->fast.counters().drawn_in_order < both->fast.counters().triangles / 4);
    }
  }

  TEST_CASE("Every dispatch target copies rows onto themselves like the plain rasterizer") {
    const Restore restore;
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      REQUIRE(gpu::use_target(target));
      const auto both = std::make_unique<Pair>();
      tests::RandomWords random(31);
      both->feed(random.noise());
      for (int i = 0; i < 400; ++i) {
        const std::uint32_t row = random.below(512) << 16, x = random.below(1024);
        const std::uint32_t to = i % 2 != 0 ? x + random.below(300) : x - random.below(300);
        const std::uint32_t size = (1 + random.below(i % 3 == 0 ? 1024 : 400)) | (1 + random.below(4)) << 16;
        both->feed({0xe6000000 | (i % 5 == 0 ? 2U : 0U), 0x80000000, x | row, (to & 1023) | row, size});
      }
      both->check();
    }
  }

  TEST_CASE("With a z-buffer of any format every target draws and stores like the plain rasterizer") {
    const Restore restore;
    using gpu::DepthFormat, gpu::DepthMapping, gpu::DepthTest;
    std::uint32_t seed = 0;
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      REQUIRE(gpu::use_target(target));
      for (std::uint32_t variant = 0; variant < 4 * 2 * 2 * 2; ++variant) {
        const gpu::DepthOptions options{.format = static_cast<DepthFormat>(variant & 3),
                                        .mapping = static_cast<DepthMapping>(variant >> 2 & 1),
                                        .test = static_cast<DepthTest>(variant >> 3 & 1),
                                        .reversed = (variant >> 4 & 1) != 0,
                                        .near_z = 16,
                                        .far_z = 2000};
        CAPTURE(variant);
        const auto both = std::make_unique<Pair>();
        both->fast.set_depth(options);
        both->plain.set_depth(options);
        both->fast.begin_frame();
        tests::RandomWords random(++seed);
        std::vector<std::uint32_t> words;
        random.state(words);
        words.insert(words.end(), {0xe3000000, 0xe4000000 | 639 | 479 << 10});
        for (int i = 0; i < 150; ++i) random.command(words, true);
        both->feed(words);
        const gpu::FrameEnd end = both->fast.end_frame();
        both->plain.end_frame();
        CHECK(end.polygons_without_depth > 0);
        CHECK(end.queued > 0);
        both->check();
        std::size_t differing = 0;
        for (int y = 0; y < 512; ++y) {
          for (int x = 0; x < 1024; ++x) {
            const std::uint32_t key = both->plain.depth[static_cast<std::size_t>(y * 1024 + x)];
            const bool empty = key == gpu::DepthPlane::empty;
            if (both->fast.depth_plane()->is_empty(x, y) != empty) ++differing;
            if (!empty && both->fast.depth_plane()->stored(x, y) != gpu::depth_of_key(options, key))
              ++differing;
          }
        }
        CHECK(differing == 0);
      }
    }
  }

  TEST_CASE("A watched GPU draws the same pixels and knows the last writer of each") {
    tests::RandomWords random(7);
    const auto watched = std::make_unique<gpu::Gpu>(), free = std::make_unique<gpu::Gpu>();
    gpu::Trace trace;
    trace.keep_history = true;
    watched->set_trace(&trace);
    std::vector<std::uint32_t> words;
    random.state(words);
    for (int i = 0; i < 600; ++i) random.command(words);
    watched->gp0(words);
    free->gp0(words);
    CHECK(std::equal(free->vram().pixels().begin(), free->vram().pixels().end(),
                     watched->vram().pixels().begin()));

    // The history alone rebuilds the picture and the last writers.
    std::vector<std::uint16_t> picture(gpu::Vram::size);
    std::vector<std::uint32_t> writers(gpu::Vram::size);
    bool befores_agree = true;
    for (const gpu::Event& event : trace.history) {
      befores_agree &= picture[event.pixel] == event.before;
      picture[event.pixel] = event.after;
      writers[event.pixel] = event.draw + 1;
      if (event.draw >= trace.draws.size()) befores_agree = false;
    }
    CHECK(befores_agree);
    CHECK(std::equal(picture.begin(), picture.end(), watched->vram().pixels().begin()));
    CHECK(writers == trace.last_writer);
  }

  TEST_CASE("Watched through a z-buffer, lost fragments are told as rejected and change nothing") {
    tests::RandomWords random(8);
    const auto watched = std::make_unique<gpu::Gpu>(), free = std::make_unique<gpu::Gpu>();
    gpu::Trace trace;
    trace.keep_history = true;
    watched->set_trace(&trace);
    std::vector<std::uint32_t> words{0xe3000000, 0xe4000000 | 639 | 479 << 10};
    for (int i = 0; i < 200; ++i) {
      random.place(300);
      random.polygon(words, 0x20 + random.below(32), true);
    }
    for (gpu::Gpu* one : {watched.get(), free.get()}) {
      one->set_depth(gpu::DepthOptions{});
      one->begin_frame();
      one->gp0(words);
      one->end_frame();
    }
    CHECK(std::equal(free->vram().pixels().begin(), free->vram().pixels().end(),
                     watched->vram().pixels().begin()));
    std::size_t rejected = 0, wrong = 0, different_depths = 0;
    std::vector<std::uint32_t> writers(gpu::Vram::size);
    for (const gpu::Event& event : trace.history) {
      if (!event.rejected) writers[event.pixel] = event.draw + 1;
      rejected += event.rejected ? 1U : 0U;
      wrong += event.rejected && event.before != event.after ? 1U : 0U;
      wrong += event.rejected && !trace.draws[event.draw].has_depth ? 1U : 0U;
    }
    for (int y = 0; y < gpu::Vram::height; ++y) {
      for (int x = 0; x < gpu::Vram::width; ++x) {
        if (watched->depth_plane()->stored(x, y) != free->depth_plane()->stored(x, y)) ++different_depths;
      }
    }
    CHECK(rejected > 0);
    CHECK(wrong == 0);
    CHECK(different_depths == 0);
    CHECK(writers == trace.last_writer);
  }
}
