#include "ot/command_stream.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <vector>

using namespace ot;
using gp0::Command;

namespace {

/// Feeds the words and says after which of them (from 1) a command ended.
std::vector<int> ends(CommandStream& stream, std::initializer_list<std::uint32_t> words) {
  std::vector<int> at;
  int n = 0;
  for (const auto word : words) {
    ++n;
    if (stream.take(word)) at.push_back(n);
  }
  return at;
}

using Ends = std::vector<int>;

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("commands end after their last word") {
    CommandStream s;
    CHECK(ends(s, {0xe1000000, 0x20ffffff, 0, 1, 2, 0x68ffffff, 0}) == Ends{1, 5, 7});
    CHECK(s.command() == Command::rectangle);
    CHECK(s.words().size() == 2);
    CHECK_FALSE(s.is_open());
  }

  TEST_CASE("an upload lasts until its last pixel, and pixels are not commands") {
    CommandStream s;
    CHECK(ends(s, {0xa0000000, 0, 0x00030003, 0x20000000, 0xa0000000, 0x55555555, 0, 0}) == Ends{8});
    CHECK(s.words().size() == 3);
    CHECK(s.length() == 8);
  }

  TEST_CASE("pixels can be skipped up to the last one") {
    CommandStream s;
    CHECK(s.skip_pixels(5) == 0);
    CHECK(ends(s, {0xa0000000, 0}) == Ends{});
    CHECK(s.skip_pixels(5) == 0);
    CHECK(ends(s, {0x00030003}) == Ends{});  // 9 pixels, 5 words
    CHECK(s.skip_pixels(2) == 2);
    CHECK(s.skip_pixels(100) == 2);
    CHECK(s.skip_pixels(100) == 0);
    CHECK(ends(s, {0}) == Ends{1});
    CHECK(s.length() == 8);
  }

  TEST_CASE("a flat polyline may end from its third vertex on") {
    CommandStream s;
    // The first two vertices are taken whatever they look like.
    CHECK(ends(s, {0x48ffffff, 0x55555555, 0x55555555, 0x00010001, 0x55555555}) == Ends{5});
    CHECK(ends(s, {0x48ffffff, 0, 0, 0x50005000}) == Ends{4});
  }

  TEST_CASE("a Gouraud polyline ends at a colour, never at a vertex") {
    CommandStream s;
    CHECK(ends(s, {0x58ffffff, 0, 0x55555555, 0, 0x00ffffff, 0x55555555, 0x55555555}) == Ends{7});
  }

  TEST_CASE("a polyline without an end stays open and keeps only its beginning") {
    CommandStream s;
    s.take(0x48ffffff);
    for (int n = 0; n < 100000; ++n) CHECK_FALSE(s.take(0));
    CHECK(s.is_open());
    CHECK(s.words().size() == CommandStream::kept_words);
    s.abort();
    CHECK(ends(s, {0xe1000000}) == Ends{1});
  }
}
