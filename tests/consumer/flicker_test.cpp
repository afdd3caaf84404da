// How a homebrew project tests its sorting: build the list that the console would get, with the depths beside
// it, draw it, and hold the number of wrong pixels.

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <array>
#include <sstream>

#include "gpu/gpu.h"
#include "inspect/check.h"
#include "ot/main_ram.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"
#include "ot/walker.h"

namespace {

constexpr std::uint32_t table_address = 0x1000, table_length = 64, packets_begin = 0x2000,
                        packets_end = 0x8000;

// A program's table of 64 buckets over depths 0..4095.
class Frame {
 public:
  Frame() { table_.clear(); }

  // A tile of the screen that faces us, `z` away.
  void add_tile(std::int16_t x, std::int16_t y, std::int16_t size, std::uint32_t z, ot::Rgb colour) {
    ot::Polygon quad{.quad = true};
    quad.xy = {{{x, y},
                {static_cast<std::int16_t>(x + size), y},
                {x, static_cast<std::int16_t>(y + size)},
                {static_cast<std::int16_t>(x + size), static_cast<std::int16_t>(y + size)}}};
    quad.rgb[0] = colour;
    ot::DepthAnnotation depth{.count = 4};
    depth.z.fill(z * 4096);
    const auto first = push(depth), last = push(quad);
    ot::link(ram_, first, last);
    table_.insert(z / 64, first, last);
  }

  inspect::Report judge() {
    gpu::Trace trace;
    trace.keep_history = true;
    gpu::Gpu gpu;
    gpu.gp0(std::array<std::uint32_t, 2>{0xe3000000, 0xe403bd3f});  // drawing area 0,0 .. 319,239
    gpu.set_trace(&trace);
    const auto walked =
        ot::walk(ram_, table_.head(), [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
          if (const auto bucket = table_.bucket_of(tag)) trace.bucket = *bucket;
          gpu.gp0(payload);
        });
    REQUIRE(walked);
    return inspect::inspect(trace, {.scene = "tiles"});
  }

 private:
  template <class Packet>
  std::uint32_t push(const Packet& packet) {
    std::array<std::uint32_t, 16> words{};
    return arena_.push(std::span(words).first(ot::encode(packet, words))).value();
  }

  ot::MainRam ram_{ot::RamSize::mib2};
  ot::OrderingTable table_{ram_, table_address, table_length};
  ot::PacketArena arena_{ram_, packets_begin, packets_end};
};

}  // namespace

TEST_CASE("tiles in buckets of their own are drawn right") {
  Frame frame;
  frame.add_tile(10, 10, 20, 1000, {255, 0, 0});
  frame.add_tile(20, 20, 20, 2000, {0, 255, 0});
  const auto report = frame.judge();
  CHECK(wrong_pixels(report) == 0);
}

TEST_CASE("tiles in one bucket flicker, and the report says which") {
  Frame frame;
  frame.add_tile(20, 20, 20, 1010, {0, 255, 0});  // inserted first, so drawn last, and it is the farther one
  frame.add_tile(10, 10, 20, 1000, {255, 0, 0});
  const auto report = frame.judge();
  CHECK(wrong_pixels(report, inspect::Cause::bucket_tie) == 100);
  CHECK(wrong_pixels(report, inspect::Cause::key_inversion) == 0);

  std::ostringstream message;
  message << wrong_pixels(report);
  CHECK(message.str().find("100 px  BucketTie        0:4:15 / 0:3:15, depth 1010.00 / 1000.00") !=
        std::string::npos);
  CHECK(message.str().find("between (20,20) and (29,29)") != std::string::npos);
  CHECK(message.str().find("    TTTTTTTTTT\n") != std::string::npos);
}
