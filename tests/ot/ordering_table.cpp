#include "ot/ordering_table.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "ot/packet.h"
#include "ot/walker.h"

using namespace ot;

namespace {

/// Packets of one word that names them, as they come out of the list.
std::vector<std::uint32_t> drawn(const MainRam& ram, std::uint32_t head) {
  std::vector<std::uint32_t> words;
  const auto result = walk(ram, head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    words.insert(words.end(), payload.begin(), payload.end());
  });
  CHECK(result.message() ==
        std::to_string(result.nodes) + " tags, " + std::to_string(words.size()) + " words");
  return words;
}

using Words = std::vector<std::uint32_t>;

struct Fixture {
  MainRam ram{RamSize::mib2};
  PacketArena arena{ram, 0x130000, 0x140000};
  std::uint32_t packet(std::uint32_t name) { return arena.push(std::array{name}).value(); }
};

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("a cleared table links each entry to the one before, the first ends the list") {
    MainRam ram(RamSize::mib2);
    OrderingTable table(ram, 0x123000, 4);
    table.clear();
    CHECK(ram.read(0x123000) == 0x00ffffff);
    CHECK(ram.read(0x123004) == 0x00123000);
    CHECK(ram.read(0x123008) == 0x00123004);
    CHECK(ram.read(0x12300c) == 0x00123008);
    CHECK(table.head() == 0x12300c);
  }

  TEST_CASE("inserting links a packet behind the entry of its bucket") {
    MainRam ram(RamSize::mib2);
    OrderingTable table(ram, 0x123000, 4);
    table.clear();
    const auto node = [&](std::uint32_t at, std::uint32_t length) { ram.write(at, length << 24); };
    node(0x130000, 2);
    node(0x130100, 3);
    node(0x130200, 1);
    node(0x130300, 2);
    table.insert(2, 0x130000);
    table.insert(2, 0x130100);
    table.insert(0, 0x130200);
    table.insert(3, 0x130300);
    CHECK(ram.read(0x123000) == 0x00130200);
    CHECK(ram.read(0x123004) == 0x00123000);
    CHECK(ram.read(0x123008) == 0x00130100);
    CHECK(ram.read(0x12300c) == 0x00130300);
    CHECK(ram.read(0x130000) == 0x02123004);
    CHECK(ram.read(0x130100) == 0x03130000);
    CHECK(ram.read(0x130200) == 0x01ffffff);
    CHECK(ram.read(0x130300) == 0x02123008);
  }

  TEST_CASE("a frame is drawn from the last bucket to the first, the last packet of a bucket first") {
    // Worked example 9: P at 5, Q at 2, R at 5, then a mode packet M at 5.
    Fixture f;
    OrderingTable table(f.ram, 0x123000, 8);
    table.clear();
    table.insert(5, f.packet('P'));
    table.insert(2, f.packet('Q'));
    table.insert(5, f.packet('R'));
    table.insert(5, f.packet('M'));
    CHECK(drawn(f.ram, table.head()) == Words{'M', 'R', 'P', 'Q'});
  }

  TEST_CASE("first in, first drawn on request") {
    Fixture f;
    OrderingTable table(f.ram, 0x123000, 8, Order::fifo);
    table.clear();
    table.insert(5, f.packet('P'));
    table.insert(2, f.packet('Q'));
    table.insert(5, f.packet('R'));
    CHECK(drawn(f.ram, table.head()) == Words{'P', 'R', 'Q'});
    table.clear();
    table.insert(5, f.packet('S'));
    CHECK(drawn(f.ram, table.head()) == Words{'S'});
  }

  TEST_CASE("a chain keeps its order inside its bucket, both ways") {
    for (const auto order : {Order::lifo, Order::fifo}) {
      Fixture f;
      OrderingTable table(f.ram, 0x123000, 2, order);
      table.clear();
      table.insert(1, f.packet('A'));
      const auto depth = f.packet('d');
      const auto polygon = f.packet('p');
      link(f.ram, depth, polygon);
      table.insert(1, depth, polygon);
      CHECK(drawn(f.ram, table.head()) ==
            (order == Order::lifo ? Words{'d', 'p', 'A'} : Words{'A', 'd', 'p'}));
    }
  }

  TEST_CASE("first in, first out: what is inserted after a chain is drawn behind all of it") {
    Fixture f;
    OrderingTable table(f.ram, 0x123000, 1, Order::fifo);
    table.clear();
    const auto depth = f.packet('d');
    const auto polygon = f.packet('p');
    link(f.ram, depth, polygon);
    table.insert(0, depth, polygon);
    table.insert(0, f.packet('A'));
    CHECK(drawn(f.ram, table.head()) == Words{'d', 'p', 'A'});
  }

  TEST_CASE("a nested table is drawn as one where it was inserted") {
    Fixture f;
    OrderingTable scene(f.ram, 0x123000, 4);
    OrderingTable car(f.ram, 0x124000, 3);
    scene.clear();
    car.clear();
    scene.insert(3, f.packet('F'));
    scene.insert(2, car);
    car.insert(0, f.packet('n'));
    car.insert(2, f.packet('f'));
    scene.insert(2, f.packet('x'));
    scene.insert(1, f.packet('N'));
    CHECK(drawn(f.ram, scene.head()) == Words{'F', 'x', 'f', 'n', 'N'});
  }

  TEST_CASE("two tables are one list when the end of the far one links to the head of the near one") {
    Fixture f;
    OrderingTable far(f.ram, 0x123000, 2);
    OrderingTable near(f.ram, 0x124000, 2);
    far.clear();
    near.clear();
    far.insert(0, f.packet('F'));
    near.insert(1, f.packet('N'));
    link(f.ram, 0x130000, near.head());  // the packet in bucket 0 carries the end of the far table
    CHECK(drawn(f.ram, far.head()) == Words{'F', 'N'});
  }

  TEST_CASE("only the tags of the table have a bucket") {
    MainRam ram(RamSize::mib2);
    const OrderingTable table(ram, 0x1000, 3);
    CHECK(table.bucket_of(0x1000) == 0);
    CHECK(table.bucket_of(0x1008) == 2);
    CHECK(table.bucket_of(0x100c) == std::nullopt);
    CHECK(table.bucket_of(0x0ffc) == std::nullopt);
    CHECK(table.bucket_of(0) == std::nullopt);
    CHECK(table.bucket_of(tag::end) == std::nullopt);
  }

  TEST_CASE("inserting leaves the lengths of all tags alone") {
    MainRam ram(RamSize::mib2);
    OrderingTable table(ram, 0x1000, 1);
    table.clear();
    ram.write(0x1000, 0x05ffffff);
    ram.write(0x2000, 0x09000000);
    table.insert(0, 0x2000);
    CHECK(ram.read(0x1000) == 0x05002000);
    CHECK(ram.read(0x2000) == 0x09ffffff);
  }
}
