// Recordings as sources, and what the commands that debug them do: slice, compare, expect, regress, merge.

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dump/dump.h"
#include "program.h"
#include "tests/vectors.h"

namespace {

using dump::PacketType;
using tests::contents, tests::Folder, tests::is_one_line, tests::mentions;
using Words = std::vector<std::uint32_t>;
using nlohmann::json;

std::string file_of(const dump::Dump& dump) {
  std::string text;
  for (const auto byte : dump::write_dump(dump, dump::DumpFormat::standard))
    text.push_back(static_cast<char>(byte));
  return text;
}

/// Three frames that are shown: a fill of 320 x 240, and a line that moves down; its colour in frame 2.
dump::Dump moving_line(std::uint32_t colour_of_second = 0x00ff00) {
  dump::Dump dump;
  dump.add(PacketType::port1, Words{0x03000000, 0x08000001});
  dump.add(PacketType::port0, Words{0xe3000000, 0xe4000000 | 1023 | 511 << 10});
  for (std::uint32_t f = 0; f < 3; ++f) {
    const std::uint32_t y = 10 + 10 * f, colour = f == 1 ? colour_of_second : 0x00ff00;
    dump.add(PacketType::port0,
             Words{0x02400000, 0, 0x00f00140, 0x40000000 | colour, y << 16, y << 16 | 300});
    dump.add(PacketType::port1, Words{0x05000000});
    dump.add(PacketType::vsync);
  }
  return dump;
}

json parsed(const std::string& text) { return json::parse(text, nullptr, false); }

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("a dump stands where a scene may stand: render, inspect") {
    const Folder folder;
    folder.put("lines.dat", file_of(moving_line()));
    const auto rendered = folder.otter("render lines.dat --frame 2 -o two.png");
    CAPTURE(rendered.err);
    CHECK(rendered.status == 0);
    CHECK(mentions(rendered.out, "two.png: lines.dat frame 2, 320x240, 3 commands"));
    CHECK(folder.otter("replay lines.dat --frame 2 -o two2.png").status == 0);
    CHECK(contents(folder.path / "two.png") == contents(folder.path / "two2.png"));
    const auto inspected = folder.otter("inspect lines.dat --frame 3 --pixel 5,30");
    CHECK(inspected.status == 0);
    CHECK(mentions(inspected.out, "3:2 line wrote 03E0 over 2000"));
    for (const std::string words : {"render lines.dat -o x.png --frame 4", "inspect lines.dat --frame 4"}) {
      const auto refused = folder.otter(words);
      CHECK(refused.status == 2);
      CHECK(is_one_line(refused.err));
    }
    CHECK_FALSE(folder.has("x.png"));
  }

  TEST_CASE("a canvas over more than is displayed shows what is displayed of the frame asked for") {
    const Folder folder;
    dump::Dump dump;
    dump.add(PacketType::port1, Words{0x03000000, 0x08000001});
    dump.add(PacketType::port0, Words{0xe3000000, 0xe4000000 | 1023 | 511 << 10});
    for (std::uint32_t f = 0; f < 3; ++f) {
      dump.add(PacketType::port0, Words{0x60000000U | 0x40U << 8 * f, 16 << 16, 0x00f00140});
      dump.add(PacketType::port1, Words{0x05000000 | 16 << 10});
      dump.add(PacketType::vsync);
    }
    folder.put("three.psxgpu", file_of(dump));
    for (const std::string frame : {"1", "2", "3"}) {
      const auto rendered =
          folder.otter("render three.psxgpu --resolution 2 --frame " + frame + " -o " + frame + ".png");
      CAPTURE(rendered.err);
      CHECK(mentions(rendered.out, "640x480"));
    }
    CHECK(contents(folder.path / "1.png") != contents(folder.path / "2.png"));
    CHECK(contents(folder.path / "1.png") != contents(folder.path / "3.png"));
    CHECK(contents(folder.path / "2.png") != contents(folder.path / "3.png"));
  }

  TEST_CASE("a canvas over a large drawing area is refused where it would take more than the limit") {
    const Folder folder;
    folder.put("lines.psxgpu", file_of(moving_line()));  // draws everywhere: 1024 x 512
    const auto refused = folder.otter("render lines.psxgpu -o x.png --resolution 8 --antialias ssaa-8x8");
    CHECK(refused.status == 2);
    CHECK(is_one_line(refused.err));
    CHECK(mentions(refused.err, "bytes; expected at most"));
    CHECK_FALSE(folder.has("x.png"));
  }

  TEST_CASE("knobs that do nothing for a recording are named in one line") {
    const Folder folder;
    folder.put("lines.psxgpu", file_of(moving_line()));
    const auto rendered = folder.otter("render lines.psxgpu -o x.png --transform float --buckets 64");
    CHECK(rendered.status == 0);
    CHECK(is_one_line(rendered.err));
    CHECK(mentions(rendered.err, "--buckets, --transform"));
    const auto sorted = folder.otter("render lines.psxgpu -o y.png --visibility sorted");
    CHECK(sorted.status == 2);
    CHECK_FALSE(folder.has("y.png"));
  }

  TEST_CASE(
      "a dump that ends inside a frame shows the frames before it, with one line; one without any is "
      "refused") {
    const Folder folder;
    const auto whole = file_of(moving_line());
    folder.put("cut.psxgpu", whole.substr(0, whole.size() - 20));
    const auto rendered = folder.otter("render cut.psxgpu --frame 2 -o two.png");
    CHECK(rendered.status == 0);
    CHECK(is_one_line(rendered.err));
    CHECK(mentions(rendered.err, "the 2 whole frames before it are used"));
    CHECK(folder.otter("render cut.psxgpu --frame 3 -o three.png").status == 2);
    CHECK_FALSE(folder.has("three.png"));
    folder.put("none.psxgpu", whole.substr(0, 70));
    const auto refused = folder.otter("render none.psxgpu -o none.png");
    CHECK(refused.status == 2);
    CHECK(is_one_line(refused.err));
    CHECK_FALSE(folder.has("none.png"));
  }

  TEST_CASE("every seed, whole, cut and garbled, is opened or refused in one line") {
    const Folder folder;
    int opened = 0, refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(OTTER_SEEDS "/dump")) {
      const auto seed = contents(entry.path());
      for (int damage = 0; damage < 4; ++damage) {
        auto bytes = seed;
        if (damage == 1) bytes.resize(bytes.size() * 2 / 3);
        if (damage == 2) bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
        if (damage == 3) bytes[bytes.size() - 5] = static_cast<char>(0xa5);
        folder.put("seed", bytes);
        const auto inspected = folder.otter("inspect seed --frame 1 --pixel 0,0");
        CAPTURE(entry.path().filename().string());
        CAPTURE(damage);
        CAPTURE(inspected.err);
        CHECK((inspected.status == 0 || inspected.status == 2));
        CHECK((inspected.err.empty() || is_one_line(inspected.err)));
        ++(inspected.status == 0 ? opened : refused);
      }
    }
    CHECK(opened > 0);
    CHECK(refused > 0);
  }

  TEST_CASE("replay --list and --until know commands by F:K") {
    const Folder folder;
    folder.put("lines.psxgpu", file_of(moving_line()));
    const auto listed = folder.otter("replay lines.psxgpu --list --until 2:1");
    CHECK(listed.status == 0);
    CHECK(mentions(listed.out, " 1:1 GP1 "));
    CHECK(mentions(listed.out, " 2:1 GP0 "));
    CHECK_FALSE(mentions(listed.out, " 2:2 "));
    const auto as_json = parsed(folder.otter("replay lines.psxgpu --list --json").out);
    REQUIRE_FALSE(as_json.is_discarded());
    CHECK(as_json["schema"] == "otter.list/1");
    REQUIRE(as_json["commands"].size() == 13);
    const auto& line = as_json["commands"][5];
    CHECK(line["number"] == "1:6");
    CHECK(line["drawing"] == 2);
    CHECK(line["pixels"] == 301);
    CHECK(line["words"][0] == "4000FF00h");
    CHECK(line["state"]["area"] == json{0, 0, 1023, 511});
    CHECK(line["origin"] == nullptr);
    CHECK(folder.otter("replay lines.psxgpu --until 2:1 --vram a.bin").status == 0);
    CHECK(folder.otter("replay lines.psxgpu --until 3 --vram b.bin").status == 0);
    CHECK(contents(folder.path / "a.bin") == contents(folder.path / "b.bin"));
    for (const std::string until : {"2:4", "4:1", "2:0", "0:1", "2:", "x"}) {
      CAPTURE(until);
      const auto refused = folder.otter("replay lines.psxgpu --until " + until);
      CHECK(refused.status == 2);
      CHECK(is_one_line(refused.err));
    }
  }

  TEST_CASE("--expect finds the one line that is wrong: its kind, its command, both values, its history") {
    const Folder folder;
    folder.put("right.psxgpu", file_of(moving_line()));
    folder.put("wrong.psxgpu", file_of(moving_line(0x0000ff)));
    REQUIRE(folder.otter("replay right.psxgpu --frame 2 --vram right.bin -o right.png").status == 0);
    REQUIRE(folder.otter("replay right.psxgpu --frame 2 --vram right-vram.png").status == 0);
    CHECK(folder.otter("replay right.psxgpu --frame 2 --expect right.bin").status == 0);
    for (const std::string file : {"right.bin", "right.png", "right-vram.png"}) {
      CAPTURE(file);
      const auto found = folder.otter("replay wrong.psxgpu --frame 2 --difference red.png --expect " + file);
      CHECK(found.status == 1);
      CHECK(mentions(found.out, ": 301 pixels differ") == false);
      CHECK(mentions(found.out, "301 of "));
      CHECK(mentions(found.out, "line       2:2"));
      CHECK(
          mentions(found.out, file == "right.bin" ? "is 001F, expected 03E0" : "is FF0000, expected 00FF00"));
      CHECK(mentions(found.out, "2:1 fill wrote 2000 over"));
      CHECK(mentions(found.out, "2:2 line wrote 001F over 2000"));
      CHECK(folder.has("red.png"));
    }
    const auto report = parsed(folder.otter("replay wrong.psxgpu --frame 2 --expect right.bin --json").out);
    REQUIRE_FALSE(report.is_discarded());
    CHECK(report["schema"] == "otter.expect/1");
    CHECK(report["different"] == 301);
    CHECK(report["kinds"][0]["kind"] == "line");
    CHECK(report["kinds"][0]["first"] == "2:2");
  }

  TEST_CASE("--mask leaves out what is not white, and a picture of another size is refused") {
    const Folder folder;
    folder.put("right.psxgpu", file_of(moving_line()));
    folder.put("wrong.psxgpu", file_of(moving_line(0x0000ff)));
    folder.put("black.psxgpu", file_of({}));
    REQUIRE(folder.otter("replay right.psxgpu --frame 2 --vram right.bin").status == 0);
    REQUIRE(folder.otter("replay black.psxgpu --vram black.png").status == 0);
    CHECK(folder.otter("replay wrong.psxgpu --frame 2 --expect right.bin --mask black.png").status == 0);
    REQUIRE(folder.otter("replay right.psxgpu -o small.png").status == 0);
    const auto refused = folder.otter("replay wrong.psxgpu --expect right.bin --mask small.png");
    CHECK(refused.status == 2);
    CHECK(is_one_line(refused.err));
  }

  TEST_CASE("--expect-frames stops at the first frame that differs and names its command") {
    const Folder folder;
    folder.put("right.psxgpu", file_of(moving_line()));
    folder.put("wrong.psxgpu", file_of(moving_line(0x0000ff)));
    std::filesystem::create_directories(folder.path / "frames");
    for (const std::string n : {"1", "2", "3"})
      REQUIRE(folder.otter("replay right.psxgpu --frame " + n + " --vram frames/frame-00000" + n + ".bin")
                  .status == 0);
    const auto good = folder.otter("replay right.psxgpu --expect-frames frames");
    CHECK(good.status == 0);
    CHECK(mentions(good.out, "3 frames as expected"));
    const auto bad = folder.otter("replay wrong.psxgpu --expect-frames frames");
    CHECK(bad.status == 1);
    CHECK(mentions(bad.out, "frame-000002.bin: 301 of 524288 pixels differ"));
    CHECK(mentions(bad.out, "2:2"));
    CHECK(folder.otter("replay right.psxgpu --expect-frames .").status == 2);
  }

  TEST_CASE("a command has one number in every tool, whatever ends frames") {
    const Folder folder;
    // Two VSyncs a frame and two buffers: six frames by VSync, three by the display.
    dump::Dump dump;
    dump.add(PacketType::port1, Words{0x03000000, 0x08000001});
    dump.add(PacketType::port0, Words{0xe3000000, 0xe4000000 | 1023 | 511 << 10});
    for (std::uint32_t f = 0; f < 3; ++f) {
      const std::uint32_t top = f % 2 == 0 ? 0 : 256;
      dump.add(PacketType::port0, Words{0x02400000, top << 16, 0x00f00140});
      dump.add(PacketType::vsync);
      dump.add(PacketType::port0,
               Words{0x4000ff00, (top + 10 + 10 * f) << 16, (top + 10 + 10 * f) << 16 | 300});
      dump.add(PacketType::port1, Words{0x05000000 | top << 10});
      dump.add(PacketType::vsync);
    }
    folder.put("two.psxgpu", file_of(dump));
    struct Way {
      std::string words, number, frames, first_line;
      const char* last;  // frame
    };
    for (const Way& way :
         {Way{"", "3:2", "1..3", "2:2", "3"}, Way{" --frame-by vsync", "6:1", "1..6", "4:1", "6"}}) {
      CAPTURE(way.words);
      const auto listed = folder.otter("replay two.psxgpu --list" + way.words);
      CHECK(mentions(listed.out, " " + way.number + " GP0      #6 "));
      const auto inspected =
          folder.otter("inspect two.psxgpu --pixel 5,30 --frame " + std::string(way.last) + way.words);
      CHECK(mentions(inspected.out, way.number + " line wrote"));
      const auto sliced = folder.otter("slice two.psxgpu --pixel 5,30 -o s.psxgpu --frame " +
                                       std::string(way.last) + way.words);
      CHECK(mentions(sliced.out, way.number));
      folder.put("black.bin", std::string(std::size_t{1} << 20, '\0'));
      const auto blamed = folder.otter("replay two.psxgpu --expect black.bin" + way.words);
      CHECK(blamed.status == 1);
      CHECK(mentions(blamed.out, way.first_line + " "));  // the one before it was drawn over
      for (const std::string command :
           {"render -o x.png", "effects", "cost", "inspect", "slice --pixel 0,0 -o x.psxgpu"}) {
        CAPTURE(command);
        const auto space = command.find(' ');
        const auto refused =
            folder.otter(command.substr(0, space) + " two.psxgpu --frame 7" +
                         (space == std::string::npos ? "" : command.substr(space)) + way.words);
        CHECK(refused.status == 2);
        CHECK(mentions(refused.err, way.frames));
      }
    }
    // --frame of replay alone counts VSyncs, unless it is told otherwise.
    CHECK(folder.otter("replay two.psxgpu --frame 6 --vram a.bin").status == 0);
    CHECK(folder.otter("replay two.psxgpu --frame 3 --frame-by display --vram b.bin").status == 0);
    CHECK(contents(folder.path / "a.bin") == contents(folder.path / "b.bin"));
    const auto half = folder.otter("replay two.psxgpu --frame 5 --list");
    CHECK(mentions(half.out, " 3:1 GP0      #5 "));
    CHECK_FALSE(mentions(half.out, " 3:2 GP0"));
  }

  TEST_CASE("compare tells the first command, register and pixel that differ, and exit 1") {
    const Folder folder;
    folder.put("a.psxgpu", file_of(moving_line()));
    folder.put("b.psxgpu", file_of(moving_line(0x0000ff)));
    const auto equal = folder.otter("compare a.psxgpu a.psxgpu");
    CHECK(equal.status == 0);
    CHECK(mentions(equal.out, "no difference in 3 frames, 13 commands"));
    const auto differ = folder.otter("compare a.psxgpu b.psxgpu --json parting.json");
    CHECK(differ.status == 1);
    CHECK(mentions(differ.out, "A 2:2  line"));
    CHECK(mentions(differ.out, "301 pixels differ at the end of frame 2"));
    const auto report = parsed(contents(folder.path / "parting.json"));
    CHECK(report["command"]["a"]["number"] == "2:2");
    CHECK(report["pixel"]["frame"] == 2);
    CHECK(report["state"] == nullptr);
  }

  TEST_CASE("slice writes a dump of the few commands that a pixel depends on") {
    const Folder folder;
    folder.put("lines.psxgpu", file_of(moving_line()));
    const auto sliced = folder.otter("slice lines.psxgpu --frame 3 --pixel 5,30 -o small.psxgpu");
    CAPTURE(sliced.err);
    CHECK(sliced.status == 0);
    CHECK(mentions(sliced.out, "1 of 13 commands"));
    CHECK(mentions(sliced.out, "3:2"));
    CHECK(folder.otter("slice small.psxgpu --pixel 5,30 -o again.psxgpu").status == 0);
    for (const std::string options :
         {"--frame 4 --pixel 0,0", "--pixel 320,0", "--pixel 5", "--pixel 0,0 --size 0x1"}) {
      CAPTURE(options);
      const auto refused = folder.otter("slice lines.psxgpu -o bad.psxgpu " + options);
      CHECK(refused.status == 2);
      CHECK(is_one_line(refused.err));
      CHECK_FALSE(folder.has("bad.psxgpu"));
    }
  }

  TEST_CASE("regress holds a folder of dumps to what was drawn; shards are merged to the whole") {
    const Folder folder;
    std::filesystem::create_directories(folder.path / "dumps/below");
    folder.put("dumps/a.psxgpu", file_of(moving_line()));
    folder.put("dumps/b.psxgpu", file_of(moving_line(0x0000ff)));
    folder.put("dumps/below/c.psxgpu", file_of(moving_line(0xff0000)));
    CHECK(folder.otter("regress dumps").status == 2);  // nothing is expected yet
    CHECK(folder.otter("regress dumps --update").status == 0);
    const auto same = folder.otter("regress dumps --jobs 3");
    CHECK(same.status == 0);
    CHECK(mentions(same.out, "3 dumps, 9 frames: 0 differ"));
    for (const std::string i : {"1", "2"})
      CHECK(folder.otter("regress dumps --shard " + i + "/2 --json shard-" + i + ".json").status == 0);
    CHECK(folder.otter("merge shard-1.json shard-2.json -o whole.json").status == 0);
    CHECK(parsed(contents(folder.path / "whole.json"))["dumps"] ==
          parsed(contents(folder.path / "dumps/otter.regress.json"))["dumps"]);
    CHECK(folder.otter("merge shard-1.json -o part.json").status == 2);
    CHECK(folder.otter("merge shard-1.json shard-1.json -o part.json").status == 2);
    CHECK_FALSE(folder.has("part.json"));
    folder.put("dumps/b.psxgpu", file_of(moving_line()));
    std::filesystem::remove(folder.path / "dumps/below/c.psxgpu");
    folder.put("dumps/d.psxgpu", file_of(moving_line()));
    const auto changed = folder.otter("regress dumps");
    CHECK(changed.status == 1);
    CHECK(mentions(changed.out, "b.psxgpu: frame 2: "));
    CHECK(mentions(changed.out, "below/c.psxgpu: expected and not there"));
    CHECK(mentions(changed.out, "d.psxgpu: not expected"));
  }

  TEST_CASE("a RAM image stands where a scene may stand, and says that it needs its head") {
    const Folder folder;
    folder.put("ram.bin", std::string(std::size_t{2} << 20, '\0'));
    const auto headless = folder.otter("render ram.bin -o x.png");
    CHECK(headless.status == 2);
    CHECK(is_one_line(headless.err));
    CHECK(mentions(headless.err, "--head"));
    CHECK_FALSE(folder.has("x.png"));
  }
}
