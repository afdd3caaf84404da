// Examples of the rules of docs/hardware.md, worked by hand: what each command leaves in VRAM.

#include <doctest/doctest.h>

#include <array>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "tests/oracle/plain_gpu.h"

namespace {

using Words = std::vector<std::uint32_t>;
using Pixels = std::vector<std::uint16_t>;

std::uint32_t at(int x, int y) {
  return (static_cast<std::uint32_t>(x) & 0xffff) | (static_cast<std::uint32_t>(y) & 0xffff) << 16;
}
std::uint32_t uv(int u, int v, std::uint32_t high = 0) {
  return static_cast<std::uint32_t>(u | v << 8) | high << 16;
}

/// A GPU with everything drawable, and ways to look at the result.
struct Bench {
  std::unique_ptr<gpu::Gpu> gpu = std::make_unique<gpu::Gpu>();
  Bench() { send({0xe3000000, 0xe4000000 | 1023 | 511 << 10}); }
  void send(const Words& words) const { gpu->gp0(words); }
  [[nodiscard]] std::uint16_t pixel(int x, int y) const { return gpu->vram().at(x, y); }
  [[nodiscard]] Pixels row(int x, int y, int count) const {
    Pixels result;
    for (int i = 0; i < count; ++i) result.push_back(pixel(x + i, y));
    return result;
  }
  /// "1: 3..3; 2: 2..3": inclusive columns of every row that holds anything.
  [[nodiscard]] std::string rows(int width = 16, int height = 16) const {
    std::ostringstream result;
    for (int y = 0; y < height; ++y) {
      int first = -1, last = -1;
      for (int x = 0; x < width; ++x) {
        if (pixel(x, y) == 0) continue;
        if (first < 0) first = x;
        last = x;
      }
      if (first < 0) continue;
      result << (result.tellp() > 0 ? "; " : "") << y << ": " << first << ".." << last;
    }
    return result.str();
  }
  [[nodiscard]] int count() const {
    int n = 0;
    for (const std::uint16_t p : gpu->vram().pixels()) n += p != 0 ? 1 : 0;
    return n;
  }
  [[nodiscard]] std::uint32_t fnv1a() const {
    std::uint32_t hash = 0x811c9dc5;
    for (const std::uint16_t p : gpu->vram().pixels()) {
      for (const unsigned byte : {p & 255U, static_cast<unsigned>(p) >> 8}) hash = (hash ^ byte) * 0x01000193;
    }
    return hash;
  }
  /// A raw 15-bit page at (640, 0): texel(u, v) = 1 + u + 32 v.
  void numbered_page() const {
    for (int v = 0; v < 256; ++v) {
      for (int u = 0; u < 256; ++u) gpu->vram().at(640 + u, v) = static_cast<std::uint16_t>(1 + u + 32 * v);
    }
  }
};

constexpr std::uint32_t white = 0xffffff, page_640_15bit = 10 | 2 << 7;

std::string flat(std::initializer_list<std::array<int, 2>> corners) {
  const Bench bench;
  Words words{(corners.size() == 4 ? 0x28000000U : 0x20000000U) | white};
  for (const auto& c : corners) words.push_back(at(c[0], c[1]));
  bench.send(words);
  return bench.rows();
}

/// Raw textured quad with these corners and texels.
Bench textured(std::initializer_list<std::array<int, 4>> corners) {
  Bench bench;
  bench.numbered_page();
  Words words{0x2d000000};
  for (const auto& c : corners) {
    words.push_back(at(c[0], c[1]));
    words.push_back(uv(c[2], c[3], words.size() == 4 ? page_640_15bit : 0));
  }
  bench.send(words);
  return bench;
}

/// A quad of w x h with texels from u0, v0 to u1, v1.
Bench mapped(int w, int h, int u0, int u1, int v0, int v1) {
  return textured({{0, 0, u0, v0}, {w, 0, u1, v0}, {0, h, u0, v1}, {w, h, u1, v1}});
}

/// (x, y) of every pixel drawn, by rows.
std::string line(int x0, int y0, int x1, int y1) {
  const Bench bench;
  bench.send({0x40ffffff, at(x0, y0), at(x1, y1)});
  std::ostringstream result;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if (bench.pixel(x, y) != 0) result << "(" << x << "," << y << ")";
    }
  }
  return result.str();
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("A flat triangle covers its left and top edges and leaves out the right and bottom ones") {
    CHECK(flat({{0, 0}, {4, 0}, {0, 4}}) == "0: 0..3; 1: 0..2; 2: 0..1; 3: 0..0");
    CHECK(flat({{0, 0}, {1, 0}, {0, 1}}) == "0: 0..0");
    CHECK(flat({{4, 0}, {4, 4}, {0, 4}}) == "1: 3..3; 2: 2..3; 3: 1..3");
    CHECK(flat({{0, 0}, {5, 2}, {1, 6}}) == "1: 1..2; 2: 1..4; 3: 1..3; 4: 1..2; 5: 1..1");
    CHECK(flat({{2, 0}, {6, 3}, {0, 7}}) == "1: 2..3; 2: 2..4; 3: 2..5; 4: 1..4; 5: 1..2; 6: 1..1");
    CHECK(flat({{3, 1}, {3, 5}, {0, 3}}) == "2: 2..2; 3: 0..2; 4: 2..2");
    CHECK(flat({{0, 0}, {7, 3}, {3, 7}}) == "1: 1..2; 2: 1..4; 3: 2..6; 4: 2..5; 5: 3..4; 6: 3..3");
  }

  TEST_CASE("A triangle without a sample point inside, or without area or height, draws nothing") {
    CHECK(flat({{0, 0}, {8, 1}, {0, 1}}).empty());
    CHECK(flat({{0, 0}, {1, 1}, {1, 3}}).empty());
    CHECK(flat({{0, 0}, {2, 1}, {4, 3}}).empty());
    CHECK(flat({{0, 0}, {3, 0}, {6, 0}}).empty());
    CHECK(flat({{0, 0}, {2, 2}, {5, 5}}).empty());
  }

  TEST_CASE("A quad is two triangles that hit every pixel exactly once") {
    const Bench bench;
    bench.send({0xe1000020, 0x2a080808, at(1, 0), at(6, 2), at(0, 5), at(7, 7)});
    CHECK(bench.rows() == "1: 1..3; 2: 1..5; 3: 1..6; 4: 1..6; 5: 0..6; 6: 4..6");
    CHECK(bench.count() == 30);
    for (const std::uint16_t pixel : bench.gpu->vram().pixels()) {
      if (pixel != 0) REQUIRE(pixel == 0x0421);
    }
  }

  TEST_CASE("A gouraud triangle steps its colours as the console does") {
    const auto draw = [](std::uint32_t mode) {
      Bench bench;
      bench.send({0xe1000000 | mode, 0x30800000, at(0, 0), 0x8000ff, at(8, 0), 0x80ff00, at(0, 8)});
      return bench;
    };
    const Bench plain = draw(0);
    CHECK(plain.row(0, 0, 8) == Pixels{0x4000, 0x4004, 0x4008, 0x400c, 0x4010, 0x4013, 0x4017, 0x401b});
    CHECK(plain.row(0, 1, 7) == Pixels{0x4080, 0x4084, 0x4088, 0x408c, 0x4090, 0x4093, 0x4097});
    CHECK(plain.row(0, 5, 3) == Pixels{0x4260, 0x4264, 0x4268});
    CHECK(plain.pixel(0, 7) == 0x4360);
    const Bench dithered = draw(0x200);
    CHECK(dithered.row(0, 0, 8) == Pixels{0x3c00, 0x4004, 0x3c07, 0x400c, 0x3c0f, 0x4013, 0x3c17, 0x401c});
    CHECK(dithered.row(0, 1, 7) == Pixels{0x4080, 0x3c63, 0x4088, 0x3c6b, 0x4090, 0x3c73, 0x4098});
    CHECK(dithered.row(0, 2, 6) == Pixels{0x3ce0, 0x4104, 0x3ce7, 0x410c, 0x3cef, 0x4114});
    CHECK(dithered.row(0, 3, 5) == Pixels{0x4180, 0x3d63, 0x4188, 0x3d6b, 0x4190});
    CHECK(dithered.pixel(0, 7) == 0x4380);
  }

  TEST_CASE("Dither turns a constant colour into a pattern of its two neighbours") {
    const auto quad = [](std::uint32_t colour) {
      Bench bench;
      bench.send(
          {0xe1000200, 0x38000000 | colour, at(0, 0), colour, at(4, 0), colour, at(0, 4), colour, at(4, 4)});
      return bench;
    };
    const Bench grey = quad(0x808080);
    for (const int y : {0, 2}) CHECK(grey.row(0, y, 4) == Pixels{0x3def, 0x4210, 0x3def, 0x4210});
    for (const int y : {1, 3}) CHECK(grey.row(0, y, 4) == Pixels{0x4210, 0x3def, 0x4210, 0x3def});
    CHECK(quad(0x030303).count() == 0);
    CHECK(quad(0xffffff).row(0, 2, 4) == Pixels{0x7fff, 0x7fff, 0x7fff, 0x7fff});
  }

  TEST_CASE("An inexact gradient truncates once and is not clamped") {
    const Bench bench;
    bench.send({0x30000000, at(0, 0), 0xff, at(7, 0), 100, at(0, 3)});
    const auto level = [](int red8) { return static_cast<std::uint16_t>(red8 >> 3); };
    CHECK(bench.row(0, 0, 7) ==
          Pixels{level(0), level(36), level(73), level(109), level(146), level(182), level(219)});
    CHECK(bench.row(0, 1, 5) == Pixels{level(33), level(70), level(106), level(143), level(179)});
    CHECK(bench.row(0, 2, 3) == Pixels{level(67), level(103), level(140)});
  }

  TEST_CASE("The captured gouraud triangle is drawn to the last pixel") {
    Bench bench;
    bench.send({0x300000ff, at(40, 223), 0x00ff00, at(280, 223), 0xff0000, at(160, 16)});
    CHECK(bench.count() == 24720);
    CHECK(bench.pixel(160, 16) == 0);
    CHECK(bench.pixel(160, 17) == 0x7c00);
    CHECK(bench.pixel(160, 120) == 0x3d08);
    CHECK(bench.pixel(100, 200) == 0x0cd6);
    CHECK(bench.pixel(41, 222) == 0x001f);
    CHECK(bench.pixel(278, 222) == 0x03e0);
    CHECK(bench.pixel(160, 222) == 0x01ef);
    CHECK(bench.fnv1a() == 0xcec43cb5);
    Bench lower;
    lower.send({0xe1000200, 0xe5000000 | 240 << 11, 0x300000ff, at(40, 223), 0x00ff00, at(280, 223), 0xff0000,
                at(160, 16)});
    CHECK(lower.row(160, 360, 4) == Pixels{0x3ce7, 0x3d07, 0x3ce7, 0x4107});
    CHECK(lower.pixel(160, 361) == 0x4108);
    CHECK(lower.pixel(100, 440) == 0x0cb5);
    CHECK(lower.fnv1a() == 0x41e9771b);
  }

  TEST_CASE("A textured quad reads the texels the console reads") {
    CHECK(mapped(4, 4, 0, 4, 0, 4).row(0, 1, 4) == Pixels{33, 34, 35, 36});
    CHECK(mapped(4, 4, 4, 0, 0, 4).row(0, 0, 4) == Pixels{5, 4, 3, 2});
    CHECK(mapped(8, 8, 0, 4, 0, 4).row(0, 0, 8) == Pixels{1, 2, 2, 3, 3, 4, 4, 5});
    CHECK(mapped(8, 8, 0, 4, 0, 4).pixel(0, 5) == 1 + 32 * 3);
    CHECK(mapped(5, 5, 0, 7, 0, 7).row(0, 0, 5) == Pixels{1, 2, 4, 5, 7});
    const Bench sheared = textured({{0, 0, 0, 0}, {6, 1, 8, 0}, {1, 6, 0, 8}, {7, 7, 8, 8}});
    CHECK(sheared.row(1, 1, 5) == Pixels{0x22, 0x24, 0x25, 0x06, 0x08});
    CHECK(sheared.row(1, 2, 6) == Pixels{0x62, 0x43, 0x45, 0x46, 0x47, 0x29});
    CHECK(sheared.row(1, 3, 6) == Pixels{0x82, 0x83, 0x64, 0x66, 0x67, 0x69});
    CHECK(sheared.row(1, 4, 6) == Pixels{0xa1, 0xa3, 0xa4, 0xa6, 0x87, 0x88});
    CHECK(sheared.row(1, 5, 6) == Pixels{0xe1, 0xc3, 0xc4, 0xc5, 0xc7, 0xa8});
    CHECK(sheared.row(1, 6, 6) == Pixels{0x101, 0x102, 0x104, 0xe5, 0xe6, 0xe8});
  }

  TEST_CASE("A sprite copies texels, flips from an odd one, and repeats inside its window") {
    const auto sprite = [](std::uint32_t mode, std::uint32_t window, int u, int v, int w, int h) {
      Bench bench;
      bench.numbered_page();
      bench.send({0xe1000000 | page_640_15bit | mode, 0xe2000000 | window, 0x65000000, at(0, 0), uv(u, v),
                  at(w, h)});
      return bench;
    };
    const Bench plain = sprite(0, 0, 2, 1, 4, 2);
    CHECK(plain.row(0, 0, 5) == Pixels{0x23, 0x24, 0x25, 0x26, 0});
    CHECK(plain.row(0, 1, 4) == Pixels{0x43, 0x44, 0x45, 0x46});
    const Bench flipped = sprite(1 << 12, 0, 4, 1, 6, 2);
    CHECK(flipped.row(0, 0, 6) == Pixels{0x26, 0x25, 0x24, 0x23, 0x22, 0x21});
    CHECK(flipped.pixel(0, 1) == 0x46);
    const Bench upside_down = sprite(1 << 13, 0, 4, 2, 4, 3);
    CHECK(upside_down.pixel(0, 0) == 0x45);
    CHECK(upside_down.pixel(0, 1) == 0x25);
    CHECK(upside_down.pixel(0, 2) == 0x05);
    CHECK(sprite(0, 0x421, 0, 0, 18, 1).row(0, 0, 18) ==
          Pixels{9, 10, 11, 12, 13, 14, 15, 16, 9, 10, 11, 12, 13, 14, 15, 16, 0x19, 0x1a});
  }

  TEST_CASE("4-bit texels name palette entries, the lowest nibble leftmost, and entry 0000h draws nothing") {
    Bench bench;
    bench.gpu->vram().at(640, 0) = 0x3210;
    for (int i = 1; i < 16; ++i) bench.gpu->vram().at(16 + i, 256) = static_cast<std::uint16_t>(0x100 + i);
    bench.gpu->vram().at(100, 100) = 0x1234;
    bench.send({0xe1000000 | 10, 0x65000000, at(100, 100), uv(0, 0, 0x4001), at(4, 1)});
    CHECK(bench.row(100, 100, 4) == Pixels{0x1234, 0x101, 0x102, 0x103});
  }

  TEST_CASE("A line steps one pixel along its longer axis and draws both ends") {
    CHECK(line(0, 0, 7, 3) == "(0,0)(1,0)(2,1)(3,1)(4,2)(5,2)(6,3)(7,3)");
    CHECK(line(7, 3, 0, 0) == "(0,0)(1,0)(2,1)(3,1)(4,2)(5,2)(6,3)(7,3)");
    CHECK(line(0, 3, 7, 0) == "(6,0)(7,0)(4,1)(5,1)(2,2)(3,2)(0,3)(1,3)");
    CHECK(line(0, 0, 3, 7) == "(0,0)(0,1)(1,2)(1,3)(2,4)(2,5)(3,6)(3,7)");
    CHECK(line(3, 7, 0, 0) == line(0, 0, 3, 7));
    CHECK(line(0, 0, 2, 1) == "(0,0)(1,1)(2,1)");
    CHECK(line(0, 0, 1, 2) == "(0,0)(0,1)(1,2)");
    CHECK(line(0, 0, 4, 2) == "(0,0)(1,1)(2,1)(3,2)(4,2)");
    CHECK(line(0, 2, 4, 0) == "(3,0)(4,0)(1,1)(2,1)(0,2)");
    CHECK(line(0, 0, 2, 4) == "(0,0)(0,1)(1,2)(1,3)(2,4)");
    CHECK(line(2, 0, 0, 4) == "(2,0)(1,1)(1,2)(0,3)(0,4)");
    CHECK(line(0, 0, 6, 1) == "(0,0)(1,0)(2,0)(3,1)(4,1)(5,1)(6,1)");
    CHECK(line(0, 1, 6, 0) == "(3,0)(4,0)(5,0)(6,0)(0,1)(1,1)(2,1)");
    CHECK(line(0, 0, 1, 6) == "(0,0)(0,1)(0,2)(0,3)(1,4)(1,5)(1,6)");
    CHECK(line(1, 0, 0, 6) == "(1,0)(1,1)(1,2)(0,3)(0,4)(0,5)(0,6)");
    CHECK(line(5, 5, 5, 5) == "(5,5)");
  }

  TEST_CASE("A gouraud line steps its colour, and a polyline draws its joints twice") {
    Bench bench;
    bench.send({0x50000000, at(0, 0), 0xff, at(7, 0)});
    CHECK(bench.row(0, 0, 8) ==
          Pixels{0, 36 >> 3, 73 >> 3, 109 >> 3, 146 >> 3, 182 >> 3, 219 >> 3, 255 >> 3});
    Bench joint;
    joint.send({0xe1000020, 0x4a080808, at(0, 0), at(3, 0), at(3, 2), 0x55555555});
    CHECK(joint.row(0, 0, 4) == Pixels{0x421, 0x421, 0x421, 0x842});
    CHECK(joint.pixel(3, 1) == 0x421);
    CHECK(joint.pixel(3, 2) == 0x421);
  }

  TEST_CASE("The four blend modes mix each channel as the console does") {
    struct Mix {
      int b, f;
      std::array<int, 4> result;
    };
    for (const Mix& mix :
         {Mix{31, 30, {30, 31, 1, 31}}, Mix{10, 25, {17, 31, 0, 16}}, Mix{20, 20, {20, 31, 0, 25}},
          Mix{5, 31, {18, 31, 0, 12}}, Mix{31, 3, {17, 31, 28, 31}}, Mix{0, 1, {0, 1, 0, 0}}}) {
      for (std::uint32_t mode = 0; mode < 4; ++mode) {
        Bench bench;
        const auto grey = [](int level) {
          return static_cast<std::uint16_t>(level | level << 5 | level << 10);
        };
        bench.gpu->vram().at(0, 0) = grey(mix.b);
        bench.send(
            {0xe1000000 | mode << 5, 0x6a000000 | static_cast<std::uint32_t>(mix.f * 0x080808), at(0, 0)});
        CHECK(bench.pixel(0, 0) == grey(mix.result[mode]));
      }
    }
  }

  TEST_CASE("A semi-transparent dot mixes with what is there; the old mask bit takes no part") {
    const std::array<std::uint16_t, 4> expected{0x1e54, 0x3fff, 0x14a0, 0x2f31};
    for (std::uint32_t mode = 0; mode < 4; ++mode) {
      Bench bench;
      bench.gpu->vram().at(0, 0) = 0xaaaa;
      bench.send({0xe1000000 | mode << 5, 0x6a2880f8, at(0, 0)});
      CHECK(bench.pixel(0, 0) == expected[mode]);
    }
  }

  TEST_CASE("Bit 15 of a texel decides whether it is mixed, and texel 0000h is never drawn") {
    const auto dot = [](std::uint32_t opcode, std::uint16_t texel, std::uint32_t mode,
                        std::uint16_t back = 0x7fff, std::uint32_t colour = 0) {
      Bench bench;
      bench.gpu->vram().at(640, 0) = texel;
      bench.gpu->vram().at(0, 0) = back;
      bench.send({0xe1000000 | page_640_15bit | mode << 5, opcode << 24 | colour, at(0, 0), uv(0, 0)});
      return bench.pixel(0, 0);
    };
    const std::array<std::uint16_t, 4> lit{0xce73, 0xffff, 0xdef7, 0xffff},
        black{0xbdef, 0xffff, 0xffff, 0xffff};
    for (std::uint32_t mode = 0; mode < 4; ++mode) {
      CHECK(dot(0x6f, 0xa108, mode) == lit[mode]);
      CHECK(dot(0x6f, 0x2108, mode) == 0x2108);
      CHECK(dot(0x6f, 0x8000, mode) == black[mode]);
      CHECK(dot(0x6f, 0x0000, mode) == 0x7fff);
    }
    CHECK(dot(0x6d, 0xa108, 0) == 0xa108);
    CHECK(dot(0x6e, 0xa108, 1, 0x1084, 0xffff40) == 0xce68);
    struct Product {
      std::uint16_t texel, result;
      std::uint32_t colour;
    };
    for (const Product p :
         {Product{31, 31, 0x80}, Product{31, 31, 0xff}, Product{31, 15, 0x40}, Product{16, 16, 0x80},
          Product{1, 0, 0x7f}, Product{20, 31, 0xc8}, Product{3, 2, 0x5a}}) {
      CHECK(dot(0x6c, p.texel, 0, 0x7fff, p.colour) == p.result);
    }
  }

  TEST_CASE("Mask bits are set on what is drawn and protect what is there") {
    Bench bench;
    bench.gpu->vram().at(0, 0) = 0x8000;
    bench.send({0xe6000003, 0x60ffffff, at(0, 0), at(2, 1)});
    CHECK(bench.row(0, 0, 2) == Pixels{0x8000, 0xffff});
    Bench set;
    set.send({0xe6000001, 0x68ffffff, at(0, 0)});
    CHECK(set.pixel(0, 0) == 0xffff);
  }

  TEST_CASE("A fill is cut to blocks of 16, wraps at both edges, and is empty at a full turn") {
    Bench bench;
    bench.send({0x02ffffff, at(0x1b, 0), at(0x11, 1)});
    CHECK(bench.rows(64) == "0: 16..47");
    Bench around;
    around.send({0x02ffffff, at(0x3f0, 0x1ff), at(0x3f1, 2)});
    CHECK(around.count() == 2048);
    CHECK(around.row(1020, 511, 8) == Pixels(8, 0x7fff));
    CHECK(around.pixel(500, 0) == 0x7fff);
    Bench nothing;
    nothing.send({0x02ffffff, 0, at(0x400, 8), 0x02ffffff, 0, at(16, 0x200)});
    CHECK(nothing.count() == 0);
  }

  TEST_CASE("A copy reads 128 pixels of a row before it writes them, so a wide one repeats what it wrote") {
    // 300 pixels 1, 2, 3 ... moved to the right by 6: pixels 128..133 are overwritten before they are read.
    Bench bench;
    const auto at_first = [](int x) { return static_cast<std::uint16_t>(x < 300 ? x + 1 : 0); };
    for (int x = 0; x < 300; ++x) bench.gpu->vram().at(x, 0) = at_first(x);
    bench.send({0x80000000, at(0, 0), at(6, 0), at(300, 1)});
    CHECK(bench.row(0, 0, 7) == Pixels{1, 2, 3, 4, 5, 6, 1});
    CHECK(bench.row(128, 0, 4) == Pixels{123, 124, 125, 126});
    CHECK(bench.row(134, 0, 7) == Pixels{123, 124, 125, 126, 127, 128, 135});
    CHECK(bench.row(262, 0, 7) == Pixels{251, 252, 253, 254, 255, 256, 263});
    CHECK(bench.row(305, 0, 2) == Pixels{300, 0});
    // To the left nothing is overwritten before it is read, nor where the copy is no wider than 128.
    Bench left;
    for (int x = 0; x < 300; ++x) left.gpu->vram().at(x, 0) = at_first(x);
    left.send({0x80000000, at(6, 0), at(0, 0), at(294, 1), 0x80000000, at(0, 0), at(6, 0), at(128, 1)});
    CHECK(left.row(0, 0, 7) == Pixels{7, 8, 9, 10, 11, 12, 7});
    CHECK(left.row(130, 0, 5) == Pixels{131, 132, 133, 134, 141});
    CHECK(left.row(293, 0, 2) == Pixels{300, 295});
  }

  TEST_CASE("A copy reads a row before it writes it, and smears from row to row") {
    Bench bench;
    for (int i = 0; i < 6; ++i) bench.gpu->vram().at(i, 0) = static_cast<std::uint16_t>(i + 1);
    bench.send({0x80000000, at(0, 0), at(2, 0), at(4, 1)});
    CHECK(bench.row(0, 0, 8) == Pixels{1, 2, 1, 2, 3, 4, 0, 0});
    Bench smear;
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) smear.gpu->vram().at(x, y) = static_cast<std::uint16_t>(16 * y + 1 + x);
    }
    smear.send({0x80000000, at(0, 0), at(0, 1), at(4, 3)});
    for (int y = 0; y < 4; ++y) CHECK(smear.row(0, y, 4) == Pixels{1, 2, 3, 4});
  }

  TEST_CASE("A triangle wider than 1023 or higher than 511 is not drawn at all") {
    const auto pixels = [](int x0, int y2) {
      Bench bench;
      bench.send({0x20ffffff, at(x0, 0), at(1023, 0), at(0, y2)});
      return bench.count();
    };
    CHECK(pixels(0, 511) == 262143);
    CHECK(pixels(-1, 511) == 0);
    CHECK(pixels(0, 512) == 0);
  }

  TEST_CASE("A line higher than 511 is not drawn at all, a shorter one is clipped") {
    Bench bench;
    bench.send({0x40ffffff, at(0, -300), at(0, 300)});
    CHECK(bench.count() == 0);
    bench.send({0x40ffffff, at(0, -100), at(0, 400)});
    CHECK(bench.count() == 401);
  }
}
