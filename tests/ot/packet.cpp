#include "ot/packet.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace ot;

namespace {

template <class T>
std::vector<std::uint32_t> words_of(const T& value) {
  std::vector<std::uint32_t> words(64, 0xcccccccc);
  words.resize(encode(value, words));
  return words;
}

using Words = std::vector<std::uint32_t>;

/// Takes annotation words one by one, as a GPU meets them. `depths` has bit v set when v's depth was given.
struct DepthReader {
  DepthAnnotation value{.count = 0};
  unsigned depths = 0;
  int high_words = 0;

  void take(std::uint32_t word);  ///< an E7h-EFh word
  void clear() { *this = DepthReader{}; }
  /// Every one of the polygon's vertices has a depth.
  [[nodiscard]] bool covers(std::size_t vertices) const {
    const unsigned all = (1U << vertices) - 1;
    return (depths & all) == all;
  }
};

void DepthReader::take(std::uint32_t word_in) {
  using namespace gp0::annotation;
  const auto code = gp0::Opcode::get(word_in);
  assert(code >= depth_high && code < fraction + 4);
  const auto put_high = [&](std::size_t v, std::uint32_t byte) {
    value.z[v] = DepthLow::get(value.z[v]) | byte << 24;
  };
  if (code == depth_high) {
    if (high_words++ == 0) {
      put_high(0, High0::get(word_in));
      put_high(1, High1::get(word_in));
      put_high(2, High2::get(word_in));
    } else {
      put_high(3, High0::get(word_in));
    }
  } else if (code < fraction) {
    const auto v = code - depth_low;
    value.z[v] = (value.z[v] & ~DepthLow::mask) | DepthLow::get(word_in);
    depths |= 1U << v;
    value.count = std::max(value.count, static_cast<int>(v) + 1);
  } else {
    const auto v = code - fraction;
    value.fx[v] = static_cast<std::uint8_t>(FractionX::get(word_in));
    value.fy[v] = static_cast<std::uint8_t>(FractionY::get(word_in));
    value.du[v] = static_cast<std::int8_t>(TexelRestU::get_signed(word_in));
    value.dv[v] = static_cast<std::int8_t>(TexelRestV::get_signed(word_in));
    value.has_fractions = true;
  }
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("a textured Gouraud quad has its CLUT in word 2 and its page in word 5") {
    const Polygon p{.quad = true,
                    .gouraud = true,
                    .textured = true,
                    .semi_transparent = true,
                    .xy = {{{-1, 2}, {3, -4}, {5, 6}, {-1024, 1023}}},
                    .rgb = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}},
                    .uv = {{{0x10, 0x20}, {0x30, 0x40}, {0x50, 0x60}, {0x70, 0x80}}},
                    .clut = 0x1234,
                    .texpage = 0x0056};
    CHECK(words_of(p) == Words{0x3e030201, 0x000207ff, 0x12342010, 0x00060504, 0x07fc0003, 0x00564030,
                               0x00090807, 0x00060005, 0x00006050, 0x000c0b0a, 0x03ff0400, 0x00008070});
  }

  TEST_CASE("every kind of polygon survives encoding and decoding") {
    std::mt19937 random(1);
    const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
    for (unsigned kind = 0; kind < 32; ++kind) {
      CAPTURE(kind);
      Polygon p{.quad = (kind & 8) != 0,
                .gouraud = (kind & 16) != 0,
                .textured = (kind & 4) != 0,
                .semi_transparent = (kind & 2) != 0,
                .raw = (kind & 1) != 0};
      for (std::size_t v = 0; v < p.vertices(); ++v) {
        p.xy[v] = {static_cast<std::int16_t>(static_cast<int>(random() % 2048) - 1024),
                   static_cast<std::int16_t>(static_cast<int>(random() % 2048) - 1024)};
        if (v == 0 || p.gouraud) p.rgb[v] = {byte(), byte(), byte()};
        if (p.textured) p.uv[v] = {byte(), byte()};
      }
      if (p.textured) {
        p.clut = static_cast<std::uint16_t>(random());
        p.texpage = static_cast<std::uint16_t>(random());
      }
      const auto words = words_of(p);
      CHECK(words.size() == word_count(p));
      CHECK(gp0::Opcode::get(words[0]) == 0x20 + kind);
      CHECK(decode_polygon(words) == p);
    }
  }

  TEST_CASE("rectangles, lines, fills and transfers survive encoding and decoding") {
    const Rectangle sprite{.textured = true,
                           .raw = true,
                           .xy = {-5, 6},
                           .rgb = {1, 2, 3},
                           .uv = {7, 8},
                           .clut = 99,
                           .width = 1023,
                           .height = 511};
    CHECK(words_of(sprite) == Words{0x65030201, 0x000607fb, 0x00630807, 0x01ff03ff});
    CHECK(decode_rectangle(words_of(sprite)) == sprite);
    const Rectangle tile{.size = RectangleSize::square16, .semi_transparent = true, .xy = {1, 2}};
    CHECK(words_of(tile) == Words{0x7a000000, 0x00020001});
    CHECK(decode_rectangle(words_of(tile)) == tile);
    const Line line{.gouraud = true, .xy = {{{1, 2}, {3, 4}}}, .rgb = {{{1, 1, 1}, {2, 2, 2}}}};
    CHECK(words_of(line) == Words{0x50010101, 0x00020001, 0x00020202, 0x00040003});
    CHECK(decode_line(words_of(line)) == line);
    const Fill fill{.rgb = {1, 2, 3}, .x = 16, .y = 32, .width = 320, .height = 240};
    CHECK(words_of(fill) == Words{0x02030201, 0x00200010, 0x00f00140});
    CHECK(decode_fill(words_of(fill)) == fill);
    const Copy copy{.from_x = 1, .from_y = 2, .to_x = 3, .to_y = 4, .width = 5, .height = 6};
    CHECK(words_of(copy) == Words{0x80000000, 0x00020001, 0x00040003, 0x00060005});
    CHECK(decode_copy(words_of(copy)) == copy);
    const Upload upload{.x = 1, .y = 2, .width = 3, .height = 4};
    CHECK(words_of(upload) == Words{0xa0000000, 0x00020001, 0x00040003});
    CHECK(decode_upload(words_of(upload)) == upload);
    const Download download{.x = 1, .y = 2, .width = 3, .height = 4};
    CHECK(words_of(download) == Words{0xc0000000, 0x00020001, 0x00040003});
    CHECK(decode_download(words_of(download)) == download);
  }

  TEST_CASE("a polyline ends with the terminator") {
    const std::array<Xy, 3> xy{{{0, 0}, {3, 0}, {3, 2}}};
    const std::array<Rgb, 3> rgb{{{8, 8, 8}, {1, 2, 3}, {4, 5, 6}}};
    CHECK(words_of(Polyline{.semi_transparent = true, .xy = xy, .rgb = rgb}) ==
          Words{0x4a080808, 0x00000000, 0x00000003, 0x00020003, 0x55555555});
    CHECK(words_of(Polyline{.gouraud = true, .xy = xy, .rgb = rgb}) ==
          Words{0x58080808, 0x00000000, 0x00030201, 0x00000003, 0x00060504, 0x00020003, 0x55555555});
  }

  TEST_CASE("state commands put their fields where the GPU reads them") {
    CHECK(words_of(DrawMode{.texpage = texpage_of(640, 256, Blend::subtract, TexelFormat::clut8),
                            .dither = true,
                            .flip_y = true}) == Words{0xe10022da});
    CHECK(words_of(TextureWindow{.mask_x = 1, .mask_y = 1, .offset_x = 1}) == Words{0xe2000421});
    CHECK(words_of(DrawArea{}) == Words{0xe3000000, 0xe407ffff});
    CHECK(words_of(DrawOffset{.xy = {-1, 1}}) == Words{0xe5000fff});
    CHECK(words_of(MaskBits{.set = true, .test = true}) == Words{0xe6000003});
    CHECK(clut_of(16, 256) == 0x4001);
  }

  TEST_CASE("depths below 4096 need no high words") {
    DepthAnnotation a;
    a.z = {0x001000, 0xffffff, 0x000001, 0};
    CHECK(words_of(a) == Words{0xe8001000, 0xe9ffffff, 0xea000001});
  }

  TEST_CASE("the high byte of the fourth depth stands in a second high word") {
    DepthAnnotation a{.count = 4};
    a.z = {1, 2, 3, 0x12345678};
    CHECK(words_of(a) == Words{0xe8000001, 0xe9000002, 0xea000003, 0xeb345678, 0xe7000000, 0xe7000012});
  }

  TEST_CASE("annotations survive encoding and decoding") {
    std::mt19937 random(2);
    for (int n = 0; n < 2000; ++n) {
      DepthAnnotation a{.has_fractions = random() % 2 == 0, .count = random() % 2 == 0 ? 3 : 4};
      const int shift = static_cast<int>(random() % 32);
      for (std::size_t v = 0; v < static_cast<std::size_t>(a.count); ++v) {
        a.z[v] = static_cast<std::uint32_t>(random()) >> shift;
        if (!a.has_fractions) continue;
        a.fx[v] = static_cast<std::uint8_t>(random());
        a.fy[v] = static_cast<std::uint8_t>(random());
        a.du[v] = static_cast<std::int8_t>(static_cast<int>(random() % 16) - 8);
        a.dv[v] = static_cast<std::int8_t>(static_cast<int>(random() % 16) - 8);
      }
      const auto words = words_of(a);
      CHECK(words.size() == word_count(a));
      CHECK(words.size() <= gp0::annotation::max_words);
      DepthReader reader;
      for (const auto w : words) {
        REQUIRE(gp0::command_of(w) == gp0::Command::annotation);
        reader.take(w);
      }
      CHECK(reader.value == a);
      CHECK(reader.covers(static_cast<std::size_t>(a.count)));
    }
  }

  TEST_CASE("high words may come before the low ones, and any number of them is safe") {
    DepthReader reader;
    for (const auto w : {0xe7030201U, 0xe7000004U, 0xe7000005U, 0xe8000000U}) reader.take(w);
    CHECK(reader.value.z == std::array<std::uint32_t, 4>{0x01000000, 0x02000000, 0x03000000, 0x05000000});
    CHECK_FALSE(reader.covers(3));
  }

  TEST_CASE("the arena stores a terminated node and says where") {
    MainRam ram(RamSize::mib2);
    PacketArena arena(ram, 0x1000, 0x1010);
    CHECK(arena.push(Words{1, 2}) == 0x1000);
    CHECK(ram.read(0x1000) == 0x02ffffff);
    CHECK(ram.read(0x1008) == 2);
    CHECK(arena.used_bytes() == 12);
    CHECK(arena.push(Words{}) == 0x100c);
    CHECK(ram.read(0x100c) == 0x00ffffff);
  }

  TEST_CASE("a full arena stores nothing") {
    MainRam ram(RamSize::mib2);
    PacketArena arena(ram, 0x1000, 0x1008);
    CHECK(arena.push(Words{1, 2}) == std::nullopt);
    CHECK(ram.read(0x1000) == 0);
    CHECK(arena.used_bytes() == 0);
    CHECK(arena.push(Words{7}) == 0x1000);
    CHECK(arena.free_bytes() == 0);
    arena.reset();
    CHECK(arena.free_bytes() == 8);
  }

  TEST_CASE("main RAM drops segment bits and mirrors itself") {
    MainRam ram(RamSize::mib2);
    ram.write(0x80012346, 42);
    CHECK(ram.read(0x00012344) == 42);
    CHECK(ram.read(0x00212344) == 42);
    MainRam large(RamSize::mib8);
    large.write(0x00012344, 42);
    CHECK(large.read(0x00212344) == 0);
  }
}
