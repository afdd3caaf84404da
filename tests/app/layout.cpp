#include "app/window/layout.h"

#include <doctest/doctest.h>

#include <initializer_list>

using app::place;
using app::Rect;

TEST_SUITE("window") {
  TEST_CASE("a picture is enlarged by the greatest whole number that fits, and centred") {
    CHECK(place(320, 240, {0, 0, 960, 720}) == Rect{0, 0, 960, 720});
    CHECK(place(320, 240, {0, 0, 1000, 730}) == Rect{20, 5, 960, 720});
    CHECK(place(320, 240, {0, 0, 959, 720}) == Rect{159, 120, 640, 480});
    CHECK(place(320, 240, {100, 50, 640, 480}) == Rect{100, 50, 640, 480});
  }

  TEST_CASE(
      "every mode fills the height of its television: narrow and flat pixels are doubled the other way") {
    CHECK(place(640, 240, {0, 0, 640, 480}) == Rect{0, 0, 640, 480});
    CHECK(place(512, 240, {0, 0, 512, 480}) == Rect{0, 0, 512, 480});
    CHECK(place(320, 480, {0, 0, 640, 480}) == Rect{0, 0, 640, 480});
    CHECK(place(640, 480, {0, 0, 640, 480}) == Rect{0, 0, 640, 480});
    CHECK(place(256, 240, {0, 0, 512, 480}) == Rect{0, 0, 512, 480});
  }

  TEST_CASE("an area smaller than the picture shrinks it in its shape, never to nothing") {
    CHECK(place(320, 240, {0, 0, 160, 200}) == Rect{0, 40, 160, 120});
    const auto tiny = place(320, 240, {0, 0, 1, 1});
    CHECK(tiny.width == 1);
    CHECK(tiny.height == 1);
    CHECK(place(320, 240, {0, 0, 0, 0}).width == 1);
  }

  TEST_CASE("the wanted area is filled exactly") {
    for (const int width : {256, 320, 368, 512, 640}) {
      for (const int height : {240, 480}) {
        CAPTURE(width);
        CAPTURE(height);
        const auto area = app::wanted_area(width, height, 3);
        CHECK(place(width, height, area) == area);
      }
    }
  }

  TEST_CASE("a window is first as large as asked, or by whole numbers as large as the screen has room for") {
    CHECK(app::wanted_area_within(320, 240, 3, {0, 0, 1920, 1000}) == app::Rect{0, 0, 960, 720});
    CHECK(app::wanted_area_within(640, 480, 3, {0, 0, 1280, 960}) == app::Rect{0, 0, 1280, 960});
    CHECK(app::wanted_area_within(640, 480, 3, {0, 0, 1280, 959}) == app::Rect{0, 0, 640, 480});
    CHECK(app::wanted_area_within(640, 480, 3, {0, 0, 100, 100}) == app::Rect{0, 0, 640, 480});
  }

  TEST_CASE("letters follow the display: by points, or by dots from half as many again as usual") {
    CHECK(app::letter_scale(96, 1, 1) == 1);
    CHECK(app::letter_scale(110, 1, 1) == 1);
    CHECK(app::letter_scale(192, 1, 1) == 2);
    CHECK(app::letter_scale(150, 1, 1) == 1.5);
    CHECK(app::letter_scale(96, 2, 1) == 2);
    CHECK(app::letter_scale(192, 2, 1) == 2);  // points count the dots already
    CHECK(app::letter_scale(96, 1, 1.25) == 1.25);
    CHECK(app::letter_scale(0, 1, 1) == 1);
    CHECK(app::letter_scale(5000, 1, 1) == 4);
  }
}
