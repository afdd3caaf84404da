#include "ot/gp0.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace ot;
using gp0::Command;

TEST_SUITE("ot") {
  TEST_CASE("a field packs and unpacks the same bits") {
    using F = Field<5, 3>;
    CHECK(F::put(7) == 0xe0);
    CHECK(F::get(0xffffff5f) == 2);
    CHECK(F::set(0xffffffff, 0) == 0xffffff1f);
    CHECK(F::put(9) == 0x20);  // keeps the low bits, as a register would
  }

  TEST_CASE("a field of 32 bits is the whole word") {
    using F = Field<0, 32>;
    CHECK(F::put(0xdeadbeef) == 0xdeadbeef);
    CHECK(F::get(0xdeadbeef) == 0xdeadbeef);
  }

  TEST_CASE("a signed field extends its own top bit") {
    using F = Field<16, 11>;
    CHECK(F::get_signed(0x04000000) == -1024);
    CHECK(F::get_signed(0x03ff0000) == 1023);
    CHECK(F::get_signed(F::put_signed(-1)) == -1);
  }

  TEST_CASE("every opcode is the command that the table of opcodes says") {
    for (std::uint32_t op = 0; op < 256; ++op) {
      CAPTURE(op);
      Command expected = Command::nop;
      if (op == 0x01) expected = Command::clear_cache;
      if (op == 0x02) expected = Command::fill;
      if (op == 0x1f) expected = Command::irq;
      if (op >= 0x20 && op <= 0x3f) expected = Command::polygon;
      if (op >= 0x40 && op <= 0x5f) expected = (op & 8) != 0 ? Command::polyline : Command::line;
      if (op >= 0x60 && op <= 0x7f) expected = Command::rectangle;
      if (op >= 0x80 && op <= 0x9f) expected = Command::copy;
      if (op >= 0xa0 && op <= 0xbf) expected = Command::upload;
      if (op >= 0xc0 && op <= 0xdf) expected = Command::download;
      if (op == 0xe1) expected = Command::draw_mode;
      if (op == 0xe2) expected = Command::texture_window;
      if (op == 0xe3) expected = Command::area_top_left;
      if (op == 0xe4) expected = Command::area_bottom_right;
      if (op == 0xe5) expected = Command::draw_offset;
      if (op == 0xe6) expected = Command::mask_bits;
      if (op >= 0xe7 && op <= 0xef) expected = Command::annotation;
      CHECK(gp0::command_of(op << 24 | 0x123456) == expected);
    }
  }

  TEST_CASE("commands are as long as the SDK's packets") {
    struct Row {
      std::uint32_t opcode;
      std::size_t words;
    };
    // F3, FT3, G3, GT3, F4, FT4, G4, GT4, LINE_F2, LINE_G2, SPRT, SPRT_8, TILE, TILE_16, fill, copies, E1
    for (const Row row :
         {Row{0x20, 4},  Row{0x24, 7}, Row{0x30, 6}, Row{0x34, 9}, Row{0x28, 5}, Row{0x2c, 9}, Row{0x38, 8},
          Row{0x3c, 12}, Row{0x40, 3}, Row{0x50, 4}, Row{0x64, 4}, Row{0x74, 3}, Row{0x60, 3}, Row{0x78, 2},
          Row{0x02, 3},  Row{0x80, 4}, Row{0xa0, 3}, Row{0xc0, 3}, Row{0xe1, 1}, Row{0x00, 1}}) {
      CAPTURE(row.opcode);
      CHECK(gp0::command_words(row.opcode << 24) == row.words);
    }
  }

  TEST_CASE("a transfer of size 0 is 1024 by 512 pixels") {
    CHECK(gp0::transfer::width(0) == 1024);
    CHECK(gp0::transfer::height(0) == 512);
    CHECK(gp0::transfer::data_words(0) == 262144);
    CHECK(gp0::transfer::data_words(0x00030003) == 5);  // 9 pixels
    CHECK(gp0::transfer::data_words(0x02010401) == 1);  // 1 x 1
  }

  TEST_CASE("a polyline ends at any word with 5 in bits 12-15 and 28-31") {
    CHECK(gp0::line::is_terminator(0x55555555));
    CHECK(gp0::line::is_terminator(0x50005000));
    CHECK_FALSE(gp0::line::is_terminator(0x55550555));
    CHECK_FALSE(gp0::line::is_terminator(0x15555555));
  }
}
