// Tables found in lists by their runs of empty tags.

#include "ot/tables.h"

#include <doctest/doctest.h>

#include "ot/main_ram.h"
#include "ot/ordering_table.h"
#include "ot/walker.h"

using namespace ot;

namespace {

std::vector<FoundTable> found(const MainRam& ram, std::uint32_t head) {
  return find_tables(ram.words(), head, validate(ram, head).nodes);
}

/// A packet of one nop.
void put_packet(MainRam& ram, std::uint32_t address, std::uint32_t next) {
  ram.write(address, 1U << 24 | next);
  ram.write(address + 4, 0);
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("a cleared table is found whole, with and without packets in it") {
    MainRam ram(RamSize::mib2);
    OrderingTable table(ram, 0x1000, 16);
    table.clear();
    CHECK(found(ram, table.head()) == std::vector<FoundTable>{{0x1000, 16}});
    put_packet(ram, 0x8000, 0xffffff);
    put_packet(ram, 0x8010, 0xffffff);
    table.insert(3, 0x8000, 0x8000);
    table.insert(7, 0x8010, 0x8010);
    CHECK(found(ram, table.head()) == std::vector<FoundTable>{{0x1000, 16}});
  }

  TEST_CASE("a table that is linked upwards is found by its lowest entry") {
    MainRam ram(RamSize::mib2);
    for (std::uint32_t n = 0; n < 8; ++n) ram.write(0x2000 + 4 * n, n == 7 ? 0xffffff : 0x2004 + 4 * n);
    CHECK(found(ram, 0x2000) == std::vector<FoundTable>{{0x2000, 8}});
  }

  TEST_CASE("tables one after the other are two, and three empty tags are none") {
    MainRam ram(RamSize::mib2);
    OrderingTable far(ram, 0x1000, 8), near(ram, 0x3000, 4), small(ram, 0x5000, 3);
    far.clear();
    near.clear();
    small.clear();
    ram.write(0x1000, near.head());
    ram.write(0x3000, small.head());
    CHECK(found(ram, far.head()) == std::vector<FoundTable>{{0x1000, 8}, {0x3000, 4}});
  }

  TEST_CASE("an entry's bucket counts from the lowest address of its table") {
    const std::vector<FoundTable> tables{{0x1000, 8}, {0x3000, 4}};
    CHECK(bucket_of(tables, 0x1000) == 0);
    CHECK(bucket_of(tables, 0x101c) == 7);
    CHECK(bucket_of(tables, 0x3004) == 1);
    CHECK_FALSE(bucket_of(tables, 0x1020));
  }

  TEST_CASE("a list of packets alone has no table") {
    MainRam ram(RamSize::mib2);
    for (std::uint32_t n = 0; n < 8; ++n) put_packet(ram, 0x4000 + 8 * n, n == 7 ? 0xffffff : 0x4008 + 8 * n);
    CHECK(found(ram, 0x4000).empty());
  }
}
