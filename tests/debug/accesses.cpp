#include "debug/accesses.h"

#include <doctest/doctest.h>

#include "streams.h"

namespace {

using debug::AccessKind;
using tests::Words, tests::xy;

std::vector<debug::Access> accesses_of(const std::vector<Words>& commands) {
  debug::Clip clip;
  std::uint32_t number = 0;
  clip.items.push_back({.number = ++number, .words = tests::everywhere});
  for (const auto& words : commands) clip.items.push_back({.number = ++number, .words = words});
  const debug::FrameView view(clip, {});
  return debug::accesses_of(view);
}

bool has(const std::vector<debug::Access>& all, AccessKind kind, const inspect::Rectangle& place,
         std::size_t commands) {
  for (const auto& access : all) {
    if (access.kind == kind && access.place == place) return access.commands == commands;
  }
  return false;
}

}  // namespace

TEST_SUITE("debug") {
  TEST_CASE("a sprite reads its texels and its palette, and writes its pixels") {
    // Page 640,0 in 4 bits; 16 x 8 texels from 8,2 on are 4 halfwords of a row.
    const Words page{0xe100000a}, sprite{0x65808080, xy(100, 50), 0x7843U << 16 | 2 << 8 | 8, xy(16, 8)};
    const auto all = accesses_of(
        {{0xa0000000, xy(640, 0), xy(8, 16), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
          0,          0,          0,         0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
          0,          0,          0,         0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
         page,
         sprite,
         sprite});
    CHECK(has(all, AccessKind::texels, {642, 2, 4, 8}, 2));
    CHECK(has(all, AccessKind::palette, {48, 481, 16, 1}, 2));
    CHECK(has(all, AccessKind::write, {640, 0, 8, 16}, 1));
  }

  TEST_CASE("a copy reads where it copies from; a fill writes alone") {
    const auto all =
        accesses_of({{0x02ffffff, xy(16, 4), xy(32, 8)}, {0x80000000, xy(16, 4), xy(200, 100), xy(5, 6)}});
    CHECK(has(all, AccessKind::write, {16, 4, 32, 8}, 1));
    CHECK(has(all, AccessKind::source, {16, 4, 5, 6}, 1));
    CHECK(has(all, AccessKind::write, {200, 100, 5, 6}, 1));
    CHECK(all.size() == 3);
  }
}
