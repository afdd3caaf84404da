// One frame taken out of a recording, drawn again, changed, and written as a dump.

#include "debug/clip.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "debug/edits.h"
#include "debug/frame_view.h"
#include "debug/timeline.h"
#include "dump/bucket_note.h"
#include "ot/ordering_table.h"
#include "streams.h"

namespace {

using debug::Clip, debug::Edits, debug::FrameView, debug::Recording, debug::whole_frame;
using dump::PacketType;
using tests::Timeline, tests::pixels_of, tests::random_dump, tests::Words, tests::xy;

std::vector<std::uint16_t> played(const Clip& clip) {
  gpu::Gpu gpu;
  debug::play(clip, gpu, {});
  return pixels_of(gpu);
}

/// Red, green and blue squares of 16 pixels, each over the lower right quarter of the one before.
Clip three_squares() {
  dump::Dump dump;
  dump.add(PacketType::port0, tests::everywhere);
  for (int n = 0; n < 3; ++n) {
    dump.add(PacketType::port0, Words{0x60000000 | 0xffU << 8 * n, xy(8 * n, 8 * n), xy(16, 16)});
  }
  dump.add(PacketType::vsync);
  dump.vsyncs = 1;
  Timeline timeline{Recording(std::move(dump))};
  return debug::clip_of(timeline, 1);
}

constexpr std::uint16_t red = 0x001f, green = 0x03e0, blue = 0x7c00;
std::uint16_t at(const std::vector<std::uint16_t>& vram, int x, int y) {
  return vram[static_cast<std::size_t>(y * 1024 + x)];
}

}  // namespace

TEST_SUITE("debug") {
  TEST_CASE("a frame taken out of any recording leaves, drawn alone, what it leaves there") {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
      Timeline timeline{Recording(random_dump(seed, 6, 20))};
      for (std::uint64_t frame = 1; frame <= timeline.frames(); ++frame) {
        CAPTURE(seed);
        CAPTURE(frame);
        const auto clip = debug::clip_of(timeline, frame);
        CHECK(played(clip) == pixels_of(timeline.seek({.frame = frame, .command = whole_frame})));
        std::uint32_t last = 0;
        for (const auto& item : clip.items) last = std::max(last, item.number);
        CHECK(last == timeline.commands_in(frame));
      }
    }
  }

  TEST_CASE("a frame written as a dump is replayed to the same VRAM and shows the same display") {
    Timeline timeline{Recording(random_dump(7, 4, 30))};
    const auto clip = debug::clip_of(timeline, 3);
    std::vector<std::byte> bytes;
    dump::DumpWriter writer(dump::DumpFormat::standard, [&bytes](std::span<const std::byte> more) {
      bytes.insert(bytes.end(), more.begin(), more.end());
    });
    debug::write_clip(clip, writer);
    const auto read = dump::parse_dump(bytes);
    REQUIRE(read.value);
    gpu::Gpu gpu;
    dump::replay(*read.value, gpu);
    CHECK(pixels_of(gpu) == played(clip));
    const auto& there = timeline.seek({.frame = 3, .command = whole_frame});
    CHECK(gpu.display().start == there.display().start);
  }

  TEST_CASE("a list in RAM gives its commands with the addresses of their tags and their buckets") {
    ot::MainRam ram(ot::RamSize::mib2);
    ot::OrderingTable table(ram, 0x1000, 4);
    table.clear();
    const auto node = [&](std::uint32_t address, std::uint32_t bucket, const Words& words) {
      ram.write(address, ot::tag::make(0, static_cast<std::uint32_t>(words.size())));
      for (std::size_t n = 0; n < words.size(); ++n)
        ram.write(address + 4 + 4 * static_cast<std::uint32_t>(n), words[n]);
      table.insert(bucket, address);
    };
    node(0x2000, 1, {0x600000ff, xy(0, 0), xy(4, 4)});
    node(0x3000, 3, {0xe1000000, 0x6000ff00, xy(0, 0), xy(4, 4)});
    const auto clip = debug::clip_of_list(ram, table.head(), inspect::TableRange{0x1000, 4}, {});
    REQUIRE(clip.items.size() == 3);
    CHECK(clip.items[0].origin == "003000h");
    CHECK(clip.items[1].bucket == 3);
    CHECK(clip.items[1].number == 2);
    CHECK(clip.items[2].address == 0x2000);
    CHECK(clip.items[2].bucket == 1);
  }

  TEST_CASE("a hidden command is not drawn, one that is alone is all that is drawn") {
    const auto clip = three_squares();
    REQUIRE(clip.items.size() == 5);
    const auto all = played(clip);
    CHECK(at(all, 0, 0) == red);
    CHECK(at(all, 8, 8) == green);
    CHECK(at(all, 16, 16) == blue);
    const auto without = played(debug::apply(clip, {.hidden = {3}}).clip);
    CHECK(at(without, 8, 8) == red);
    CHECK(at(without, 16, 16) == blue);
    const auto alone = played(debug::apply(clip, {.solo = {2}}).clip);
    CHECK(at(alone, 8, 8) == red);
    CHECK(at(alone, 20, 20) == 0);
  }

  TEST_CASE("a hidden polygon still sets the texture page of what comes after it") {
    // A textured triangle with page 640,256 in 8 bits, then a sprite, which takes the page as it is.
    Clip clip;
    clip.items.push_back(
        {.number = 1, .words = {0x24808080, xy(0, 0), 0, xy(8, 0), (0x9aU) << 16, xy(0, 8), 0}});
    clip.items.push_back({.number = 2, .words = {0x64808080, xy(20, 0), 0, xy(8, 8)}});
    gpu::Gpu whole, hidden;
    debug::play(clip, whole, {});
    debug::play(debug::apply(clip, {.hidden = {0}}).clip, hidden, {});
    CHECK(hidden.state().draw_mode == whole.state().draw_mode);
    CHECK(hidden.state().page_x() == 640);
  }

  TEST_CASE("a command moved behind another is drawn after it") {
    const auto clip = three_squares();
    const auto moved = played(debug::apply(clip, {.moves = {{2, 3, true}}}).clip);
    CHECK(at(moved, 8, 8) == red);
    const auto back = played(debug::apply(clip, {.moves = {{2, 3, true}, {2, 3, false}}}).clip);
    CHECK(back == played(clip));
  }

  TEST_CASE("commands keep their numbers, wherever they are moved to") {
    FrameView view(three_squares(), {});
    view.set_edits({.moves = {{4, 2, false}}});
    std::vector<std::uint64_t> numbers;
    for (const auto& draw : view.trace().draws) numbers.push_back(debug::number_of(1, draw).command);
    CHECK(numbers == std::vector<std::uint64_t>{5, 3, 4});  // blue before red and green
  }

  TEST_CASE("a command linked into another bucket is drawn first of that bucket") {
    auto clip = three_squares();
    clip.buckets = 10;
    for (std::size_t n = 0; n < 3; ++n) clip.items[2 + n].bucket = static_cast<std::uint32_t>(9 - n);
    const auto edited = debug::apply(clip, {.buckets = {{4, 8}}});
    REQUIRE(edited.origin.size() == 5);
    CHECK(edited.origin[3] == 4);  // blue before green, which is in bucket 8 too
    CHECK(edited.origin[4] == 3);
  }

  TEST_CASE("a vertex and a colour of every shape are where the words say") {
    tests::RandomCommands random(3);
    for (int n = 0; n < 500; ++n) {
      const debug::Item item{.number = 1, .words = random.command()};
      Clip clip;
      clip.items = {item};
      gpu::Trace trace;
      gpu::Gpu gpu;
      debug::play(clip, gpu, {.trace = &trace});
      if (trace.draws.size() != 1) continue;
      const auto& drawn = trace.draws[0];
      const auto corners = debug::vertex_words(item);
      CHECK(corners.size() == drawn.vertex_count);
      if (drawn.kind > gpu::Kind::line) continue;
      for (std::size_t v = 0; v < corners.size(); ++v) {
        const auto corner = debug::corner_of(item.words[corners[v]]);
        CHECK(corner.x == drawn.vertices[v].x);
        CHECK(corner.y == drawn.vertices[v].y);
      }
      const auto colours = debug::colour_words(item);
      const std::size_t wanted =
          drawn.kind == gpu::Kind::rectangle || !drawn.is_gouraud() ? 1 : drawn.vertex_count;
      CHECK(colours.size() == wanted);
      for (std::size_t v = 0; v < colours.size(); ++v) {
        CHECK((item.words[colours[v]] & 0xff) == drawn.vertices[v].r);
      }
    }
  }

  TEST_CASE("a moved corner keeps the other bits of its word and stays within 11 bits") {
    const auto word = debug::with_corner(0xf800f800, {-3, 1023});
    CHECK(debug::corner_of(word).x == -3);
    CHECK(debug::corner_of(word).y == 1023);
    CHECK((word & 0xf800f800) == 0xf800f800);
    CHECK(debug::corner_of(debug::with_corner(0, {5000, -5000})).x == 1023);
    CHECK(debug::corner_of(debug::with_corner(0, {5000, -5000})).y == -1024);
  }
}

TEST_SUITE("debug") {
  TEST_CASE("a row tells the pixels that its command wrote and those still seen") {
    FrameView view(three_squares(), {});
    REQUIRE(view.rows().size() == 5);
    CHECK(view.rows()[2].written == 256);
    CHECK(view.rows()[2].seen == 192);  // a quarter lies under the green one
    CHECK(view.rows()[4].seen == 256);
    CHECK(view.row_at(8 * 1024 + 8) == 3);
    CHECK_FALSE(view.row_at(100 * 1024 + 100));
    CHECK(view.pixels_of(view.rows()[3]).size() == 256);
  }

  TEST_CASE("VRAM after so many rows is what a GPU holds that was sent so many") {
    for (std::uint32_t seed = 20; seed < 26; ++seed) {
      Timeline timeline{Recording(random_dump(seed, 3, 25))};
      const auto clip = debug::clip_of(timeline, 2);
      const FrameView view(clip, {});
      for (std::size_t count = 0; count <= clip.items.size(); count += 3) {
        CAPTURE(seed);
        CAPTURE(count);
        auto part = clip;
        part.items.resize(count);
        CHECK(view.vram_after(count) == played(part));
      }
    }
  }

  TEST_CASE("filters leave what they say") {
    FrameView view(three_squares(), {.frame = 7});
    const auto count = [&view](const debug::Filter& filter) { return view.filtered(filter).size(); };
    CHECK(count({}) == 5);
    CHECK(count({.only_drawing = true}) == 3);
    CHECK(count({.kind = gpu::Kind::rectangle}) == 3);
    CHECK(count({.kind = gpu::Kind::polygon}) == 0);
    CHECK(count({.text = "RECTANGLE"}) == 3);
    CHECK(count({.text = "7:4"}) == 1);
    CHECK(count({.blend = gpu::Blend::opaque}) == 3);
    CHECK(count({.rectangle = inspect::Rectangle{9, 9, 1, 1}}) == 2);
    CHECK(count({.rectangle = inspect::Rectangle{500, 9, 1, 1}}) == 0);
    CHECK(count({.page = 5}) == 0);
    view.set_edits({.hidden = {4}});
    CHECK(count({.only_seen = true}) == 2);
    CHECK_FALSE(view.row_of_item(4));
  }

  TEST_CASE("a command that draws nothing says why") {
    Clip clip;
    clip.items.push_back({.number = 1, .words = {0x20ffffff, xy(0, 0), xy(0, 0), xy(0, 0)}});
    const FrameView view(clip, {});
    CHECK(view.rows()[0].fault.starts_with("no-area"));
    CHECK(view.filtered({.only_faulty = true}).size() == 1);
  }

  TEST_CASE("a list without buckets falls into groups where the state changes or something is uploaded") {
    dump::Dump dump;
    const Words square{0x600000ff, xy(0, 0), xy(4, 4)};
    dump.add(PacketType::port0, tests::everywhere);
    dump.add(PacketType::port0, square);
    dump.add(PacketType::port0, square);
    dump.add(PacketType::port0, Words{0xe1000001});
    dump.add(PacketType::port0, Words{0xa0000000, xy(9, 9), xy(1, 1), 7});
    dump.add(PacketType::port0, square);
    dump.add(PacketType::vsync);
    dump.vsyncs = 1;
    Timeline timeline{Recording(std::move(dump))};
    const FrameView view(debug::clip_of(timeline, 1), {});
    REQUIRE(view.groups().size() == 2);
    CHECK(view.groups()[0].count == 4);
    CHECK(view.groups()[0].text == "2 states, 2 shapes");
    CHECK(view.groups()[1].text == "1 state, 1 fill, copy or upload, 1 shape");
  }

  TEST_CASE("what a program sent becomes commands with the bucket, address and origin of their packets") {
    std::vector<debug::Sent> sent(3);
    sent[0].is_control = true;
    sent[0].words = {0x03000000};
    sent[1].bucket = 5;
    sent[1].address = 0x1000;
    sent[1].origin = "main.c:3/1";
    sent[1].words = {0x60ffffff, xy(0, 0), xy(4, 4), 0x60ff0000, xy(8, 0), xy(4, 4), 0x600000ff};
    sent[2].words = {xy(16, 0), xy(4, 4)};
    const auto items = debug::items_of(sent);
    REQUIRE(items.size() == 4);
    CHECK(items[0].is_control);
    for (const std::size_t i : {1U, 2U, 3U}) {
      CAPTURE(i);
      CHECK(items[i].number == i + 1);
      CHECK(items[i].bucket == 5);
      CHECK(items[i].address == 0x1000);
      CHECK(items[i].origin == "main.c:3/1");
      CHECK(items[i].words.size() == 3);
    }
  }

  TEST_CASE("comments of a recording name the buckets of its commands") {
    dump::Dump dump;
    dump.add(PacketType::port0, tests::everywhere);
    dump.add_text(PacketType::comment, dump::to_text(dump::BucketNote{7, 16}));
    dump.add(PacketType::port0, Words{0x600000ff, xy(0, 0), xy(4, 4)});
    dump.add_text(PacketType::comment, "a comment of somebody else");
    dump.add(PacketType::port0, Words{0x6000ff00, xy(8, 0), xy(4, 4)});
    dump.add_text(PacketType::comment, dump::to_text(dump::BucketNote{}));
    dump.add(PacketType::port0, Words{0x60ff0000, xy(16, 0), xy(4, 4)});
    dump.add(PacketType::vsync);
    dump.vsyncs = 1;
    Timeline timeline{Recording(std::move(dump))};
    CHECK(timeline.recording().buckets() == 16);
    const auto clip = debug::clip_of(timeline, 1);
    CHECK(clip.buckets == 16);
    std::vector<std::uint32_t> buckets;
    for (const auto& item : clip.items) {
      if (item.is_drawing()) buckets.push_back(item.bucket);
    }
    CHECK(buckets == std::vector<std::uint32_t>{7, 7, gpu::no_bucket});
    gpu::Trace trace;
    timeline.watch(1, trace);
    REQUIRE(trace.draws.size() == 3);
    CHECK(trace.draws[0].bucket == 7);
    CHECK(trace.draws[2].bucket == gpu::no_bucket);
  }
}
