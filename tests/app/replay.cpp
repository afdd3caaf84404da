// otter replay: what each option does with a dump, and what becomes of dumps that are not what they claim.

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "dump/compression.h"
#include "dump/dump.h"
#include "program.h"

namespace {

using dump::PacketType;
using tests::contents, tests::Folder, tests::is_one_line, tests::mentions;
using Words = std::vector<std::uint32_t>;

std::string text_of(const std::vector<std::byte>& bytes) {
  std::string text;
  for (const auto byte : bytes) text.push_back(static_cast<char>(byte));
  return text;
}

/// Three fills of 16 x 16 at the origin: red, green, blue; a VSync after each.
dump::Dump three_fills() {
  dump::Dump dump;
  dump.add(PacketType::gpu_version, Words{2});
  for (const std::uint32_t colour : {0x020000f8U, 0x0200f800U, 0x02f80000U}) {
    dump.add(PacketType::port0, Words{colour, 0, 0x00100010});
    dump.add(PacketType::vsync);
  }
  return dump;
}

std::string file_of(const dump::Dump& dump, dump::DumpFormat format = dump::DumpFormat::standard) {
  return text_of(dump::write_dump(dump, format));
}

/// The first pixel of a written VRAM, or FFFFFFFFh.
std::uint32_t first_pixel(const Folder& folder, const std::string& name) {
  const auto bytes = contents(folder.path / name);
  if (bytes.size() != 1 << 20) return 0xffffffff;
  return static_cast<unsigned char>(bytes[0]) |
         static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[1])) << 8;
}

constexpr std::uint32_t red = 0x001f, green = 0x03e0, blue = 0x7c00;

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("replay writes the VRAM after a whole dump, a VSync or a drawing command") {
    const Folder folder;
    folder.put("d.psxgpu", file_of(three_fills()));
    struct Row {
      std::string options;
      std::uint32_t pixel;
    };
    const std::vector<Row> rows{
        {"", blue},
        {"--frame 1", red},
        {"--frame 2", green},
        {"--frame 3", blue},
        {"--until 1", red},
        {"--until 2", green},
        {"--until 3", blue},
        {"--frame 2 --until 3", green},
        {"--frame 3 --until 1", red},
    };
    for (const auto& row : rows) {
      CAPTURE(row.options);
      const auto replayed = folder.otter("replay d.psxgpu --vram v.bin " + row.options);
      CHECK(replayed.status == 0);
      CHECK(replayed.err.empty());
      CHECK(is_one_line(replayed.out));
      CHECK(replayed.out == "d.psxgpu: v1r1, 7 packets, 3 VSyncs, 3 drawing commands\n");
      CHECK(first_pixel(folder, "v.bin") == row.pixel);
    }
  }

  TEST_CASE(
      "replay refuses a frame or a drawing command that the dump has not got: exit 2, nothing written") {
    const Folder folder;
    folder.put("d.psxgpu", file_of(three_fills()));
    for (const std::string options :
         {"--frame 4", "--until 4", "--frame 0", "--until 0", "--frame -1", "--repeat 0"}) {
      CAPTURE(options);
      const auto replayed = folder.otter("replay d.psxgpu --vram v.bin " + options);
      CHECK(replayed.status == 2);
      CHECK(is_one_line(replayed.err));
      CHECK(mentions(replayed.err, options.substr(0, options.find(' '))));
      CHECK_FALSE(folder.has("v.bin"));
    }
  }

  TEST_CASE("replay reads both forms of dumps, packed or not, whatever they are called") {
    const Folder folder;
    for (const auto format : {dump::DumpFormat::standard, dump::DumpFormat::v1}) {
      const auto plain = dump::write_dump(three_fills(), format);
      folder.put("plain", text_of(plain));
      folder.put("packed", text_of(dump::pack(plain, dump::Compression::zstd)));
      folder.put("packed.psxgpu", text_of(dump::pack(plain, dump::Compression::xz)));
      folder.put("named.psxgpu.zst", text_of(dump::pack(plain, dump::Compression::zstd)));
      for (const std::string name : {"plain", "packed", "packed.psxgpu", "named.psxgpu.zst"}) {
        CAPTURE(name);
        const auto replayed = folder.otter("replay " + name + " --vram v.bin");
        CHECK(replayed.status == 0);
        CHECK(mentions(replayed.out, format == dump::DumpFormat::v1 ? ": v1, " : ": v1r1, "));
        CHECK(first_pixel(folder, "v.bin") == blue);
      }
    }
  }

  TEST_CASE("replay --repeat prints the fastest time as a line of its own, and starts anew each time") {
    dump::Dump dump;  // adds a quarter of white to the origin: three times would be another picture
    dump.add(PacketType::port0, Words{0xe1000060, 0xe4000000 | 1023 | 511 << 10, 0x6affffff, 0});
    const Folder folder;
    folder.put("d.psxgpu", file_of(dump));
    const auto replayed = folder.otter("replay d.psxgpu --repeat 3 --vram v.bin");
    CHECK(replayed.status == 0);
    const auto at = replayed.out.find("\nns_per_replay ");
    REQUIRE(at != std::string::npos);
    const auto number = replayed.out.substr(at + 15);
    CHECK(number.back() == '\n');
    CHECK(number.find_first_not_of("0123456789") == number.size() - 1);
    CHECK(first_pixel(folder, "v.bin") == 0x1ce7);  // 31 >> 2 = 7 in each channel
  }

  TEST_CASE("replay --list prints a line a command with its offset and number") {
    const Folder folder;
    folder.put("d.psxgpu", file_of(three_fills()));
    const auto listed = folder.otter("replay d.psxgpu --list --until 2");
    CHECK(listed.status == 0);
    CHECK(mentions(listed.out, "GPU version 2"));
    CHECK(mentions(listed.out, "vsync 1"));
    CHECK(mentions(listed.out, "fill"));
    CHECK_FALSE(mentions(listed.out, "vsync 3"));
  }

  TEST_CASE("replay --readback keeps what type 4 reads, words with the first pixel in the low half") {
    dump::Dump dump;
    dump.add(PacketType::port0, Words{0xa0000000, 0, 0x00010003, 0x22221111, 0x00003333});
    dump.add(PacketType::port0, Words{0xc0000000, 0, 0x00010003});
    dump.add(PacketType::readback, Words{2});
    const Folder folder;
    folder.put("d.psxgpu", file_of(dump));
    CHECK(folder.otter("replay d.psxgpu --readback r.bin").status == 0);
    CHECK(contents(folder.path / "r.bin").substr(0, 6) == "\x11\x11\x22\x22\x33\x33");
    CHECK(contents(folder.path / "r.bin").size() == 8);
    folder.put("none.psxgpu", file_of(three_fills()));
    CHECK(folder.otter("replay none.psxgpu --readback empty.bin").status == 0);
    CHECK(contents(folder.path / "empty.bin").empty());
    CHECK(folder.has("empty.bin"));
  }

  TEST_CASE("a dump of no packets is all black") {
    const Folder folder;
    folder.put("d.psxgpu", file_of({}));
    CHECK(folder.otter("replay d.psxgpu --vram v.bin").status == 0);
    CHECK(contents(folder.path / "v.bin") == std::string(1 << 20, '\0'));
  }

  TEST_CASE("malformed dumps are one line with the byte offset, exit 2, and nothing written") {
    const std::string good = file_of(three_fills());
    const auto with = [](const Words& words) {
      dump::Dump dump;
      dump.add(PacketType::port0, words);
      return file_of(dump);
    };
    struct Row {
      std::string bytes, offset;
    };
    const std::vector<Row> rows{
        {"", "0"},
        {"PSXGPUDUMPv2", "10"},
        {std::string(64, 'x'), "0"},
        {good.substr(0, good.size() - 1), "80"},                // the last header has 3 bytes
        {good.substr(0, 30), "24"},                             // the first port packet is cut
        {with({0x48ffffff, 0, 1, 2}), "20"},                    // a polyline without an end
        {with({0xe1000000, 0xa0000000, 0, 0x00100010}), "24"},  // an upload without its pixels
        {"\x28\xb5\x2f\xfd is not zstd after all", ""},
    };
    const Folder folder;
    for (const auto& row : rows) {
      CAPTURE(row.bytes.size());
      folder.put("d.psxgpu", row.bytes);
      const auto replayed = folder.otter("replay d.psxgpu --vram v.bin --readback r.bin -o o.png");
      CAPTURE(replayed.err);
      CHECK(replayed.status == 2);
      CHECK(is_one_line(replayed.err));
      CHECK(mentions(replayed.err, "d.psxgpu"));
      CHECK(mentions(replayed.err, row.offset));
      CHECK(replayed.out.empty());
      for (const auto* name : {"v.bin", "r.bin", "o.png"}) CHECK_FALSE(folder.has(name));
    }
  }

  TEST_CASE(
      "what record --annotate writes is replayed by a z-buffer, what it writes without is drawn in list "
      "order "
      "with one warning, or refused with exit 1") {
    const Folder folder;
    REQUIRE(folder.otter("record crates -o with.psxgpu --annotate --frames 2 --format v1").status == 0);
    REQUIRE(folder.otter("record crates -o without.psxgpu.zst").status == 0);
    const auto with = folder.otter("replay with.psxgpu --visibility zbuffer --vram z.bin");
    CHECK(with.status == 0);
    CHECK(mentions(with.out, ": v1, "));
    CHECK(mentions(with.out, " 2 VSyncs, "));
    CHECK(folder.otter("replay with.psxgpu --frame 1 --vram a.bin").status == 0);
    CHECK(folder.otter("replay without.psxgpu.zst --frame 1 --vram b.bin").status == 0);
    CHECK(contents(folder.path / "a.bin") == contents(folder.path / "b.bin"));
    const auto warned = folder.otter("replay without.psxgpu.zst --visibility zbuffer --vram w.bin");
    CHECK(warned.status == 0);
    CHECK(is_one_line(warned.err));
    CHECK(mentions(warned.err, "polygons without depth, the first is command 1:"));
    CHECK(mentions(warned.err, "drawn in list order"));
    CHECK(contents(folder.path / "w.bin") == contents(folder.path / "b.bin"));
    const auto buckets =
        folder.otter("replay without.psxgpu.zst --visibility zbuffer --without-depth bucket --vram c.bin");
    CHECK(buckets.status == 2);
    CHECK(mentions(buckets.err, "--without-depth bucket: without.psxgpu.zst has no buckets"));
    CHECK_FALSE(folder.has("c.bin"));
    const auto refused =
        folder.otter("replay without.psxgpu.zst --visibility zbuffer --without-depth error --vram c.bin");
    CHECK(refused.status == 1);
    CHECK(mentions(refused.err, "polygons without depth"));
    CHECK_FALSE(folder.has("c.bin"));
  }

  TEST_CASE("an empty display area has no picture: exit 1 and one line, and --vram is written") {
    const Folder folder;
    dump::Dump dump;
    dump.add(PacketType::gpu_version, Words{2});
    dump.add(PacketType::port1, Words{0x07000000});  // the display ends on the row where it begins
    folder.put("d.psxgpu", file_of(dump));
    const auto replayed = folder.otter("replay d.psxgpu -o o.png --vram v.bin");
    CAPTURE(replayed.err);
    CHECK(replayed.status == 1);
    CHECK(is_one_line(replayed.err));
    CHECK(mentions(replayed.err, "empty display area"));
    CHECK(folder.has("v.bin"));
    CHECK_FALSE(folder.has("o.png"));
  }
}
