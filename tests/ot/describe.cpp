#include "ot/describe.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "ot/command_stream.h"

using namespace ot;

namespace {

std::string described(const std::vector<std::uint32_t>& words) { return describe(words, words.size()); }

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("commands are told in words") {
    CHECK(described({0x20ff8040, 0x00000000, 0x00000008, 0x07ff07ff}) ==
          "triangle (0,0) (8,0) (-1,-1) 4080ff");
    CHECK(described({0x3a0000ff, 0, 0x0000ff00, 8, 0x00ff0000, 0x00080000, 0x00ffffff, 0x00080008}) ==
          "quad, gouraud, semi-transparent (0,0) ff0000 (8,0) 00ff00 (0,8) 0000ff (8,8) ffffff");
    CHECK(described({0x25000000, 0, 0x40010201, 8, 0x00ba0403, 0x00080000, 0x00000605}) ==
          "triangle, raw texture (0,0) uv 1,2 (8,0) uv 3,4 (0,8) uv 5,6 clut 16,256 page 640,256 8-bit blend "
          "B+F");
    CHECK(described({0x7d000000, 0x00020001, 0x00010403}) ==
          "rectangle, raw texture (1,2) 16x16 uv 3,4 clut 16,0");
    CHECK(described({0x60ffffff, 0x00020001, 0x00f00140}) == "rectangle (1,2) 320x240 ffffff");
    CHECK(described({0x40ffffff, 0, 0x00020001}) == "line (0,0) (1,2) ffffff");
    CHECK(described({0x48ffffff, 0, 1, 2, 3, 0x55555555}) == "polyline of 4 vertices (0,0) (1,0) ... ffffff");
    CHECK(described({0x02000000, 0x00200010, 0x00f00140}) == "fill (16,32) 320x240 000000");
    CHECK(described({0x80000000, 0x00020001, 0x00040003, 0x00060005}) == "copy from (1,2) 5x6 to (3,4)");
    CHECK(described({0xe1000600}) ==
          "draw mode page 0,0 4-bit blend (B+F)/2, dither, draws to the displayed field");
    CHECK(described({0xe5000fff}) == "drawing offset -1,1");
    CHECK(described({0xe9001800}) == "depth of vertex 1: 1.5000");
  }

  TEST_CASE("any stream of words can be told") {
    std::mt19937 random(19);
    CommandStream stream;
    int told = 0;
    for (int n = 0; n < 50000; ++n) {
      if (!stream.take((static_cast<std::uint32_t>(random()) & 0xff00f000) | 0x00010001)) continue;
      CHECK_FALSE(describe(stream.words(), stream.length()).empty());
      ++told;
    }
    CHECK(told > 100);
  }
}
