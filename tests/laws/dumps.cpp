// Recordings: written, packed, cut, fed in pieces, read and replayed, they draw what the words draw.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "dump/compression.h"
#include "dump/dump.h"
#include "generate.h"

namespace {

using Bytes = std::vector<std::byte>;
using laws::Words;

bool same_vram(const gpu::Gpu& a, const gpu::Gpu& b) {
  return std::ranges::equal(a.vram().pixels(), b.vram().pixels());
}

/// The words in packets of random sizes, with frames between them.
dump::Dump recorded(const Words& words, const std::vector<std::size_t>& sizes) {
  dump::Dump dump;
  std::size_t at = 0;
  for (std::size_t n = 0; at < words.size(); ++n) {
    const std::size_t count =
        std::min(sizes.empty() ? words.size() : 1 + sizes[n % sizes.size()] % 60, words.size() - at);
    dump.add(dump::PacketType::port0, std::span(words).subspan(at, count));
    if (n % 3 == 2) dump.add(dump::PacketType::vsync);
    at += count;
  }
  dump.add(dump::PacketType::port1, std::array{0x01000000U});  // what is open at the end is forgotten
  return dump;
}

dump::Parsed<dump::Dump> read_in_pieces(const Bytes& file, std::size_t size) {
  dump::DumpReader reader;
  const auto unpacked = dump::unpack_to(file, [&](std::span<const std::byte> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(size, bytes.size()))) {
      if (!reader.feed(bytes.first(std::min(size, bytes.size())))) return false;
    }
    return true;
  });
  RC_ASSERT(unpacked.value.has_value());
  return reader.finish();
}

}  // namespace

TEST_SUITE("laws") {
  TEST_CASE("Recording and replaying commute with drawing, whatever the format, the packing and the pieces") {
    CHECK(rc::check([](const std::vector<std::size_t>& sizes) {
      const Words words = *laws::stream();
      const auto format = *rc::gen::element(dump::DumpFormat::standard, dump::DumpFormat::v1);
      const auto packing =
          *rc::gen::element(dump::Compression::none, dump::Compression::zstd, dump::Compression::xz);
      const auto piece = *rc::gen::inRange<std::size_t>(1, 100);
      const auto dump = recorded(words, sizes);
      auto read = read_in_pieces(dump::pack(dump::write_dump(dump, format), packing), piece);
      RC_ASSERT(read.value.has_value());
      RC_ASSERT(read->words == dump.words);
      const auto live = std::make_unique<gpu::Gpu>(), replayed = std::make_unique<gpu::Gpu>();
      live->gp0(words);
      dump::replay(*read, *replayed);
      RC_ASSERT(same_vram(*live, *replayed));
      RC_ASSERT(dump::write_dump(*read, format) == dump::write_dump(dump, format));
    }));
  }

  TEST_CASE("A replay in any slices of packets is the whole replay") {
    CHECK(rc::check([](const std::vector<std::size_t>& sizes) {
      const auto dump = recorded(*laws::stream(), sizes);
      const auto whole = std::make_unique<gpu::Gpu>(), sliced = std::make_unique<gpu::Gpu>();
      dump::replay(dump, *whole);
      for (std::size_t first = 0; first < dump.packets.size();) {
        const std::size_t end = first + *rc::gen::inRange<std::size_t>(1, 6);
        dump::replay(dump, *sliced, {.first_packet = first, .end_packet = end});
        first = end;
      }
      RC_ASSERT(same_vram(*whole, *sliced));
    }));
  }

  TEST_CASE("A reader ends on any bytes, with a dump or with an offset inside them") {
    CHECK(rc::check([](const std::vector<std::uint8_t>& tail) {
      Bytes bytes = dump::write_dump(recorded(*laws::stream(), {3, 1, 40}), dump::DumpFormat::standard);
      const auto keep = *rc::gen::inRange<std::size_t>(0, bytes.size());
      bytes.resize(keep);
      for (const auto b : tail) bytes.push_back(std::byte{b});
      const auto read = dump::parse_dump(bytes);
      RC_ASSERT(read.value.has_value() || (read.offset <= bytes.size() && !read.message.empty()));
    }));
  }
}
