// What must hold whatever the registers are, and the division over all its inputs.

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>

#include "gte/batch.h"
#include "gte/commands.h"
#include "gte/divide.h"
#include "tests/gte/random_registers.h"

namespace {

using tests::Kind;
using tests::Random;

constexpr int rounds = 20'000;

gte::Registers any(Random& random) {
  return tests::registers(random, static_cast<Kind>(random.below(static_cast<std::uint32_t>(Kind::count))));
}

/// The division as docs/hardware.md#unr-table has it, step by step and in 64 bits, sharing
/// nothing with the one under test.
gte::Quotient plain_division(std::uint64_t h, std::uint64_t sz) {
  if (h >= 2 * sz) return {0x1ffff, true};
  unsigned z = 0;
  while (((sz << z) & 0x8000) == 0) ++z;
  const std::uint64_t n = h << z, d = sz << z, k = (d - 0x7fc0) >> 7;
  const std::int64_t entry = (0x40000 / (static_cast<std::int64_t>(k) + 0x100) + 1) / 2 - 0x101;
  const std::uint64_t u = static_cast<std::uint64_t>(std::max<std::int64_t>(0, entry)) + 0x101;
  const std::uint64_t e = (0x2000080 - d * u) >> 8;
  const std::uint64_t f = (0x80 + e * u) >> 8;
  return {static_cast<std::uint32_t>(std::min<std::uint64_t>(0x1ffff, (n * f + 0x8000) >> 16)), false};
}

std::uint64_t sum_over_depths(std::uint16_t h, int& overflows) {
  std::uint64_t sum = 0;
  for (unsigned sz = 0; sz < 0x10000; ++sz) {
    const gte::Quotient q = gte::divide(h, static_cast<std::uint16_t>(sz));
    sum += q.value;
    overflows += q.overflow ? 1 : 0;
  }
  return sum;
}

}  // namespace

TEST_SUITE("gte") {
  TEST_CASE("the reciprocal table is its formula") {
    CHECK(gte::reciprocal_table[0] == 0xff);
    CHECK(gte::reciprocal_table[1] == 0xfd);
    CHECK(gte::reciprocal_table[8] == 0xef);
    CHECK(gte::reciprocal_table[9] == 0xee);
    CHECK(gte::reciprocal_table[127] == 0x55);
    CHECK(gte::reciprocal_table[128] == 0x54);
    CHECK(gte::reciprocal_table[255] == 0);
    CHECK(gte::reciprocal_table[256] == 0);
    int sum = 0;
    for (const std::uint8_t entry : gte::reciprocal_table) sum += entry;
    CHECK(sum == 25186);
  }

  TEST_CASE("the division gives the examples of its formula") {
    struct {
      unsigned h, sz, q;
      bool overflow;
    } const rows[] = {{5, 0, 0x1ffff, true},
                      {0, 0, 0x1ffff, true},
                      {0, 1, 0, false},
                      {1, 1, 0x10000, false},
                      {1, 2, 0x8000, false},
                      {0x7fff, 0x4000, 0x1fffc, false},
                      {0x8000, 0x4000, 0x1ffff, true},
                      {0xffff, 0x8000, 0x1fffe, false},
                      {320, 1000, 0x51ec, false},
                      {199, 100, 0x1fd71, false},
                      {200, 100, 0x1ffff, true},
                      {1000, 501, 0x1fefb, false},
                      {0xffff, 0xffff, 0xffff, false},
                      {0xfe3f, 0x7f20, 0x1ffff, false},
                      {0xf015, 0x780b, 0x1ffff, false}};
    for (const auto& row : rows) {
      CAPTURE(row.h);
      CAPTURE(row.sz);
      const gte::Quotient q =
          gte::divide(static_cast<std::uint16_t>(row.h), static_cast<std::uint16_t>(row.sz));
      CHECK(q.value == row.q);
      CHECK(q.overflow == row.overflow);
    }
  }

  TEST_CASE("the quotients of a whole row of depths have the formula's sums") {
    struct {
      std::uint16_t h;
      std::uint64_t sum;
      int overflows;
    } const rows[] = {{320, 147184365, 161}, {512, 219685545, 257}, {1000, 385137247, 501}};
    for (const auto& row : rows) {
      int overflows = 0;
      CHECK(sum_over_depths(row.h, overflows) == row.sum);
      CHECK(overflows == row.overflows);
    }
  }

  // The SIMD division sees each pair through RTPS: with RT33 = 1.0, SZ3 is VZ0 or VZ0 + 8000h, and OFX = 0,
  // IR1 = 1 give SX = q >> 16 and the fraction its next 8 bits; IR1 = 256 and less than 4 give the rest.
  TEST_CASE("long: the division is the formula's for all 2^32 inputs, on every target" * doctest::skip()) {
    std::vector<gte::Vertex> vertices(0x10000);
    std::vector<std::uint32_t> flags(vertices.size());
    std::vector<gte::ScreenXy> sxy(vertices.size());
    std::vector<std::uint8_t> fx(vertices.size()), fy(vertices.size());
    for (unsigned i = 0; i < 0x10000; ++i)
      vertices[i] = {1, 256, static_cast<std::int16_t>(static_cast<int>(i) - 0x8000), 0};
    const auto targets = gte::batch_targets();
    std::uint64_t wrong = 0;
    for (unsigned h = 0; h < 0x10000; ++h) {
      gte::Registers setup;
      setup.rt[0][0] = setup.rt[1][1] = setup.rt[2][2] = gte::S3_12::of(1.0);
      setup.tr[2] = 0x8000;
      setup.h = static_cast<std::uint16_t>(h);
      for (const char* target : targets) {
        if (std::string_view(target) == "scalar") continue;
        gte::use_batch_target(target);
        gte::project(
            setup, vertices,
            {.sxy = sxy.data(), .flag = flags.data(), .fraction_x = fx.data(), .fraction_y = fy.data()});
        for (unsigned sz = 0; sz < 0x10000; ++sz) {
          const gte::Quotient q = gte::divide(setup.h, static_cast<std::uint16_t>(sz));
          const std::uint32_t seen = static_cast<std::uint32_t>(sxy[sz].y & 0x1ff) << 8 | fy[sz];
          const std::uint32_t upper = static_cast<std::uint32_t>(sxy[sz].x & 1) << 8 | fx[sz];
          const bool overflow = (flags[sz] & gte::flag::divide_overflow) != 0;
          wrong += seen != q.value || upper != q.value >> 8 || overflow != q.overflow ? 1 : 0;
        }
      }
      for (unsigned sz = 0; sz < 0x10000; ++sz) {
        const gte::Quotient q = gte::divide(setup.h, static_cast<std::uint16_t>(sz)),
                            plain = plain_division(h, sz);
        wrong += q.value != plain.value || q.overflow != plain.overflow ? 1 : 0;
      }
    }
    gte::use_batch_target(targets.front());
    CHECK(wrong == 0);
  }

  TEST_CASE("the division is the formula's for random inputs and all powers of two with their neighbours") {
    Random random(7);
    const auto edge = [&] {
      const std::uint32_t v = 1u << random.below(17);
      return static_cast<std::uint16_t>(random.below(2) == 0 ? random.word() >> 16 : v + random.below(3) - 1);
    };
    for (int i = 0; i < 500'000; ++i) {
      const std::uint16_t h = edge(), sz = edge();
      const gte::Quotient q = gte::divide(h, sz), plain = plain_division(h, sz);
      if (q.value != plain.value || q.overflow != plain.overflow) FAIL("H ", h, " SZ3 ", sz);
    }
  }

  TEST_CASE("after any command FLAG has bit 31 iff an error bit is set, and no bit below 12") {
    Random random(1);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r = any(random);
      gte::execute(r, random.word());
      REQUIRE((r.flag & 0xfff) == 0);
      REQUIRE(((r.flag >> 31) != 0) == ((r.flag & 0x7f87e000u) != 0));
    }
  }

  TEST_CASE("RTPS keeps its outputs inside their limits and FIFOs in order, whatever goes in") {
    Random random(2);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r = any(random);
      const gte::Registers before = r;
      const gte::Command c = random.word();
      gte::rtps(r, c);
      REQUIRE(r.sxy[0] == before.sxy[1]);
      REQUIRE(r.sxy[1] == before.sxy[2]);
      REQUIRE(r.sz[0] == before.sz[1]);
      REQUIRE(r.sz[1] == before.sz[2]);
      REQUIRE(r.sz[2] == before.sz[3]);
      REQUIRE(r.sxy[2].x >= -0x400);
      REQUIRE(r.sxy[2].x <= 0x3ff);
      REQUIRE(r.sxy[2].y >= -0x400);
      REQUIRE(r.sxy[2].y <= 0x3ff);
      REQUIRE(r.ir[0] >= 0);
      REQUIRE(r.ir[0] <= 0x1000);
      if (c.lm()) REQUIRE(std::min({r.ir[1], r.ir[2], r.ir[3]}) >= 0);
    }
  }

  TEST_CASE("RTPT is three times RTPS but for the depth cue of the first two") {
    Random random(3);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers triple = any(random), single = triple;
      const gte::Command c = random.word();
      gte::rtpt(triple, c);
      std::uint32_t gathered = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        gte::Registers without_cue = single;
        without_cue.v[0] = triple.v[k];
        if (k < 2) without_cue.dqa.raw = 0, without_cue.dqb.raw = 0;
        gte::rtps(without_cue, c);
        gathered |= without_cue.flag;
        without_cue.dqa = triple.dqa;
        without_cue.dqb = triple.dqb;
        single = without_cue;
      }
      single.v = triple.v;
      single.flag = gathered;
      REQUIRE(triple == single);
    }
  }

  TEST_CASE("exchanging two vertices changes the sign of NCLIP") {
    Random random(4);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r;
      for (auto& xy : r.sxy) {
        xy = {static_cast<std::int16_t>(random.between(-1024, 1023)),
              static_cast<std::int16_t>(random.between(-1024, 1023))};
      }
      gte::nclip(r);
      const std::int32_t area = r.mac[0];
      std::swap(r.sxy[random.below(2)], r.sxy[2]);
      gte::nclip(r);
      REQUIRE(r.mac[0] == -area);
      REQUIRE(r.flag == 0);
    }
  }

  TEST_CASE("AVSZ3 and AVSZ4 do not fall when a depth rises, for a scale that is not negative") {
    Random random(5);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r;
      for (auto& sz : r.sz) sz = static_cast<std::uint16_t>(random.below(0xffff));
      r.zsf3.raw = r.zsf4.raw = static_cast<std::int16_t>(random.below(0x8000));
      gte::Registers higher = r;
      ++higher.sz[1 + random.below(3)];
      const auto average = random.below(2) == 0 ? gte::avsz3 : gte::avsz4;
      average(r, {});
      average(higher, {});
      REQUIRE(higher.otz >= r.otz);
    }
  }

  TEST_CASE("AVSZ3 ignores SZ0, sf and lm") {
    Random random(6);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r = any(random), other = r;
      other.sz[0] = static_cast<std::uint16_t>(random.word());
      gte::avsz3(r, 0);
      gte::avsz3(other, 0xffffffff);
      REQUIRE(r.otz == other.otz);
      REQUIRE(r.mac[0] == other.mac[0]);
      REQUIRE(r.flag == other.flag);
    }
  }

  TEST_CASE("every register reads back what its format keeps of a write") {
    Random random(8);
    for (int i = 0; i < rounds; ++i) {
      gte::Registers r = any(random);
      const gte::Registers copy = [&] {
        gte::Registers c;
        for (unsigned n = 0; n < 64; ++n) {
          if (n != 15 && n != 28) gte::write(c, n, gte::read(r, n));
        }
        return c;
      }();
      for (unsigned n = 0; n < 64; ++n) REQUIRE(gte::read(copy, n) == gte::read(r, n));
    }
  }
}
