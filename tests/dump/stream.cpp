// Dumps that are read, written and replayed piece by piece.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "dump/compression.h"
#include "dump/dump.h"

namespace {

using Bytes = std::vector<std::byte>;
using Words = std::vector<std::uint32_t>;
using dump::DumpFormat;
using dump::PacketType;

Words fill(std::uint32_t colour) { return {0x02000000 | colour, 0, 0x00100010}; }

Bytes written(DumpFormat format, int frames) {
  Bytes bytes;
  dump::DumpWriter writer(
      format, [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
  writer.add_text(PacketType::comment, "seven");
  writer.add(PacketType::gpu_version, Words{2});
  for (int n = 0; n < frames; ++n) {
    writer.add(PacketType::port0, fill(static_cast<std::uint32_t>(n)));
    writer.add(PacketType::port1, Words{0x05000000});
    writer.add(PacketType::vsync);
  }
  return bytes;
}

dump::Parsed<dump::Dump> read_in_pieces(const Bytes& bytes, std::size_t size) {
  dump::DumpReader reader;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    if (!reader.feed(std::span(bytes).subspan(at, std::min(size, bytes.size() - at)))) break;
  }
  return reader.finish();
}

Words vram_of(const gpu::Gpu& gpu) {
  const auto pixels = gpu.vram().pixels();
  return {pixels.begin(), pixels.end()};
}

}  // namespace

TEST_SUITE("dump") {
  TEST_CASE("A dump may be fed in pieces of any size: it is the same, and so is what is wrong with it") {
    for (const auto format : {DumpFormat::standard, DumpFormat::v1}) {
      Bytes bytes = written(format, 5);
      for (const bool is_damaged : {false, true}) {
        if (is_damaged) bytes[bytes.size() - 3] = std::byte{9};  // the last packet claims 2,304 words
        auto whole = dump::parse_dump(bytes);
        REQUIRE(static_cast<bool>(whole) != is_damaged);
        for (const std::size_t size : {1U, 2U, 3U, 5U, 7U, 16U, 64U}) {
          CAPTURE(size);
          auto pieces = read_in_pieces(bytes, size);
          REQUIRE(static_cast<bool>(pieces) != is_damaged);
          CHECK(pieces.message == whole.message);
          CHECK(pieces.offset == whole.offset);
          if (is_damaged) continue;
          CHECK(pieces->words == whole->words);
          CHECK(pieces->packets.size() == whole->packets.size());
          CHECK(pieces->vsyncs == 5);
        }
      }
    }
  }

  TEST_CASE("Empty packets of the ports are counted and take no memory; what they stand between is kept") {
    dump::DumpReader reader;
    const Bytes begin = written(DumpFormat::standard, 1), zeros(std::size_t{4} << 20);
    REQUIRE(reader.feed(begin));
    for (int n = 0; n < 16; ++n) REQUIRE(reader.feed(zeros));
    auto dump = reader.finish();
    REQUIRE(dump);
    CHECK(dump->empty_packets == std::uint64_t{16} << 20);
    CHECK(dump->packets.size() == 5);
    CHECK(dump->packets.capacity() < 64);
  }

  TEST_CASE("A dump that would take more memory than is allowed is refused where that is passed") {
    const Bytes bytes = written(DumpFormat::standard, 100);  // 3 packets of 16 bytes and 4 words a frame
    dump::DumpReader reader(1000);
    CHECK_FALSE(reader.feed(bytes));
    const auto refused = reader.finish();
    CHECK_FALSE(refused);
    CHECK(refused.message.find("more than 1000 bytes") != std::string::npos);
    CHECK(refused.offset < bytes.size() / 4);
    dump::DumpReader enough(100'000);
    CHECK(enough.feed(bytes));
    CHECK(enough.finish());
  }

  TEST_CASE("A packet of 64 MiB is refused as it grows, not when it ends") {
    dump::DumpReader reader(std::size_t{8} << 20);
    Bytes bytes = written(DumpFormat::standard, 0);
    for (const auto byte : {0xff, 0xff, 0xff, 0x00}) bytes.push_back(static_cast<std::byte>(byte));
    const Bytes more(std::size_t{1} << 20);
    REQUIRE(reader.feed(bytes));
    int fed = 0;
    while (fed < 64 && reader.feed(more)) ++fed;
    CHECK(fed < 10);
    CHECK_FALSE(reader.finish());
  }

  TEST_CASE("What is allowed grows with the file, from 192 MiB to 1 GiB") {
    CHECK(dump::most_held_bytes(0) == std::uint64_t{192} << 20);
    CHECK(dump::most_held_bytes(std::uint64_t{48} << 20) == std::uint64_t{192} << 20);
    CHECK(dump::most_held_bytes(std::uint64_t{100} << 20) == std::uint64_t{400} << 20);
    CHECK(dump::most_held_bytes(~std::uint64_t{0}) == std::uint64_t{1} << 30);
  }

  TEST_CASE("Packing piece by piece unpacks to the same bytes, and unpacking ends when no more is wanted") {
    Bytes bytes(300'000);
    for (std::size_t n = 0; n < bytes.size(); ++n) bytes[n] = static_cast<std::byte>(n * n >> 7);
    for (const auto compression : {dump::Compression::none, dump::Compression::zstd, dump::Compression::xz}) {
      Bytes packed, unpacked;
      dump::Packer packer(compression, [&](std::span<const std::byte> more) {
        packed.insert(packed.end(), more.begin(), more.end());
      });
      for (std::size_t at = 0; at < bytes.size(); at += 70'001) {
        packer.add(std::span(bytes).subspan(at, std::min<std::size_t>(70'001, bytes.size() - at)));
      }
      packer.finish();
      CHECK(dump::compression_of(packed) == compression);
      const auto all = dump::unpack_to(packed, [&](std::span<const std::byte> more) {
        unpacked.insert(unpacked.end(), more.begin(), more.end());
        return true;
      });
      REQUIRE(all);
      CHECK(*all.value == bytes.size());
      CHECK(unpacked == bytes);
      std::size_t taken = 0;
      CHECK(dump::unpack_to(packed, [&](std::span<const std::byte> more) {
        taken += more.size();
        return false;
      }));
      CHECK((compression == dump::Compression::none || taken < bytes.size()));
    }
  }

  TEST_CASE("A replay that is told to stop ends within 512 words, and says how far it is") {
    dump::Dump dump;
    Words words;
    for (std::uint32_t n = 0; n < 2000; ++n) {
      const auto more = fill(n);
      words.insert(words.end(), more.begin(), more.end());
    }
    dump.add(PacketType::port0, words);
    gpu::Gpu gpu;
    std::uint64_t told = 0;
    dump::replay(dump, gpu, {.keep_going = [&](std::uint64_t sent) {
                   told = sent;
                   return sent < 1000;
                 }});
    CHECK(told >= 1000);
    CHECK(told < 1000 + 512);
    CHECK(gpu.counters().words == told);
  }

  TEST_CASE("A dump replayed packet by packet draws what it draws at once") {
    auto dump = dump::parse_dump(written(DumpFormat::standard, 6));
    REQUIRE(dump);
    const auto whole = std::make_unique<gpu::Gpu>(), parts = std::make_unique<gpu::Gpu>();
    dump::replay(*dump, *whole);
    for (std::size_t n = 0; n < dump->packets.size(); ++n) {
      dump::replay(*dump, *parts, {.first_packet = n, .end_packet = n + 1});
    }
    CHECK(vram_of(*whole) == vram_of(*parts));
  }
}
