#include "dump/frames.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace {

using dump::FrameBy;
using dump::PacketType;
using Words = std::vector<std::uint32_t>;

const Words triangle{0x200000ff, 0x00000000, 0x00000010, 0x00100000};
const Words upload{0xa0000000, 0x00000000, 0x00010002, 0x00000000};

/// A dump told in letters: d draws, f fills, u uploads, v VSync, m the trace_begin mark, 0..9 GP1(05h) of
/// that row.
dump::Dump dump_of(const char* letters) {
  dump::Dump dump;
  for (; *letters != '\0'; ++letters) {
    switch (*letters) {
      case 'd':
        dump.add(PacketType::port0, triangle);
        break;
      case 'f':
        dump.add(PacketType::port0, Words{0x02000000, 0, 0x00100010});
        break;
      case 'u':
        dump.add(PacketType::port0, upload);
        break;
      case 'v':
        dump.add(PacketType::vsync);
        break;
      case 'm':
        dump.add(PacketType::trace_begin);
        break;
      default:
        dump.add(PacketType::port1, Words{0x05000000U | static_cast<std::uint32_t>(*letters - '0') << 10});
    }
  }
  return dump;
}

std::vector<std::size_t> ends(const char* letters, FrameBy by = FrameBy::display) {
  const dump::Frames frames(dump_of(letters), by);
  std::vector<std::size_t> list;
  for (std::uint64_t n = 1; n <= frames.count(); ++n) list.push_back(frames.end(n));
  return list;
}

using Ends = std::vector<std::size_t>;

}  // namespace

TEST_SUITE("dump") {
  TEST_CASE("a frame that goes on over a VSync is one frame where the display did not change") {
    CHECK(ends("0mdvdv") == Ends{6});
    CHECK(ends("0mdv2dvdv0dv2v") == Ends{5, 10, 14});
  }

  TEST_CASE("by vsync every VSync ends a frame, and what follows the last is in none") {
    CHECK(ends("0mdvdv", FrameBy::vsync) == Ends{4, 6});
    CHECK(ends("dvd", FrameBy::vsync) == Ends{2});
    CHECK(ends("dd", FrameBy::vsync) == Ends{2});
  }

  TEST_CASE("a frame keeps the VSyncs between the word that shows it and the next drawing") {
    CHECK(ends("0md0vvd1vd0v") == Ends{6, 9, 12});
  }

  TEST_CASE(
      "the first word that shows something ends the first frame, though the display stood there before") {
    CHECK(ends("0md0vd1vd0v") == Ends{5, 8, 11});
  }

  TEST_CASE("in a dump that never shows a second buffer every word that shows one ends a frame") {
    CHECK(ends("0md0vd0vd0v") == Ends{5, 8, 11});
  }

  TEST_CASE("where nothing is shown a VSync ends a frame if a fill begins the next one") {
    CHECK(ends("mfdvfdvvfdvd") == Ends{4, 8, 12});
    CHECK(ends("mfdvdvfdv") == Ends{6, 9});
    CHECK(ends("fdvfdvfd0vd1v") == Ends{10, 13});  // but not where a word shows a buffer
  }

  TEST_CASE("telling the display again what it shows ends nothing where there are two buffers") {
    CHECK(ends("md1vdv1dv0dv0dv1v") == Ends{4, 10, 17});
  }

  TEST_CASE("set-up ends no frame: before the mark, or without one before a VSync or a primitive") {
    CHECK(ends("u0u1md0vd1v") == Ends{8, 11});
    CHECK(ends("u0u1d0vd1v") == Ends{7, 10});
    CHECK(ends("0vu1vu0v") == Ends{5, 8});
  }

  TEST_CASE("what is drawn after the last shown frame is a frame of its own") {
    CHECK(ends("md0vd1vd") == Ends{4, 7, 8});
  }

  TEST_CASE("a dump without a command is one frame") {
    CHECK(ends("") == Ends{0});
    CHECK(ends("0v1v") == Ends{4});
  }

  TEST_CASE("a packet belongs to the frame it lies in") {
    const dump::Frames frames(dump_of("md0vd1v"));
    CHECK(frames.begin(1) == 0);
    CHECK(frames.begin(2) == 4);
    CHECK(frames.of_packet(0) == 1);
    CHECK(frames.of_packet(3) == 1);
    CHECK(frames.of_packet(4) == 2);
    CHECK(frames.of_packet(7) == 3);
  }

  TEST_CASE("packets that come one by one end the frames that they end together") {
    for (const char* letters : {"0mdv2dvdv0dv2v", "0md0vvd1vd0v", "md1vdv1dv0dv0dv1v", "u0u1md0vd1v",
                                "md0vd0vd0vd1vd0v", "md0vd1vd", "0vu1vu0v", "d0vd0vmd0vd0v", "d0vd0vd0vd0",
                                "dvdvdv", "mfdvfdvvfdvd", "fdvfdvfd0vd1v", ""}) {
      CAPTURE(letters);
      const auto whole = dump_of(letters);
      dump::Frames frames(FrameBy::display);
      dump::Dump part;
      std::vector<std::size_t> told;
      bool was_settled = false;
      const auto take = [&](dump::Frames::Rest rest) {
        const bool holds = frames.extend(part, rest);
        CHECK((holds || !was_settled));
        if (!holds) told.clear();
        // What was told before stays, but for the last end, which may move back.
        for (std::size_t n = 0; n < told.size(); ++n) {
          REQUIRE(n < frames.count());
          CHECK((frames.end(n + 1) == told[n] ||
                 (n + 1 == told.size() && rest != dump::Frames::Rest::to_come)));
        }
        told.clear();
        for (std::uint64_t n = 1; n <= frames.count(); ++n) told.push_back(frames.end(n));
        was_settled = frames.is_settled();
      };
      for (const auto& packet : whole.packets) {
        part.add(packet.type, whole.payload(packet));
        take(dump::Frames::Rest::to_come);
      }
      take(dump::Frames::Rest::nothing);
      CHECK(told == ends(letters));
      for (std::size_t n = 0; n < whole.packets.size(); ++n)
        CHECK(frames.ends_with(n) == (std::ranges::find(told, n + 1) != told.end()));
    }
  }

  TEST_CASE("a second buffer, shown for the first time, takes back what its absence had made frames") {
    dump::Dump dump = dump_of("md0vd0vd0vd");
    dump::Frames frames(FrameBy::display);
    CHECK(frames.extend(dump, dump::Frames::Rest::to_come));
    CHECK(frames.count() == 3);
    CHECK_FALSE(frames.is_settled());
    dump.add(PacketType::port1, Words{0x05000400});
    dump.add(PacketType::port0, triangle);
    CHECK_FALSE(frames.extend(dump, dump::Frames::Rest::to_come));
    CHECK(frames.count() == 2);
    CHECK(frames.is_settled());
  }

  TEST_CASE("of a damaged dump the frames that were ended count, or else what a VSync ended") {
    const auto lost = [](const char* letters) {
      dump::Frames frames(FrameBy::display);
      frames.extend(dump_of(letters), dump::Frames::Rest::lost);
      std::vector<std::size_t> list;
      for (std::uint64_t n = 1; n <= frames.count(); ++n) list.push_back(frames.end(n));
      return list;
    };
    CHECK(lost("md0vd1vd") == Ends{4, 7});
    CHECK(lost("md0vd1") == Ends{4, 6});
    CHECK(lost("dvdvd") == Ends{4});
    CHECK(lost("fdvfdvf") == Ends{3, 6});
    CHECK(lost("d").empty());
  }
}
