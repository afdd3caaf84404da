// Any moment of a recording, reached from anywhere, is what a plain replay up to it gives.

#include "debug/timeline.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "streams.h"

namespace {

using debug::Recording, debug::whole_frame;
using dump::PacketType;
using tests::Timeline, tests::pixels_of, tests::random_dump, tests::Words, tests::xy;
using Pixels = std::vector<std::uint16_t>;

/// A state word, a fill, a word of port 1; then an upload over the end of the frame, and a triangle with
/// depth.
dump::Dump two_frames() {
  dump::Dump dump;
  dump.add(PacketType::port0, Words{0xe1000000, 0x020000f8, 0, 0x00100010});
  dump.add(PacketType::port1, Words{0x05000000});
  dump.add(PacketType::port0, Words{0xa0000000, xy(100, 0), xy(2, 2), 0x22221111});
  dump.add(PacketType::vsync);
  dump.add(PacketType::port0, Words{0x44443333});
  dump.add(PacketType::port0, Words{0xe4000000 | 1023 | 511 << 10, 0xe8000001, 0xe9000001, 0xea000001,
                                    0x2000ff00, xy(0, 0), xy(16, 0), xy(0, 16)});
  dump.add(PacketType::vsync);
  dump.vsyncs = 2;
  return dump;
}

/// VRAM after command `number` of frame `frame`: the words up to the end of that command, sent one by one.
Pixels replayed(const dump::Dump& dump, const debug::Place& end) {
  gpu::Gpu gpu;
  for (std::size_t n = 0; n <= end.packet && n < dump.packets.size(); ++n) {
    const auto& packet = dump.packets[n];
    const auto payload = dump.payload(packet);
    const std::size_t count = n == end.packet ? end.word : payload.size();
    for (std::size_t w = 0; w < count; ++w) {
      if (packet.type == PacketType::port0) gpu.gp0(payload[w]);
      if (packet.type == PacketType::port1) gpu.gp1(payload[w]);
    }
    if (packet.type == PacketType::vsync && n != end.packet) gpu.next_field();
  }
  return pixels_of(gpu);
}

}  // namespace

TEST_SUITE("debug") {
  TEST_CASE("every command has a number in its frame, state and both ports included, annotation words not") {
    Timeline timeline{Recording(two_frames())};
    REQUIRE(timeline.frames() == 2);
    std::string list;
    for (std::uint64_t frame = 1; frame <= 2; ++frame) {
      for (const auto& command : timeline.commands(frame)) {
        list += debug::to_text(timeline.number_of(frame, command)) + " #" + std::to_string(command.drawing) +
                " " + debug::describe(timeline.dump(), command) + "\n";
      }
    }
    CHECK(list ==
          "1:1 #0 draw mode page 0,0 4-bit blend (B+F)/2\n"
          "1:2 #1 fill (0,0) 16x16 f80000\n"
          "1:3 #0 display from 0,0\n"
          "1:4 #2 upload to (100,0) 2x2\n"
          "2:1 #0 drawing area to 1023,511\n"
          "2:2 #3 triangle (0,0) (16,0) (0,16) 00ff00\n");
  }

  TEST_CASE(
      "a command that goes on over the end of a frame belongs to the frame where the GPU begins to obey it") {
    Timeline timeline{Recording(two_frames())};
    CHECK(timeline.seek({.frame = 1, .command = 4}).vram().at(100, 0) == 0x1111);
    CHECK(timeline.gpu().vram().at(100, 1) == 0);
    CHECK(timeline.seek({.frame = 2, .command = 0}).vram().at(100, 1) == 0);
    CHECK(timeline.seek({.frame = 2, .command = 1}).vram().at(100, 1) == 0x3333);
    CHECK(timeline.gpu().vram().at(2, 2) == 0x001f);
    CHECK(timeline.seek({.frame = 2, .command = 2}).vram().at(2, 2) == 0x03e0);
  }

  TEST_CASE("from anywhere to anywhere: the pixels are those of a plain replay") {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const auto dump = random_dump(seed, 6, 30);
      Timeline timeline{Recording(dump)};
      tests::Random random(seed);
      const bool is_indexed = seed % 2 == 0;
      while (is_indexed && timeline.index_some(1)) {
      }
      CHECK(timeline.is_indexed() == is_indexed);
      for (int n = 0; n < 25; ++n) {
        const std::uint64_t frame = 1 + random.below(static_cast<std::uint32_t>(timeline.frames()));
        const auto commands = timeline.commands(frame);
        if (commands.empty()) continue;
        const auto& command = commands[random.below(static_cast<std::uint32_t>(commands.size()))];
        CAPTURE(frame);
        CAPTURE(command.number);
        CHECK(pixels_of(timeline.seek({.frame = frame, .command = command.number})) ==
              replayed(dump, command.end));
      }
      gpu::Gpu whole;
      dump::replay(dump, whole);
      CHECK(pixels_of(timeline.seek({.frame = timeline.frames(), .command = whole_frame})) ==
            pixels_of(whole));
    }
  }

  TEST_CASE("however little memory there is for states, every moment is reached") {
    const auto dump = random_dump(7, 40, 60);
    Timeline small(Recording{dump}, {}, std::uint64_t{4} << 20), large{Recording(dump)};
    while (small.index_some(5)) {
    }
    CHECK(small.keyframes().bytes() <= std::uint64_t{4} << 20);
    for (const std::uint64_t frame : {40U, 3U, 39U, 20U, 1U}) {
      CAPTURE(frame);
      CHECK(pixels_of(small.seek({frame, whole_frame})) == pixels_of(large.seek({frame, whole_frame})));
    }
  }

  TEST_CASE("a watched frame tells the number of the command behind every draw") {
    Timeline timeline{Recording(two_frames())};
    gpu::Trace trace;
    trace.keep_history = true;
    timeline.watch(1, trace);
    REQUIRE(trace.draws.size() == 2);
    CHECK(debug::to_text(debug::number_of(1, trace.draws[0])) == "1:2");
    CHECK(debug::to_text(debug::number_of(1, trace.draws[1])) == "1:4");
    timeline.watch(2, trace);
    REQUIRE(trace.draws.size() == 2);
    CHECK(debug::to_text(debug::number_of(2, trace.draws[0])) == "2:0");  // the rest of the upload
    CHECK(debug::to_text(debug::number_of(2, trace.draws[1])) == "2:2");
    timeline.watch(2, trace, 1);
    CHECK(trace.draws.size() == 1);
  }

  TEST_CASE("the numbers that the GPU gives to draws are those of the list, whatever the commands") {
    for (std::uint32_t seed = 11; seed <= 14; ++seed) {
      CAPTURE(seed);
      Timeline timeline{Recording(random_dump(seed, 4, 40))};
      for (std::uint64_t frame = 1; frame <= timeline.frames(); ++frame) {
        gpu::Trace trace;
        timeline.watch(frame, trace);
        std::vector<std::uint64_t> drawn, listed;
        for (const auto& draw : trace.draws) {
          const auto number = debug::number_of(frame, draw).command;
          if (number != 0 && (drawn.empty() || drawn.back() != number)) drawn.push_back(number);
        }
        for (const auto& command : timeline.commands(frame))
          if (command.drawing != 0) listed.push_back(command.number);
        CHECK(drawn == listed);
      }
    }
  }

  TEST_CASE("drawing commands are found by their number over all frames") {
    Timeline timeline{Recording(two_frames())};
    CHECK(timeline.find_drawing(1) == debug::Number{.frame = 1, .command = 2});
    CHECK(timeline.find_drawing(2) == debug::Number{.frame = 1, .command = 4});
    CHECK(timeline.find_drawing(3) == debug::Number{.frame = 2, .command = 2});
    CHECK_FALSE(timeline.find_drawing(4));
  }

  TEST_CASE("a list in RAM is one frame; its commands have buckets and the addresses of their packets") {
    debug::RamImage image;
    image.head = 0x100c;
    image.table = inspect::TableRange{0x1000, 4};
    for (const auto& [address, word] :
         std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0x100c, 0x00002000},
                                                              {0x1008, 0x00001004},
                                                              {0x1004, 0x00002100},
                                                              {0x1000, 0x00ffffff},
                                                              {0x2000, 0x03001008},
                                                              {0x2004, 0x020000f8},
                                                              {0x2008, 0},
                                                              {0x200c, 0x00100010},
                                                              {0x2100, 0x03001000},
                                                              {0x2104, 0x0200f800},
                                                              {0x2108, 0},
                                                              {0x210c, 0x00100010}})
      image.ram.write(address, word);
    auto recording = Recording::of_list(std::move(image), Pixels(gpu::Vram::size, 0x7fff));
    REQUIRE(recording);
    Timeline timeline(std::move(*recording));
    REQUIRE(timeline.frames() == 1);
    const auto commands = timeline.commands(1);
    REQUIRE(commands.size() == 2);
    CHECK(debug::to_text(timeline.number_of(1, commands[0])) == "1:1:3");
    CHECK(debug::to_text(timeline.number_of(1, commands[1])) == "1:2:1");
    CHECK(timeline.origin_of(commands[0]) == "002000h");
    CHECK(timeline.origin_of(commands[1]) == "002100h");
    CHECK(timeline.seek({1, 1}).vram().at(0, 0) == 0x1f);
    CHECK(timeline.gpu().vram().at(16, 0) == 0x7fff);
    CHECK(timeline.seek({1, 2}).vram().at(0, 0) == 0x3e0);
    gpu::Trace trace;
    timeline.watch(1, trace);
    REQUIRE(trace.draws.size() == 2);
    CHECK(debug::to_text(debug::number_of(1, trace.draws[1])) == "1:2:1");
  }

  TEST_CASE("a list that does not end well is refused with the tags") {
    debug::RamImage image;
    image.head = 0x1000;
    image.ram.write(0x1000, 0x00001000);
    const auto recording = Recording::of_list(std::move(image));
    REQUIRE_FALSE(recording);
    CHECK(recording.error().text.find("1000h") != std::string::npos);
  }

  TEST_CASE(
      "a z-buffered moment in mid-frame shows what is queued, and the whole frame comes out the same after "
      "it") {
    dump::Dump dump;
    dump.add(PacketType::port0, tests::everywhere);
    const auto triangle = [](std::uint32_t colour, std::uint32_t z) {
      return Words{0xe8000000 | z, 0xe9000000 | z, 0xea000000 | z, colour, xy(0, 0), xy(64, 0), xy(0, 64)};
    };
    Words words;
    for (const auto& more :
         {triangle(0x22ffffff, 0x20000), triangle(0x200000ff, 0x30000), triangle(0x2000ff00, 0x50000)})
      words.insert(words.end(), more.begin(), more.end());
    dump.add(PacketType::port0, words);
    dump.add(PacketType::vsync);
    Timeline timeline(Recording{dump}, {.depth = gpu::DepthOptions{}});
    const auto whole = pixels_of(timeline.seek({1, whole_frame}));
    const auto half = timeline.seek({1, 3}).vram().at(4, 4);
    CHECK(half == 0x3def);  // white over black, halved
    CHECK(pixels_of(timeline.seek({1, whole_frame})) == whole);
  }
}
