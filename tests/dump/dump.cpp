#include "dump/dump.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <random>
#include <string>

#include "dump/bucket_note.h"
#include "dump/compression.h"
#include "ot/command_stream.h"

namespace {

using Bytes = std::vector<std::byte>;
using Words = std::vector<std::uint32_t>;
using dump::DumpFormat;
using dump::PacketType;

constexpr std::size_t magic_bytes = 16;

/// A dump file made of words: packet headers and payloads as they lie.
Bytes file(const Words& words, DumpFormat format = DumpFormat::standard) {
  Bytes bytes;
  const std::string magic =
      format == DumpFormat::v1 ? std::string("PSXGPUDUMPv1\0\0", 14) : std::string("PSXGPUDUMPv1r1\0\0", 16);
  for (const char c : magic) bytes.push_back(static_cast<std::byte>(c));
  for (const auto word : words) {
    for (int n = 0; n < 4; ++n) bytes.push_back(static_cast<std::byte>(word >> 8 * n & 0xff));
  }
  return bytes;
}

/// Polygons, a sprite, an upload and a polyline over noise: some of everything.
Words some_of_everything() {
  Words words{0xe3000000, 0xe407ffff, 0xe1000400, 0xa0000000, 0, 0x00100010};
  std::mt19937 random(5);
  for (int n = 0; n < 128; ++n) words.push_back(static_cast<std::uint32_t>(random()));
  const Words rest{0x300000ff, 0x00050005, 0x0000ff00, 0x00100040, 0x00ff0000, 0x00400010,              // G3
                   0x2c808080, 0x00200020, 0x00000000, 0x00200030, 0x00000010, 0x00300020, 0x00001000,  // FT4
                   0x00300030, 0x00001010,                                                              //
                   0x48ffffff, 0x00010001, 0x00200010, 0x00010030, 0x55555555,  // polyline
                   0x64808080, 0x00300001, 0x00000000, 0x00080008,              // sprite
                   0x80000000, 0x00000000, 0x00400040, 0x00100010,              // copy
                   0x02123456, 0x00000060, 0x00100010};                         // fill
  words.insert(words.end(), rest.begin(), rest.end());
  return words;
}

/// The words in port 0 packets of at most `size` words.
dump::Dump dump_in_pieces(const Words& words, std::size_t size) {
  dump::Dump dump;
  for (std::size_t at = 0; at < words.size(); at += size) {
    dump.add(PacketType::port0, std::span(words).subspan(at, std::min(size, words.size() - at)));
  }
  return dump;
}

Words vram_after(const dump::Dump& dump, const dump::ReplayOptions& options = {}) {
  const auto gpu = std::make_unique<gpu::Gpu>();
  dump::replay(dump, *gpu, options);
  const auto pixels = gpu->vram().pixels();
  return {pixels.begin(), pixels.end()};
}

bool same_packets(const dump::Dump& a, const dump::Dump& b) {
  return a.words == b.words && std::ranges::equal(a.packets, b.packets, [](const auto& p, const auto& q) {
           return p.type == q.type && p.first == q.first && p.count == q.count;
         });
}

void check_error(const Bytes& bytes, std::uint64_t offset, const std::string& text) {
  const auto parsed = dump::parse_dump(bytes);
  CHECK_FALSE(parsed);
  CHECK(parsed.offset == offset);
  CHECK(parsed.message == text);
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("a dump is a magic of 16 bytes and packets of type and length") {
    auto dump = dump::parse_dump(
        file({0x06000001, 2, 0x05000000, 0x01000001, 0x08000001, 0x00000002, 0xe1000000, 0, 0x02000000}));
    REQUIRE(dump);
    CHECK(dump->packets.size() == 5);
    CHECK(dump->gpu_version == 2);
    CHECK(dump->vsyncs == 1);
    CHECK(dump->packets[2].type == PacketType::port1);
    CHECK(dump->packets[2].offset == magic_bytes + 12);
    CHECK(std::ranges::equal(dump->payload(dump->packets[3]), std::array{0xe1000000U, 0U}));
  }

  TEST_CASE("the older magic has 14 bytes, and its GPU versions count from 0") {
    auto dump = dump::parse_dump(file({0x06000001, 1, 0x02000000}, DumpFormat::v1));
    REQUIRE(dump);
    CHECK(dump->format == DumpFormat::v1);
    CHECK(dump->gpu_version == 2);
    CHECK(dump->packets[1].offset == 14 + 8);
  }

  TEST_CASE("another version, or another file, is refused") {
    Bytes other = file({});
    other[11] = std::byte{'2'};
    check_error(other, 10, "a GPU dump of another version than v1r1 and v1");
    check_error(Bytes(100), 0, "not a GPU dump: it does not begin with PSXGPUDUMP");
    check_error({}, 0, "not a GPU dump: it does not begin with PSXGPUDUMP");
  }

  TEST_CASE("a packet that claims more words than there are is refused where it begins") {
    check_error(file({0x02000000, 0x00ffffff, 1, 2}), magic_bytes + 4,
                "packet of type 00h claims 16777215 words, 2 are left");
  }

  TEST_CASE("bytes after the last packet are refused") {
    Bytes bytes = file({0x02000000});
    bytes.push_back(std::byte{0});
    check_error(bytes, magic_bytes + 4, "1 bytes are left, a packet header takes 4");
  }

  TEST_CASE("packets of unknown type are skipped") {
    auto dump =
        dump::parse_dump(file({0x7f000002, 0x48000000, 0x12345678, 0x00000001, 0xe1000000, 0xff000000}));
    REQUIRE(dump);
    CHECK(dump->packets.size() == 3);
    vram_after(*dump);
  }

  TEST_CASE("a polyline without an end is refused where it begins") {
    check_error(file({0x00000003, 0xe1000000, 0x48ffffff, 0, 0x00000002, 1, 2}), magic_bytes + 8,
                "the polyline that begins here has no end");
  }

  TEST_CASE("a command that the dump cuts short is refused where it begins") {
    check_error(file({0x00000004, 0xa0000000, 0, 0x00040004, 7}), magic_bytes + 4,
                "the command that begins here (A0h) ends after 4 of 11 words");
    check_error(file({0x00000001, 0x20000000}), magic_bytes + 4,
                "the command that begins here (20h) ends after 1 of 4 words");
  }

  TEST_CASE("GP1(00h) and GP1(01h) take back an unfinished command") {
    CHECK(dump::parse_dump(file({0x00000001, 0x20000000, 0x01000001, 0x01000000})));
    CHECK(dump::parse_dump(file({0x00000001, 0x48000000, 0x01000001, 0x00000000})));
    CHECK_FALSE(dump::parse_dump(file({0x00000001, 0x20000000, 0x01000001, 0x02000000})));
  }

  TEST_CASE("a read of more words than VRAM holds is refused") {
    CHECK(dump::parse_dump(file({0x03000001, 262144})));
    check_error(file({0x04000001, 262145}), magic_bytes + 4, "reads 262145 words, VRAM holds 262144");
    check_error(file({0x03000000}), magic_bytes, "packet of type 03h has 0 words, 1 was expected");
    check_error(file({0x06000002, 1, 2}), magic_bytes, "packet of type 06h has 2 words, 1 was expected");
  }

  TEST_CASE("read-backs of more than 128 MiB in all are refused") {
    Words words;
    for (int n = 0; n < 129; ++n) words.insert(words.end(), {0x04000001, 262144});
    check_error(file(words), magic_bytes + 128 * 8, "reads back more than 134217728 bytes");
  }

  TEST_CASE("every beginning of a dump is read or refused, never more than it holds") {
    dump::Dump dump = dump_in_pieces(some_of_everything(), 7);
    dump.add(PacketType::readback, Words{4});
    for (const auto format : {DumpFormat::standard, DumpFormat::v1}) {
      const Bytes whole = dump::write_dump(dump, format);
      for (std::size_t size = 0; size < whole.size(); ++size) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        auto parsed = dump::parse_dump(cut);
        if (parsed) {
          CHECK(parsed->words.size() < dump.words.size());
        } else {
          CHECK(parsed.offset <= size);
          CHECK_FALSE(parsed.message.empty());
        }
      }
      CHECK(dump::parse_dump(whole));
    }
  }

  TEST_CASE("damaged dumps are read or refused, and what is read replays") {
    std::mt19937 random(7);
    dump::Dump dump = dump_in_pieces(some_of_everything(), 9);
    dump.add(PacketType::port0, Words{0xc0000000, 0, 0x00040004});
    dump.add(PacketType::readback, Words{8});
    const Bytes whole = dump::write_dump(dump, DumpFormat::standard);
    int read = 0;
    for (int n = 0; n < 300; ++n) {
      Bytes bytes = whole;
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 0xff);
      if (auto parsed = dump::parse_dump(bytes)) {
        ++read;
        Words back;
        vram_after(*parsed, {.readback = &back});
      }
    }
    CHECK(read > 20);
  }

  TEST_CASE("dumps are written and read back in both formats") {
    dump::Dump dump;
    dump.add_text(PacketType::comment, "made by hand");
    dump.add(PacketType::gpu_version, Words{2});
    dump.add(PacketType::trace_begin);
    dump.add(PacketType::port1, Words{0});
    dump.add(PacketType::port0, some_of_everything());
    dump.add(PacketType::vsync);
    for (const auto format : {DumpFormat::standard, DumpFormat::v1}) {
      const Bytes bytes = dump::write_dump(dump, format);
      CHECK(bytes.size() ==
            (format == DumpFormat::v1 ? 14 : 16) + 4 * (dump.packets.size() + dump.words.size()));
      auto parsed = dump::parse_dump(bytes);
      REQUIRE(parsed);
      CHECK(parsed->format == format);
      CHECK(parsed->gpu_version == 2);
      CHECK(parsed->drawing_commands == 7);
      if (format == DumpFormat::standard) CHECK(same_packets(*parsed, dump));
      CHECK(vram_after(*parsed) == vram_after(dump));
      CHECK(dump::write_dump(*parsed, format) == bytes);
    }
  }

  TEST_CASE("port data longer than a packet becomes several packets") {
    dump::Dump dump;
    dump.add(PacketType::port0, Words((1U << 24) + 5));
    REQUIRE(dump.packets.size() == 2);
    CHECK(dump.packets[0].count == (1U << 24) - 1);
    CHECK(dump.packets[1].count == 6);
  }

  TEST_CASE("commands may be cut by packets anywhere") {
    const auto words = some_of_everything();
    const auto expected = vram_after(dump_in_pieces(words, words.size()));
    for (std::size_t size = 1; size < 14; ++size) {
      CAPTURE(size);
      CHECK(vram_after(dump_in_pieces(words, size)) == expected);
    }
  }

  TEST_CASE("a replay stops at the asked VSync") {
    dump::Dump dump;
    for (const std::uint32_t colour : {0x02ff0000U, 0x0200ff00U, 0x020000ffU}) {
      dump.add(PacketType::port0, Words{colour, 0, 0x00100010});
      dump.add(PacketType::vsync);
    }
    CHECK(vram_after(dump, {.frame = 1})[0] == 0x7c00);
    CHECK(vram_after(dump, {.frame = 2})[0] == 0x03e0);
    CHECK(vram_after(dump)[0] == 0x001f);
  }

  TEST_CASE("a replay stops after the asked drawing command, wherever packets end") {
    // Drawing commands: upload, triangle, quad, polyline, sprite, copy, fill. State commands do not count.
    const auto words = some_of_everything();
    const std::array<std::size_t, 7> end{134, 140, 149, 154, 158, 162, 165};
    for (std::size_t k = 0; k < end.size(); ++k) {
      CAPTURE(k);
      const auto expected =
          vram_after(dump_in_pieces({words.begin(), words.begin() + static_cast<long>(end[k])}, 1000));
      for (const std::size_t size : {std::size_t{1}, std::size_t{5}, words.size()}) {
        CHECK(vram_after(dump_in_pieces(words, size), {.until = k + 1}) == expected);
      }
    }
  }

  TEST_CASE("read-back words come out in order, discarded ones do not") {
    dump::Dump dump;
    dump.add(PacketType::port0,
             Words{0xa0000000, 0, 0x00020004, 0x22221111, 0x44443333, 0x66665555, 0x88887777});
    dump.add(PacketType::port0, Words{0xc0000000, 0, 0x00020004});
    dump.add(PacketType::discard, Words{1});
    dump.add(PacketType::readback, Words{2});
    dump.add(PacketType::readback, Words{1});
    Words back;
    vram_after(dump, {.readback = &back});
    CHECK(back == Words{0x44443333, 0x66665555, 0x88887777});
  }

  TEST_CASE("reading on after the end of a transfer gives the latched register") {
    dump::Dump dump;
    dump.add(PacketType::port1, Words{0x10000007});
    dump.add(PacketType::discard, Words{262144});
    dump.add(PacketType::readback, Words{3});
    Words back;
    vram_after(dump, {.readback = &back});
    CHECK(back == Words{2, 2, 2});
  }

  TEST_CASE("the command stream ends commands where the GPU does") {
    std::mt19937 random(11);
    ot::CommandStream stream;
    gpu::Gpu gpu;
    std::array<std::uint64_t, gpu::kind_count> seen{};
    const auto feed = [&](std::uint32_t word) {
      gpu.gp0(word);
      if (!stream.take(word)) return;
      switch (stream.command()) {
        case ot::gp0::Command::polygon:
          ++seen[0];
          break;
        case ot::gp0::Command::rectangle:
          ++seen[1];
          break;
        case ot::gp0::Command::line:
          ++seen[2];
          break;
        case ot::gp0::Command::polyline:
          // n vertices are n + 2 words flat, 2n + 1 words Gouraud, the terminator included
          seen[2] += ot::gp0::line::IsGouraud::get(stream.words()[0]) != 0 ? (stream.length() - 1) / 2 - 1
                                                                           : stream.length() - 3;
          break;
        case ot::gp0::Command::fill:
          ++seen[3];
          break;
        case ot::gp0::Command::copy:
          ++seen[4];
          break;
        case ot::gp0::Command::upload:
          ++seen[5];
          break;
        default:
          break;
      }
    };
    for (int n = 0; n < 300000; ++n)
      feed((static_cast<std::uint32_t>(random()) & 0xff00f000) | 0x00010001);  // small sizes
    while (stream.is_open()) feed(ot::gp0::line::terminator);
    for (std::size_t kind = 0; kind < seen.size(); ++kind) {
      CAPTURE(kind);
      CHECK(seen[kind] > 20);
      CHECK(gpu.counters().primitives[kind] == seen[kind]);
    }
  }

  TEST_CASE("packed dumps unpack to what was packed") {
    const Bytes plain = dump::write_dump(dump_in_pieces(some_of_everything(), 50), DumpFormat::standard);
    CHECK(*dump::unpack(plain).value == plain);
    for (const auto how : {dump::Compression::zstd, dump::Compression::xz}) {
      const Bytes packed = dump::pack(plain, how);
      CHECK(dump::compression_of(packed) == how);
      CHECK(*dump::unpack(packed).value == plain);
      Bytes twice = packed;
      twice.insert(twice.end(), packed.begin(), packed.end());
      CHECK(dump::unpack(twice).value->size() == 2 * plain.size());
    }
  }

  TEST_CASE("packed data that unpacks to more than the limit is refused early") {
    const Bytes zeros(std::size_t{64} << 20);
    for (const auto how : {dump::Compression::zstd, dump::Compression::xz}) {
      const Bytes packed = dump::pack(zeros, how);
      CHECK(packed.size() < 100000);
      const auto unpacked = dump::unpack(packed, 1 << 20);
      CHECK_FALSE(unpacked);
      CHECK(unpacked.message == "unpacks to more than 1048576 bytes");
      const auto exact = dump::unpack(packed, zeros.size());
      CHECK(exact.message == "");
    }
  }

  TEST_CASE("packed data that is damaged or cut short is refused") {
    const Bytes plain = dump::write_dump(dump_in_pieces(some_of_everything(), 50), DumpFormat::standard);
    for (const auto how : {dump::Compression::zstd, dump::Compression::xz}) {
      const Bytes packed = dump::pack(plain, how);
      for (std::size_t size = 6; size < packed.size(); ++size) {
        const auto cut = dump::unpack(std::span(packed).first(size));
        CHECK_FALSE(cut);
        CHECK(cut.offset <= size);
      }
      std::mt19937 random(13);
      for (int n = 0; n < 200; ++n) {
        Bytes damaged = packed;
        damaged[6 + random() % (damaged.size() - 6)] ^= std::byte{0x10};
        dump::unpack(damaged);
      }
    }
  }

  TEST_CASE("a note about a bucket comes back from its packet, and other comments are none") {
    dump::Dump dump;
    for (const auto& note : {dump::BucketNote{0, 1}, dump::BucketNote{255, 256}, dump::BucketNote{}}) {
      dump.add_text(PacketType::comment, dump::to_text(note));
      CHECK(dump::bucket_note(dump, dump.packets.back()) == note);
    }
    for (const char* text :
         {"", "otter.bucket", "otter.bucket 4", "otter.bucket 4 of 4", "otter.bucket x of 4",
          "otter.bucket 1 of 0", "otter.bucket 1 of 99999999999", "hello"}) {
      CAPTURE(text);
      dump.add_text(PacketType::comment, text);
      CHECK_FALSE(dump::bucket_note(dump, dump.packets.back()));
    }
    dump.add_text(PacketType::game_id, "otter.bucket 1 of 4");
    CHECK_FALSE(dump::bucket_note(dump, dump.packets.back()));
  }
}
