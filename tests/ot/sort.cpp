// The list that is sorted by whole keys.

#include "ot/sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

/// Keys in the order drawn, and the order in which equal ones were inserted, as the links in memory tell it.
std::vector<std::uint32_t> drawn_order(const std::vector<std::uint32_t>& keys) {
  std::vector<std::uint32_t> memory(std::bit_ceil(keys.size() + 1),
                                    ot::tag::end);  // as a packet is before it is linked
  ot::SortedList list;
  for (std::uint32_t i = 0; i < keys.size(); ++i) list.insert(keys[i], 4 * (i + 1), 4 * (i + 1));
  std::vector<std::uint32_t> order;
  for (std::uint32_t at = list.link(memory); at != ot::tag::end; at = ot::tag::Next::get(memory[at / 4])) {
    REQUIRE(order.size() < keys.size());
    order.push_back(at / 4 - 1);
  }
  return order;
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("A sorted list goes from the largest key to the smallest, over all 32 bits of a key") {
    CHECK(drawn_order({0x7fffffff, 0x80000000, 0, 1, 0xffffffff}) ==
          std::vector<std::uint32_t>{4, 1, 0, 3, 2});
    for (int bit = 0; bit < 32; ++bit) {
      const std::uint32_t key = std::uint32_t{1} << bit;
      CAPTURE(bit);
      CHECK(drawn_order({key - 1, key}) == std::vector<std::uint32_t>{1, 0});
      CHECK(drawn_order({key, 0}) == std::vector<std::uint32_t>{0, 1});
    }
  }

  TEST_CASE("Of equal keys the last inserted is drawn first") {
    CHECK(drawn_order({5, 5, 7, 5}) == std::vector<std::uint32_t>{2, 3, 1, 0});
  }

  TEST_CASE("Random keys are drawn as a stable sort of the reversed list would draw them") {
    std::mt19937 random(8);
    for (const std::uint32_t mask : {0xfU, 0xffffU, 0xffffffffU, 0x80000001U}) {
      std::vector<std::uint32_t> keys(500);
      for (auto& key : keys) key = static_cast<std::uint32_t>(random()) & mask;
      std::vector<std::uint32_t> expected(keys.size());
      for (std::uint32_t i = 0; i < keys.size(); ++i)
        expected[i] = static_cast<std::uint32_t>(keys.size()) - 1 - i;
      std::ranges::stable_sort(expected, [&](auto a, auto b) { return keys[a] > keys[b]; });
      CHECK(drawn_order(keys) == expected);
    }
  }

  TEST_CASE("A list of nothing is the end marker") {
    std::vector<std::uint32_t> memory(1);
    CHECK(ot::SortedList().link(memory) == ot::tag::end);
  }
}
