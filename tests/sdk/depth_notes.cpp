#include "sdk/depth_notes.h"

#include <doctest/doctest.h>

#include <array>
#include <span>

#include "gte/batch.h"
#include "tests/random.h"

TEST_SUITE("sdk") {
  namespace {

  /// Looks along z with H 100: a vertex (x, y, z) is seen at (100 x / z, 100 y / z).
  gte::Registers camera() {
    gte::Registers r;
    for (std::size_t i = 0; i < 3; ++i) r.rt[i][i].raw = 4096;
    r.h = 100;
    return r;
  }

  /// Notes and a program's view of them: project, then store where the program likes.
  struct Program {
    sdk::DepthNotes notes;
    gte::Registers gte = camera();

    Program() { notes.start(); }
    std::uint32_t project(std::int16_t x, std::int16_t y, std::int16_t z) {
      gte.v[0] = {x, y, z, 0};
      notes.project(gte, gte::sdk::rtps);
      gte::execute(gte, gte::sdk::rtps);
      return gte::read(gte, 14);
    }
    void store(std::uint32_t address) { notes.store(address, gte::read(gte, 14), 2); }
  };

  constexpr std::uint32_t flat_triangle = 0x20000000, tag = 0x20000, packet = tag + 4;
  constexpr std::uint32_t one = 4096;  // of 20.12

  /// A flat triangle with three vertices of depth 200, 300 and 400, stored where the packet has them.
  std::array<std::uint32_t, 4> stored_triangle(Program& program) {
    std::array<std::uint32_t, 4> words{flat_triangle};
    for (std::uint32_t i = 0; i < 3; ++i) {
      words[i + 1] =
          program.project(static_cast<std::int16_t>(10 * i), 5, static_cast<std::int16_t>(200 + 100 * i));
      program.store(packet + 4 + 4 * i);
    }
    return words;
  }

  }  // namespace

  TEST_CASE("a polygon whose positions lie where they were stored has the depth of each vertex") {
    Program program;
    const auto words = stored_triangle(program);
    const auto found = program.notes.find(words, packet);
    REQUIRE(found);
    CHECK(found->count == 3);
    CHECK(found->z == std::array<std::uint32_t, 4>{200 * one, 300 * one, 400 * one, 0});
    CHECK(found->has_fractions);
    CHECK(program.notes.shares().by_address == 1);
  }

  TEST_CASE("the fractions of a position are those below its whole pixels") {
    Program program;
    program.project(10, 5, 300);  // x = 1000 / 300 = 3.33, y = 1.67
    std::array<std::uint32_t, 4> words{flat_triangle};
    for (std::uint32_t i = 1; i < 4; ++i) {
      words[i] = gte::read(program.gte, 14);
      program.store(packet + 4 * i);
    }
    const auto found = program.notes.find(words, packet);
    REQUIRE(found);
    CHECK(found->fx[0] == 85);   // .33 of 256
    CHECK(found->fy[0] == 170);  // .67 of 256
  }

  TEST_CASE("a packet keeps its depth for as many lists as it keeps its positions") {
    Program program;
    const auto words = stored_triangle(program);
    for (int list = 0; list < 5; ++list) program.notes.next_list();
    CHECK(program.notes.find(words, packet));
  }

  TEST_CASE("a word that was written over since is not taken for a vertex") {
    Program program;
    auto words = stored_triangle(program);
    words[2] ^= 1;
    CHECK_FALSE(program.notes.find(words, packet));
    CHECK(program.notes.shares().stale == 1);
    CHECK(program.notes.shares().partly == 1);
  }

  TEST_CASE("positions that were copied elsewhere are found by their value") {
    Program program;
    const auto words = stored_triangle(program);
    const auto found = program.notes.find(words, packet + 0x1000);
    REQUIRE(found);
    CHECK(found->z[2] == 400 * one);
    CHECK(program.notes.shares().by_value == 1);
  }

  TEST_CASE("values live for two lists") {
    Program program;
    const auto words = stored_triangle(program);
    program.notes.next_list();
    CHECK(program.notes.find(words, packet + 0x1000));
    program.notes.next_list();
    CHECK_FALSE(program.notes.find(words, packet + 0x1000));
  }

  TEST_CASE("a value that stood for two depths stands for none") {
    Program program;
    program.project(0, 0, 200);
    program.store(packet + 4);
    program.project(0, 0, 300);
    program.store(packet + 8);
    const std::array<std::uint32_t, 4> words{flat_triangle, 0, 0, 0};
    CHECK_FALSE(program.notes.find(words, packet + 0x1000));
    CHECK(program.notes.shares().ambiguous == 1);
  }

  TEST_CASE("a billboard has the depth of the vertex projected last before it was linked") {
    Program program;
    program.project(0, 0, 500);
    program.store(0x30000);
    program.notes.link(tag);
    const std::array<std::uint32_t, 4> words{flat_triangle, 0x00100010, 0x00100020, 0x00200010};
    const auto found = program.notes.find(words, packet);
    REQUIRE(found);
    CHECK(found->z == std::array<std::uint32_t, 4>{500 * one, 500 * one, 500 * one, 500 * one});
    CHECK_FALSE(found->has_fractions);
    CHECK(program.notes.shares().by_packet == 1);
  }

  TEST_CASE("a packet linked after another, with no projection between, has no depth of that kind") {
    Program program;
    program.project(0, 0, 500);
    program.notes.link(0x40000);
    program.notes.link(tag);
    const std::array<std::uint32_t, 4> words{flat_triangle, 0x00100010, 0x00100020, 0x00200010};
    CHECK_FALSE(program.notes.find(words, packet));
    CHECK(program.notes.shares().none == 1);
  }

  TEST_CASE("a position that the program wrote into the screen FIFO has no depth") {
    Program program;
    program.project(0, 0, 500);
    program.notes.write_position(15);
    program.store(packet + 4);
    const std::array<std::uint32_t, 4> words{flat_triangle, 0, 0, 0};
    CHECK_FALSE(program.notes.find(words, packet));
  }

  TEST_CASE("nothing is found before notes are started") {
    sdk::DepthNotes notes;
    const std::array<std::uint32_t, 4> words{flat_triangle};
    CHECK_FALSE(notes.find(words, packet));
    CHECK(notes.shares() == sdk::DepthShares{});
  }

  TEST_CASE("the quick way to an exact position makes what the batch door does, or leaves it to that") {
    tests::Random random(14);
    const auto some = [&random](std::int32_t limit) {
      switch (random.below(4)) {
        case 0:
          return random.between(-limit - 1, limit);
        case 1:
          return random.between(-8, 8);
        case 2:
          return limit;
        default:
          return -limit - 1;
      }
    };
    int quick = 0;
    for (int n = 0; n < 20000; ++n) {
      gte::Registers r;
      for (auto& row : r.rt) {
        for (auto& entry : row) entry.raw = static_cast<std::int16_t>(some(0x7fff));
      }
      for (auto& t : r.tr) t = some(random.below(2) == 0 ? 0x7fffffff - 1 : 0x7fffff);
      r.ofx.raw = some(0x7fffffff - 1);
      r.ofy.raw = some(0x7fffffff - 1);
      r.h = static_cast<std::uint16_t>(random.below(0x10000));
      const gte::Vertex v{static_cast<std::int16_t>(some(0x7fff)), static_cast<std::int16_t>(some(0x7fff)),
                          static_cast<std::int16_t>(some(0x7fff)), 0};
      const gte::Command command{random.below(2) << 19 | random.below(2) << 10 | 1};
      const auto exact = sdk::exact_position(r, v, command);
      if (!exact) continue;
      ++quick;
      sdk::ExactPosition expected;
      gte::ProjectOut out;
      out.z_20_12 = &expected.z;
      out.fraction_x = &expected.fx;
      out.fraction_y = &expected.fy;
      gte::project(r, std::span(&v, 1), out, command);
      REQUIRE(*exact == expected);
    }
    CHECK(quick > 3000);
  }
}
