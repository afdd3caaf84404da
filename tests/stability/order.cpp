// The same list is the same picture, whichever instructions draw it; the same scene is the same list,
// whichever compiler built the program.

#include <doctest/doctest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "demos/demos.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "ot/packet.h"
#include "ot/walker.h"
#include "scene/frame.h"
#include "scene/pipeline.h"
#include "stability/measure.h"
#include "stability/triangulation.h"

using stability::Measure;
using stability::Random;

namespace {

/// FNV-1a over 32-bit words.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325;
  void add(std::uint32_t word) { value = (value ^ word) * 0x100000001b3; }
};

/// As the constants below are written.
std::string hex(std::uint64_t value) {
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "0x%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

struct FrameHashes {
  std::uint64_t list = 0, vram = 0;
  bool operator==(const FrameHashes&) const = default;
};

FrameHashes hashes_of_frame(std::string_view demo, const scene::Knobs& knobs) {
  scene::FrameBuilder builder(demos::make(*demos::find(demo)), knobs);
  ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  auto frame = builder.build(0, knobs, ram, scene::Annotate::always);
  REQUIRE(frame);
  Hash list, vram;
  const auto walked = ot::walk(ram, frame->head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    for (const auto word : payload) list.add(word);
  });
  REQUIRE(walked);
  REQUIRE(scene::draw_frame(builder, *frame, ram, gpu));
  for (const auto pixel : gpu.vram().pixels()) vram.add(pixel);
  return {list.value, vram.value};
}

/// Words of every drawing command with random operands, after an upload of noise that textures show.
std::vector<std::uint32_t> recorded_list() {
  Random random(80);
  std::vector<std::uint32_t> words{0xe3000000, 0xe407ffff, 0xe5000000, 0xa0000000, 0, 512U << 16 | 512};
  for (int i = 0; i < 512 * 256; ++i) words.push_back(random.word());
  const auto vertex = [&] {
    const auto x = static_cast<std::uint32_t>(random.between(-50, 700)) & 0x7ff;
    return x | (static_cast<std::uint32_t>(random.between(-50, 500)) & 0x7ff) << 16;
  };
  for (int i = 0; i < 600; ++i) {
    const auto opcode = static_cast<std::uint32_t>(random.between(0x20, 0x3f));
    const bool quad = (opcode & 8) != 0, textured = (opcode & 4) != 0, gouraud = (opcode & 16) != 0;
    words.push_back(0xe1000000 | static_cast<std::uint32_t>(random.between(0, 0x7ff)));
    for (int v = 0; v < (quad ? 4 : 3); ++v) {
      const auto colour = random.word() & 0xffffff;
      if (v == 0) words.push_back(opcode << 24 | colour);
      if (v != 0 && gouraud) words.push_back(colour);
      words.push_back(vertex());
      if (textured) {
        const std::uint32_t clut = 0x3c00, page = static_cast<std::uint32_t>(random.between(0, 0x1ff));
        words.push_back((random.word() & 0xffff) | (v == 0 ? clut : page) << 16);
      }
    }
  }
  return words;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("A recorded list draws the same frame on every set of vector instructions") {
    // A constant, not a comparison between targets alone: every compiler, optimisation and sanitizer that
    // builds this test must meet it too. It changes with a rule of the GPU, or with the list, and with
    // nothing else.
    constexpr std::uint64_t expected = 0x3f524cbe5e1d9d96;
    Measure wrong{"8. Order",
                  "600 polygons of all 32 kinds over noise, on scalar, SSE4, AVX2 and AVX-512 as far as the "
                  "processor has them",
                  "a picture that depends on the machine or the compiler",
                  "one hash, the same in every build",
                  "hashes",
                  0};
    const auto words = recorded_list();
    std::uint64_t inputs = words.size();
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      gpu::Gpu gpu;
      gpu.gp0(words);
      Hash hash;
      for (const auto pixel : gpu.vram().pixels()) hash.add(pixel);
      CHECK_MESSAGE(hash.value == expected, hex(hash.value));
      wrong.see(hash.value == expected ? 0 : 1, inputs);
      inputs = 0;  // counted once: the page is the same on every machine
    }
    hwy::SetSupportedTargetsForTest(0);
  }

  TEST_CASE("Frame 0 of every first scene is the same list and the same picture in every build") {
    // Constants for the same reason: scene set-up is floating point, and only constants see a compiler that
    // fuses or reorders it. Who changes a scene on purpose puts the values that the failing check prints
    // here.
    struct Row {
      std::string_view demo;
      FrameHashes expected;
    };
    constexpr std::array<Row, 5> rows{{
        {"crates", {0xd6a0802caa9e4d4b, 0x59e37f3689c0e644}},
        {"cyclic", {0x464114d80e616abf, 0x46001bb61294c188}},
        {"crossing", {0x8debeb9fb36d2740, 0x8e3dad0dc17a5aaa}},
        {"corridor", {0x70aa6462342290c5, 0xba3e2c381fdcb428}},
        {"glass", {0x96251ee3cc2e404d, 0x32e097fba8d0a5b5}},
    }};
    Measure wrong{"8. Order",
                  "frame 0 of crates, cyclic, crossing, corridor and glass, list and VRAM",
                  "scene set-up that depends on the compiler or its options",
                  "one hash each, the same in every build",
                  "hashes",
                  0};
    for (const auto& row : rows) {
      const FrameHashes& expected = row.expected;
      const auto seen = hashes_of_frame(row.demo, {});
      CAPTURE(std::string(row.demo));
      CHECK_MESSAGE(seen.list == expected.list, hex(seen.list));
      CHECK_MESSAGE(seen.vram == expected.vram, hex(seen.vram));
      wrong.see((seen.list != expected.list) + (seen.vram != expected.vram), 2);
    }
  }

  TEST_CASE("Near 1e-3 and far 1e6 keep their order in a reversed float buffer") {
    Measure wrong{"6. Depth",
                  "pairs of depths from 0.001 to 1,000,000 that differ by 2^-21 of themselves, at least one "
                  "unit of 2^-12, in both orders, float, reversed, near 1e-3, far 1e6",
                  "the farther of two surfaces in front",
                  "the nearer one is seen",
                  "pairs",
                  0};
    const gpu::DepthOptions options{.format = gpu::DepthFormat::float32,
                                    .mapping = gpu::DepthMapping::hyperbolic,
                                    .test = gpu::DepthTest::less,
                                    .reversed = true,
                                    .near_z = 1e-3,
                                    .far_z = 1e6};
    gpu::Gpu gpu;
    gpu.set_depth(options);
    gpu.gp0(std::array<std::uint32_t, 3>{0xe3000000, 0xe407ffff, 0xe5000000});
    Random random(82);
    const auto draw = [&](std::uint32_t z, std::uint32_t colour) {
      gpu.gp0(std::array<std::uint32_t, 8>{0xe7000000 | z >> 24 | z >> 24 << 8 | z >> 24 << 16,
                                           0xe8000000 | (z & 0xffffff), 0xe9000000 | (z & 0xffffff),
                                           0xea000000 | (z & 0xffffff), 0x20000000 | colour, 0, 2, 2 << 16});
    };
    for (int i = 0; i < 20'000; ++i) {
      // Spread over the magnitudes: 5 (0.0012) to 4,095,999,999 (1,000,000), units of 2^-12.
      const auto z = std::min<std::uint32_t>(
          5 + (random.word() >> static_cast<unsigned>(random.between(0, 30))), 4'000'000'000);
      const auto behind = z + std::max<std::uint32_t>(1, z >> 21);
      gpu.begin_frame();
      draw(i % 2 == 0 ? z : behind, i % 2 == 0 ? 0xff : 0xff00);
      draw(i % 2 == 0 ? behind : z, i % 2 == 0 ? 0xff00 : 0xff);
      (void)gpu.end_frame();
      wrong.see(gpu.vram().at(0, 0) == 0x1f ? 0 : 1);
    }
  }
}
