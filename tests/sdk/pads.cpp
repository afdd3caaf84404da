#include "sdk/pads.h"

#include <doctest/doctest.h>

TEST_SUITE("sdk") {
  namespace {
  constexpr std::uint16_t up = 1 << 4, circle = 1 << 13, cross = 1 << 14;
  }

  TEST_CASE("a pad script says what is held from a frame on") {
    const auto script = sdk::parse_pad_script("30:UP+X,60:");
    REQUIRE(script);
    CHECK(sdk::at_frame(*script, 29).buttons == 0);
    CHECK(sdk::at_frame(*script, 30).buttons == (up | cross));
    CHECK(sdk::at_frame(*script, 59).buttons == (up | cross));
    CHECK(sdk::at_frame(*script, 60).buttons == 0);
  }

  TEST_CASE("a stick anywhere in the script makes the controller an analog one from the first frame on") {
    const auto script = sdk::parse_pad_script("10:LX=0+CIRCLE");
    REQUIRE(script);
    CHECK(sdk::at_frame(*script, 1).is_analog);
    const auto pad = sdk::at_frame(*script, 10);
    CHECK(pad.buttons == circle);
    CHECK(pad.sticks == std::array<std::uint8_t, 4>{128, 128, 0, 128});
  }

  TEST_CASE("a script written out reads back as the same script") {
    for (const char* text : {"30:UP+CROSS,60:", "1:SELECT+L3+RX=255+LY=7", "5:"}) {
      const auto script = sdk::parse_pad_script(text);
      REQUIRE(script);
      CHECK(sdk::to_text(*script) == text);
    }
  }

  TEST_CASE("a script that cannot be read names the part") {
    CHECK(sdk::parse_pad_script("30").error().text ==
          "--pad: \"30\": expected FRAME:BUTTON+BUTTON, as 30:UP+X");
    CHECK(sdk::parse_pad_script("30:UPP").error().text.starts_with("--pad: \"UPP\": expected UP, DOWN"));
    CHECK(sdk::parse_pad_script("1:LX=256").error().text.starts_with("--pad: \"LX=256\""));
    CHECK_FALSE(sdk::parse_pad_script(""));
  }

  TEST_CASE("a digital controller answers four bytes, a held button's bit 0") {
    sdk::PadState pad;
    pad.buttons = up;
    const auto said = sdk::answer(pad);
    CHECK(said.count == 4);
    CHECK(said.bytes[0] == 0);
    CHECK(said.bytes[1] == 0x41);
    CHECK(said.bytes[2] == 0xef);
    CHECK(said.bytes[3] == 0xff);
  }

  TEST_CASE("an analog controller answers eight, right stick first") {
    sdk::PadState pad;
    pad.is_analog = true;
    pad.sticks = {1, 2, 3, 4};
    const auto said = sdk::answer(pad);
    CHECK(said.count == 8);
    CHECK(said.bytes == std::array<std::uint8_t, 8>{0, 0x73, 0xff, 0xff, 1, 2, 3, 4});
  }
}
