// Lines in words: every colour and every vertex is counted where it stands.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "ot/describe.h"

TEST_SUITE("ot") {
  TEST_CASE("Lines are told with both their colours, polylines with the number of their vertices") {
    const auto told = [](const std::vector<std::uint32_t>& words) {
      return ot::describe(words, words.size());
    };
    CHECK(told({0x500000ff, 0x00020001, 0x0000ff00, 0x00040003}) ==
          "line, gouraud (1,2) ff0000 (3,4) 00ff00");
    CHECK(told({0x42332211, 0x00020001, 0x00040003}) == "line, semi-transparent (1,2) (3,4) 112233");
    CHECK(told({0x48ffffff, 0, 1, 0x55555555}) == "polyline of 2 vertices (0,0) (1,0) ffffff");
    // Shaded: colour and vertex in turn; three vertices are six words and the end.
    CHECK(told({0x580000ff, 0, 0x0000ff00, 1, 0x00ff0000, 2, 0x55555555}) ==
          "polyline, gouraud of 3 vertices (0,0) (1,0) ... ff0000");
    CHECK(told({0x580000ff, 0, 0x0000ff00, 1, 0x50005000}) ==
          "polyline, gouraud of 2 vertices (0,0) (1,0) ff0000");
  }
}
