#include "ot/gp1.h"

#include <doctest/doctest.h>

#include "ot/describe.h"

using namespace ot;
using gp1::Command;

TEST_SUITE("ot") {
  TEST_CASE("codes 40h-FFh of port 1 mirror 00h-3Fh, and what is not among them is unknown") {
    for (std::uint32_t code = 0; code < 256; ++code) {
      CAPTURE(code);
      const std::uint32_t own = code % 64;
      Command expected = Command::unknown;
      if (own < 10) expected = static_cast<Command>(own);
      if (own / 16 == 1) expected = Command::read_register;
      CHECK(gp1::command_of(code << 24 | 0xffffff) == expected);
      CHECK(gp1::aborts_command(code << 24) == (own < 2));
    }
  }

  TEST_CASE("a control word is made and read by the same fields") {
    CHECK(gp1::make(Command::reset) == 0);
    CHECK(gp1::display_off::make(true) == 0x03000001);
    CHECK(gp1::dma_direction::make(2) == 0x04000002);
    CHECK(gp1::display_start::make(320, 240) == 0x0503c140);
    CHECK(gp1::horizontal_range::make(0x260, 0xc60) == 0x06c60260);
    CHECK(gp1::vertical_range::make(16, 256) == 0x07040010);
    CHECK(gp1::display_start::X::get(0x0503c140) == 320);
    CHECK(gp1::display_start::Y::get(0x0503c140) == 240);
  }

  TEST_CASE("a display mode keeps each of the five widths") {
    using namespace gp1::display_mode;
    CHECK(put_width(256) == 0);
    CHECK(put_width(320) == 1);
    CHECK(put_width(512) == 2);
    CHECK(put_width(640) == 3);
    CHECK(put_width(368) == 0x40);
    for (const int pixels : {256, 320, 368, 512, 640}) {
      CHECK(width(gp1::display_mode::make(put_width(pixels) | Is480Lines::put(1))) == pixels);
    }
    CHECK(width(0x43) == 368);  // the bit of 368 outweighs the others
  }

  TEST_CASE("control words are told in words") {
    CHECK(describe_control(0) == "reset");
    CHECK(describe_control(0x03000001) == "display off");
    CHECK(describe_control(0x4503c140) == "display from 320,240");
    CHECK(describe_control(0x06c60260) == "horizontal range 608..3168");
    CHECK(describe_control(0x07040010) == "vertical range 16..256");
    CHECK(describe_control(0x0800003f) == "display mode 640 wide, 480 lines, PAL, 24 bit, interlaced");
    CHECK(describe_control(0x10000007) == "read register 7");
    CHECK(describe_control(0x20000000) == "unknown, nothing");
  }
}
