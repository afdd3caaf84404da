#include "display/compare.h"

#include <doctest/doctest.h>

TEST_SUITE("display") {
  using base::Picture;
  using base::Rgba;

  TEST_CASE("pixels that differ in any channel are counted once") {
    Picture a(3, 2, {10, 20, 30, 255});
    Picture b = a;
    b.at(0, 0) = {11, 21, 31, 255};
    b.at(2, 1).b = 0;
    CHECK(display::count_different(a, b) == 2);
    CHECK(display::count_different(a, a) == 0);
  }

  TEST_CASE("alpha is no part of a picture's colour") {
    const Picture a(1, 1, {1, 2, 3, 255});
    const Picture b(1, 1, {1, 2, 3, 0});
    CHECK(display::count_different(a, b) == 0);
  }

  TEST_CASE("pictures of different size differ everywhere") {
    CHECK(display::count_different(Picture(2, 2), Picture(3, 2)) == 6);
  }

  TEST_CASE("a marked picture shows the mark where two differ and dark grey elsewhere") {
    Picture a(2, 1, {255, 255, 255, 255});
    Picture b = a;
    b.at(1, 0) = {0, 0, 0, 255};
    const auto marked = display::mark_different(a, b, {255, 0, 255, 255});
    CHECK(marked.at(0, 0) == Rgba{85, 85, 85, 255});  // a third of white
    CHECK(marked.at(1, 0) == Rgba{255, 0, 255, 255});
  }
}
