// A running program's frames: where they end, what is in them, and how they travel.

#include "door/live.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "door/device.h"

namespace {

using Words = std::vector<std::uint32_t>;

std::uint32_t xy(std::uint32_t x, std::uint32_t y) { return x | y << 16; }

/// A device whose frames are kept.
struct Watched {
  Watched() {
    device.gp0(Words{0xe3000000, 0xe407ffff});
    device.watch([this] { return is_wanted; },
                 [this](door::LiveFrame frame) { frames.push_back(std::move(frame)); });
  }
  void square(std::uint32_t x) { device.gp0(Words{0x600000ff, xy(x, 0), xy(2, 2)}); }
  void show(std::uint32_t y) { device.gp1(0x05000000 | y << 10); }
  door::Device device;
  bool is_wanted = true;
  std::vector<door::LiveFrame> frames;
};

/// What the words of a frame draw.
std::vector<std::uint16_t> replayed(const door::LiveFrame& frame) {
  gpu::Gpu gpu;
  REQUIRE_FALSE(gpu.load(frame.state).has_value());
  std::size_t at = 0;
  for (const auto& run : frame.runs) {
    const auto words = std::span(frame.words).subspan(at, run.words);
    run.is_control ? gpu.gp1(words[0]) : gpu.gp0(words);
    at += run.words;
  }
  const auto pixels = gpu.vram().pixels();
  return {pixels.begin(), pixels.end()};
}

std::vector<std::uint16_t> vram_of(door::Device& device) {
  const auto pixels = device.gpu().vram().pixels();
  return {pixels.begin(), pixels.end()};
}

}  // namespace

TEST_SUITE("live") {
  TEST_CASE("A frame ends where the display turns to another buffer, whatever blanks lie in it") {
    Watched at;
    at.show(256);
    at.show(0);
    at.square(0);
    at.device.vblank();
    at.square(4);
    at.device.vblank();
    CHECK(at.frames.empty());
    const auto drawn = vram_of(at.device);
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    CHECK(replayed(at.frames[0]) == drawn);
    at.square(8);
    at.show(0);
    REQUIRE(at.frames.size() == 2);
    CHECK(at.frames[1].number == 2);
    CHECK(replayed(at.frames[1]) == vram_of(at.device));
  }

  TEST_CASE("A program that shows one buffer ends its frames at vertical blanks behind something drawn") {
    Watched at;
    for (int blank = 0; blank < 200; ++blank) at.device.vblank();
    const auto before = at.frames.size();
    at.square(0);
    at.device.vblank();
    CHECK(at.frames.size() == before + 1);
    at.device.vblank();
    CHECK(at.frames.size() == before + 1);
  }

  TEST_CASE("A frame begins between two commands") {
    Watched at;
    at.device.stop_watching();
    at.device.gp0(Words{0x600000ff, xy(0, 0)});
    at.device.watch([] { return true; },
                    [&at](door::LiveFrame frame) { at.frames.push_back(std::move(frame)); });
    at.device.gp0(Words{xy(2, 2), 0x60ffffff, xy(4, 4), xy(2, 2)});
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    CHECK(at.frames[0].words == Words{0x60ffffff, xy(4, 4), xy(2, 2)});
    CHECK(replayed(at.frames[0]) == vram_of(at.device));
  }

  TEST_CASE("Frames that nobody can take pass, and are counted") {
    Watched at;
    at.is_wanted = false;
    at.square(0);
    at.is_wanted = true;  // from the next frame on, which begins with the word that shows its buffer
    at.show(256);
    at.square(4);
    at.show(0);
    REQUIRE(at.frames.size() == 1);
    CHECK(at.frames[0].number == 2);
  }

  TEST_CASE("Words of a list say their packet and its bucket in the longest table") {
    Watched at;
    Words ram(0x200000 / 4);
    // Entries 7..0 at 1000h.. link downwards; a packet hangs between 5 and 4.
    for (std::uint32_t n = 0; n < 8; ++n)
      ram[(0x1000 + 4 * n) / 4] = n == 0 ? 0xffffff : 0x1000 + 4 * (n - 1);
    ram[0x1014 / 4] = 0x2000;
    const Words packet{3U << 24 | 0x1010, 0x600000ff, xy(0, 0), xy(2, 2)};
    std::copy(packet.begin(), packet.end(), ram.begin() + 0x2000 / 4);
    at.device.send_list(ram, 0x101c, 100);
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    CHECK(at.frames[0].buckets == 8);
    REQUIRE(at.frames[0].runs.size() == 1);
    CHECK(at.frames[0].runs[0].is_list);
    CHECK(at.frames[0].runs[0].address == 0x2000);
    CHECK(at.frames[0].runs[0].bucket == 5);
  }

  TEST_CASE("What is wrong with a list that begins a frame is told with the frame") {
    Watched at;
    Words ram(0x200000 / 4);
    ram[0x400] = 3U << 24 | 0x1000;  // links to itself
    at.device.send_list(ram, 0x1000, 100);
    at.square(0);
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    REQUIRE_FALSE(at.frames[0].lint.empty());
    CHECK(at.frames[0].lint[0].kind == "loop");
  }

  TEST_CASE("A polygon whose vertices are known brings its depth into the frame") {
    Watched at;
    for (const auto word : {xy(0, 0), xy(8, 0), xy(0, 8)}) at.device.vertex(word, 100 << 12, 0, 0);
    at.device.gp0(Words{0x200000ff, xy(0, 0), xy(8, 0), xy(0, 8)});
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    CHECK(at.frames[0].words.size() > 4);
    CHECK((at.frames[0].words[0] >> 24) >= 0xe7);
    CHECK((at.frames[0].words[0] >> 24) <= 0xef);
  }

  TEST_CASE("A frame travels whole") {
    Watched at;
    at.square(0);
    at.show(256);
    REQUIRE(at.frames.size() == 1);
    auto frame = at.frames[0];
    frame.doubtful = 7;
    frame.is_recording = true;
    frame.lint = {{"loop", "123000h", "it loops"}};
    const auto read = door::live_frame_of(door::to_bytes(frame));
    REQUIRE(read);
    CHECK(read->number == frame.number);
    CHECK(read->doubtful == 7);
    CHECK(read->is_recording);
    CHECK(read->state == frame.state);
    CHECK(read->words == frame.words);
    CHECK(read->lint == frame.lint);
    REQUIRE(read->runs.size() == frame.runs.size());
    CHECK(read->runs[0].words == frame.runs[0].words);
  }

  TEST_CASE("A frame that is cut short or contradicts itself is refused") {
    door::LiveFrame frame;
    frame.runs = {{.words = 2}};
    frame.words = {1, 2};
    const auto bytes = door::to_bytes(frame);
    REQUIRE(door::live_frame_of(bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      CAPTURE(size);
      CHECK_FALSE(door::live_frame_of(std::span(bytes).first(size)));
    }
    frame.words.push_back(3);
    CHECK_FALSE(door::live_frame_of(door::to_bytes(frame)));
    frame.words = {1, 2};
    frame.runs[0].is_control = true;
    CHECK_FALSE(door::live_frame_of(door::to_bytes(frame)));
  }
}
