// A slice replays to the pixels it was made for, and holds no more than they depend on.

#include "debug/slice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "debug/slice_writer.h"
#include "streams.h"
#include "tests/amount.h"
#include "tests/vectors.h"

namespace {

using debug::Recording, debug::whole_frame;
using dump::PacketType;
using tests::Timeline, tests::Words, tests::xy;

constexpr std::uint32_t at(int x, int y) { return static_cast<std::uint32_t>(y * gpu::Vram::width + x); }

/// One frame.
dump::Dump frame_of(const std::vector<Words>& commands) {
  dump::Dump dump;
  for (const auto& words : commands) dump.add(PacketType::port0, words);
  dump.add(PacketType::vsync);
  dump.vsyncs = 1;
  return dump;
}

Words fill(std::uint32_t colour, int x, int y, int w, int h) {
  return {0x02000000 | colour, xy(x, y), xy(w, h)};
}

/// An upload of w x h pixels, each `value`.
Words upload(int x, int y, int w, int h, std::uint32_t value) {
  Words words{0xa0000000, xy(x, y), xy(w, h)};
  for (int n = 0; n < (w * h + 1) / 2; ++n) words.push_back(value | value << 16);
  return words;
}

base::Result<debug::Slice> slice_of(const dump::Dump& dump, std::uint64_t frame,
                                    const std::vector<std::uint32_t>& pixels) {
  Timeline timeline{Recording(dump)};
  return debug::slice(timeline, frame, pixels);
}

std::string kept(const base::Result<debug::Slice>& slice) {
  std::string text;
  for (const auto& number : slice->kept) text += debug::to_text(number) + " ";
  return text;
}

}  // namespace

TEST_SUITE("debug") {
  TEST_CASE("what was drawn over, and what lies beside, is not in a slice") {
    const auto dump = frame_of({tests::everywhere, fill(0xff, 0, 0, 64, 64), fill(0xff00, 0, 0, 64, 64),
                                fill(0xff0000, 64, 0, 64, 64)});
    const auto slice = slice_of(dump, 1, {at(5, 5)});
    REQUIRE(slice);
    CHECK(kept(slice) == "1:4 ");
  }

  TEST_CASE("what is blended depends on what it was blended with, and what is opaque does not") {
    const std::vector<Words> commands{tests::everywhere,
                                      fill(0x808080, 0, 0, 64, 64),
                                      {0x62404040, xy(0, 0), xy(32, 32)},
                                      {0x60202020, xy(16, 0), xy(32, 32)}};
    const auto dump = frame_of(commands);
    CHECK(kept(slice_of(dump, 1, {at(5, 5)})) == "1:3 1:4 ");
    CHECK(kept(slice_of(dump, 1, {at(20, 5)})) == "1:5 ");
    CHECK(kept(slice_of(dump, 1, {at(5, 5), at(20, 5)})) == "1:3 1:4 1:5 ");
  }

  TEST_CASE("of an upload only the texels that the pixels show are sent, where they were") {
    const auto dump = frame_of({tests::everywhere,
                                upload(512, 0, 64, 64, 0x1234),
                                {0xe1000108},
                                {0x65808080, xy(0, 0), 0x00000000, xy(64, 64)}});
    const auto one = slice_of(dump, 1, {at(5, 7)});
    REQUIRE(one);
    CHECK(kept(one) == "1:3 1:5 ");
    CHECK(one->upload_pixels == 1);
    std::vector<std::uint32_t> square;
    for (int y = 8; y < 12; ++y)
      for (int x = 16; x < 24; ++x) square.push_back(at(x, y));
    CHECK(slice_of(dump, 1, square)->upload_pixels == 32);
  }

  TEST_CASE("of a palette only the entries that the pixels show are sent") {
    Words texels = upload(512, 0, 1, 1, 0);
    texels[3] = 0x00004321;  // four texels: entries 1, 2, 3, 4
    Words palette = upload(0, 480, 16, 1, 0);
    for (std::uint32_t n = 0; n < 8; ++n) palette[3 + n] = (2 * n + 1) | (2 * n + 2) << 16;
    const auto dump = frame_of(
        {tests::everywhere, texels, palette, {0xe1000008}, {0x65808080, xy(0, 0), 480U << 22, xy(4, 1)}});
    const auto slice = slice_of(dump, 1, {at(2, 0)});
    REQUIRE(slice);
    CHECK(kept(slice) == "1:3 1:4 1:6 ");
    CHECK(slice->upload_pixels == 2);  // the halfword with the index, and entry 3
  }

  TEST_CASE("a palette that was cached before it changed in VRAM is loaded where it was loaded") {
    const auto sprite = [](int x) { return Words{0x65808080, xy(x, 0), 480U << 22, xy(4, 1)}; };
    const auto dump = frame_of({tests::everywhere,
                                upload(512, 0, 1, 1, 0x1111),
                                upload(0, 480, 16, 1, 0x7fff),
                                {0xe1000008},
                                sprite(0),
                                upload(0, 480, 16, 1, 0x001f),
                                sprite(8)});
    const auto slice = slice_of(dump, 1, {at(9, 0)});
    REQUIRE(slice);
    CHECK(kept(slice) == "1:3 1:4 1:6 1:8 ");  // the first sprite loads it; the later upload is not seen
  }

  TEST_CASE("a hole that lets a pixel be depends on the texel that is none") {
    const auto dump = frame_of({tests::everywhere,
                                upload(512, 0, 8, 8, 0),
                                fill(0xff, 0, 0, 16, 16),
                                upload(512, 4, 8, 4, 0x7c00),
                                {0xe1000108},
                                {0x65808080, xy(0, 0), 0, xy(8, 8)}});
    // Above the hole shows red; the sprite matters only below, and there its texels for both.
    CHECK(kept(slice_of(dump, 1, {at(2, 2)})) == "1:4 ");
    CHECK(kept(slice_of(dump, 1, {at(2, 2), at(2, 6)})) == "1:3 1:4 1:5 1:7 ");
  }

  TEST_CASE("copies are followed to where they came from, smears and all") {
    const auto dump = frame_of({tests::everywhere,
                                fill(0xff, 0, 0, 16, 1),
                                fill(0xff00, 0, 4, 16, 1),
                                {0x80000000, xy(0, 0), xy(0, 1), xy(4, 3)},
                                {0x80000000, xy(0, 4), xy(100, 0), xy(4, 1)}});
    CHECK(kept(slice_of(dump, 1, {at(1, 3)})) == "1:3 1:5 ");  // row 3 is row 0, copied three times
    CHECK(kept(slice_of(dump, 1, {at(101, 0)})) == "1:4 1:6 ");
  }

  TEST_CASE("a pixel that the mask bit protected depends on what set it") {
    const auto dump = frame_of({tests::everywhere,
                                {0xe6000001},
                                {0x600000ff, xy(0, 0), xy(8, 8)},
                                {0xe6000002},
                                {0x6000ff00, xy(0, 0), xy(16, 16)}});
    CHECK(kept(slice_of(dump, 1, {at(2, 2)})) == "1:4 ");
    CHECK(kept(slice_of(dump, 1, {at(2, 2), at(10, 10)})) == "1:4 1:6 ");
  }

  TEST_CASE("a frame that leaves everything as it was is not looked at") {
    dump::Dump dump;
    dump.add(PacketType::port0, tests::everywhere);
    dump.add(PacketType::port0, upload(512, 0, 8, 8, 0x1234));
    for (int n = 0; n < 50; ++n) {
      dump.add(PacketType::port0, fill(0x10, 0, 0, 64, 64));
      dump.add(PacketType::port0, Words{0xe1000108, 0x65808080, xy(0, 0), 0, xy(8, 8)});
      dump.add(PacketType::vsync);
    }
    const auto slice = slice_of(dump, 50, {at(1, 1)});
    REQUIRE(slice);
    CHECK(kept(slice) == "1:3 50:3 ");
    CHECK(slice->frames_looked_at == 2);
  }

  TEST_CASE("the rest of an upload that began in the frame before is in the slice") {
    dump::Dump dump;
    auto words = upload(0, 0, 4, 2, 0x1111);
    dump.add(PacketType::port0, std::span(words).first(5));
    dump.add(PacketType::vsync);
    dump.add(PacketType::port0, std::span(words).subspan(5));
    dump.add(PacketType::vsync);
    CHECK(kept(slice_of(dump, 2, {at(0, 1)})) == "2:0 ");
    CHECK(kept(slice_of(dump, 2, {at(0, 0)})) == "1:1 ");
  }

  TEST_CASE("a list over a picture: what was there before is sent first") {
    debug::RamImage image;
    image.head = 0x1000;
    image.ram.write(0x1000, 0x03ffffff);
    image.ram.write(0x1004, 0x620000ff);
    image.ram.write(0x1008, xy(0, 0));
    image.ram.write(0x100c, xy(8, 8));
    auto recording =
        Recording::of_list(std::move(image), std::vector<std::uint16_t>(gpu::Vram::size, 0x4210));
    REQUIRE(recording);
    Timeline timeline(std::move(*recording));
    const auto slice = debug::slice(timeline, 1, std::vector{at(3, 3)});
    REQUIRE(slice);
    CHECK(slice->upload_pixels == 1);
    CHECK(kept(slice) == "1:1 ");
  }

  TEST_CASE("whatever was sent: the slice of any pixels replays to them") {
    std::uint64_t commands = 0, kept_commands = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
      CAPTURE(seed);
      const auto dump = tests::random_dump(seed, 3, 40);
      Timeline timeline{Recording(dump)};
      tests::Random random(seed);
      const std::uint64_t frame = 1 + random.below(static_cast<std::uint32_t>(timeline.frames()));
      std::vector<std::uint32_t> pixels;
      for (int n = 0; n < 3; ++n) pixels.push_back(at(random.between(0, 255), random.between(0, 255)));
      const auto slice = debug::slice(timeline, frame, pixels);  // compares the pixels itself
      CAPTURE(slice ? "" : slice.error().text.c_str());
      REQUIRE(slice);
      for (std::uint64_t f = 1; f <= frame; ++f) commands += timeline.commands_in(f);
      kept_commands += slice->kept.size();
      gpu::Gpu alone;
      dump::replay(slice->dump, alone);
      const auto& whole = timeline.seek({frame, whole_frame});
      for (const auto pixel : pixels) CHECK(alone.vram().pixels()[pixel] == whole.vram().pixels()[pixel]);
    }
    CHECK(kept_commands < commands / 2);
  }

  TEST_CASE("ten pixels of each program: a slice of a few hundred bytes replays to each") {
    const auto folder = tests::vector_path("programs");
    if (!folder) return;
    for (const std::string name : {"flyby", "intro", "cube"}) {
      CAPTURE(name);
      auto recording = Recording::open(*folder / (name + ".psxgpu.zst"));
      REQUIRE(recording);
      Timeline timeline(std::move(*recording));
      REQUIRE(timeline.read_all());
      for (int n = 1; n <= tests::amount(10, 2); ++n) {
        const std::uint64_t frame = 55 + 50 * static_cast<std::uint64_t>(n);
        const auto pixel = at(n * 61 % 240 + 8, n * 37 % 200 + 8);
        const auto slice = debug::slice(timeline, frame, std::vector{pixel});
        CAPTURE(frame);
        REQUIRE(slice);
        CHECK(dump::write_dump(slice->dump, dump::DumpFormat::standard).size() < 1000);
        gpu::Gpu alone;
        dump::replay(slice->dump, alone);
        CHECK(alone.vram().pixels()[pixel] == timeline.seek({frame, whole_frame}).vram().pixels()[pixel]);
      }
    }
  }

  TEST_CASE("an upload is cut into rectangles that hold what is needed, and bridges only what was sent") {
    std::map<std::uint32_t, std::uint16_t> known, needed;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 40; ++x) known[at(x, y)] = static_cast<std::uint16_t>(at(x, y));
    needed[at(1, 1)] = needed[at(4, 1)] = needed[at(2, 2)] = needed[at(30, 1)] = 0;
    auto pieces = debug::cut_upload(needed, known);
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].x == 1);
    CHECK(pieces[0].y == 1);
    CHECK(pieces[0].width == 4);
    CHECK(pieces[0].height() == 2);
    CHECK(pieces[0].pixels[5] == at(2, 2));
    CHECK(pieces[1].x == 30);
    CHECK(pieces[1].pixels.size() == 1);
    known.erase(at(2, 1));
    pieces = debug::cut_upload(needed, known);
    CHECK(pieces.size() == 4);
  }
}
