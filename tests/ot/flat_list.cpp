#include "ot/flat_list.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "ot/packet.h"
#include "ot/sort.h"

using namespace ot;

namespace {

using Sent = std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>>;

/// The flat walk does what the plain one does: same result, same payloads in the same order.
template <class Links>
void check_same(FlatList<Links>& flat, const BasicOrderingTable<Links>& table, std::uint32_t first) {
  Sent plain, fast;
  const auto into = [](Sent& sent) {
    return [&sent](std::uint32_t tag, std::span<const std::uint32_t> payload) {
      if (!payload.empty()) sent.emplace_back(tag, std::vector(payload.begin(), payload.end()));
    };
  };
  const auto expected = walk<Links>(table.memory(), first, into(plain));
  CHECK(flat.walk(table, first, into(fast)) == expected);
  CHECK(plain == fast);
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("the flat walk equals the plain one on tables of every fill and order") {
    std::mt19937 random(23);
    const auto pick = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
    FlatList<ByteLinks> flat;
    MainRam ram(RamSize::mib2);
    for (int n = 0; n < 200; ++n) {
      const std::uint32_t length = 1 + pick(n % 3 == 0 ? 2000 : 100);
      OrderingTable table(ram, 0x1000, length, n % 2 == 0 ? Order::lifo : Order::fifo);
      table.clear();
      PacketArena arena(ram, 0x10000, 0x100000);
      const auto packets = pick(3000);
      const auto used = 1 + pick(length);  // some tables are filled at one end only
      for (std::uint32_t p = 0; p < packets; ++p) {
        const std::vector<std::uint32_t> payload(pick(12), p);
        table.insert(pick(used), arena.push(payload).value());
      }
      check_same(flat, table, table.head());
      const auto front = arena.push({}).value();
      link(ram, front, table.head());
      check_same(flat, table, front);
    }
  }

  TEST_CASE("the flat walk finds what the plain one finds in damaged tables") {
    std::mt19937 random(29);
    const auto pick = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
    FlatList<ByteLinks> flat;
    MainRam ram(RamSize::mib2);
    int ends[4] = {};
    for (int n = 0; n < 600; ++n) {
      OrderingTable table(ram, 0x1000, 300);
      table.clear();
      std::vector<std::uint32_t> packets;
      PacketArena arena(ram, 0x10000, 0x80000);
      for (int p = 0; p < 500; ++p) {
        packets.push_back(arena.push(std::vector<std::uint32_t>(pick(4), 7)).value());
        table.insert(pick(300), packets.back());
      }
      const auto victim = packets[pick(500)];
      switch (n % 6) {
        case 0:
          table.insert(pick(300), victim);
          break;  // linked twice: skips entries, or loops
        case 1:
          link(ram, victim, 0x900000);
          break;
        case 2:
          link(ram, victim, tag::end);
          break;
        case 3:
          ram.write(victim, 0xff000000 | 0x1ffff0);
          ram.write(0x1ffff0, 0xff000000);
          break;
        case 4:
          link(ram, victim, victim);
          break;
        default:
          link(ram, victim, packets[pick(500)]);
          break;
      }
      check_same(flat, table, table.head());
      ++ends[static_cast<int>(validate(ram, table.head()).end)];
    }
    for (const int count : ends) CHECK(count > 10);
  }

  TEST_CASE("the flat walk works with word links beyond 8 MiB") {
    std::vector<std::uint32_t> memory(0x400000);
    BasicOrderingTable<WordLinks> table(memory, 16, 4096);
    table.clear();
    std::mt19937 random(31);
    for (std::uint32_t at = 0x2000; at < 0x400000 - 10; at += 97) {
      memory[at] = tag::make(tag::end, 9);
      table.insert(static_cast<std::uint32_t>(random() % 4096), at);
    }
    FlatList<WordLinks> flat;
    check_same(flat, table, table.head());
  }

  TEST_CASE("a sorted list is drawn by falling key, of equal keys the last inserted first") {
    MainRam ram(RamSize::mib2);
    SortedList list;
    std::mt19937 random(37);
    struct Expected {
      std::uint32_t key, order, node;
    };
    std::vector<Expected> expected;
    for (std::uint32_t n = 0; n < 5000; ++n) {
      const auto key = static_cast<std::uint32_t>(random()) >> (n % 30);
      const auto node = 0x1000 + n * 8;
      list.insert(key, node, node);
      expected.push_back({key, n, node});
    }
    std::ranges::sort(expected, [](const auto& a, const auto& b) {
      return a.key != b.key ? a.key > b.key : a.order > b.order;
    });
    std::vector<std::uint32_t> nodes;
    CHECK(walk(ram, list.link(ram.words()), [&](std::uint32_t tag, auto) { nodes.push_back(tag); }));
    REQUIRE(nodes.size() == expected.size());
    bool same = true;
    for (std::size_t n = 0; n < nodes.size(); ++n) same = same && nodes[n] == expected[n].node;
    CHECK(same);
  }

  TEST_CASE("an empty sorted list is the end marker, and chains stay together") {
    MainRam ram(RamSize::mib2);
    SortedList list;
    CHECK(list.link(ram.words()) == tag::end);
    link(ram, 0x1000, 0x1100);
    list.insert(5, 0x1000, 0x1100);
    list.insert(9, 0x2000, 0x2000);
    CHECK(list.link(ram.words()) == 0x2000);
    CHECK(tag::Next::get(ram.read(0x2000)) == 0x1000);
    CHECK(tag::Next::get(ram.read(0x1000)) == 0x1100);
    CHECK(tag::Next::get(ram.read(0x1100)) == tag::end);
  }
}
