#include "ot/dma.h"

#include <doctest/doctest.h>

#include <array>
#include <initializer_list>
#include <random>
#include <vector>

#include "ot/ordering_table.h"

using namespace ot;

namespace {

using Words = std::vector<std::uint32_t>;

/// A device that keeps what it is sent and counts up when it is read.
struct Recorder {
  Words sent;
  std::uint32_t next_read = 100;
  std::uint32_t gpustat = 0x5e802000;  // direction 2, ready
  void gp0(std::span<const std::uint32_t> words) { sent.insert(sent.end(), words.begin(), words.end()); }
  std::uint32_t read() { return next_read++; }
  [[nodiscard]] std::uint32_t status() const { return gpustat; }
};

struct Machine {
  MainRam ram{RamSize::mib2};
  Recorder device;
  PortOf<Recorder> port{device};
  Dma dma{ram};

  Machine() { dma.write(dma::dpcr, 0x0f654b21 | 0x800); }  // channels 2 and 6 on

  std::uint64_t start(std::uint32_t channel, std::uint32_t madr, std::uint32_t bcr, std::uint32_t chcr,
                      std::uint64_t budget = 1000000) {
    dma.write(dma::madr(channel), madr);
    dma.write(dma::bcr(channel), bcr);
    dma.write(dma::chcr(channel), chcr);
    return dma.run(port, budget);
  }
  [[nodiscard]] std::uint32_t madr(std::uint32_t n) const { return dma.read(dma::madr(n)); }
  [[nodiscard]] std::uint32_t bcr(std::uint32_t n) const { return dma.read(dma::bcr(n)); }
  [[nodiscard]] std::uint32_t chcr(std::uint32_t n) const { return dma.read(dma::chcr(n)); }
  [[nodiscard]] std::uint32_t dicr() const { return dma.read(dma::dicr); }
};

constexpr std::uint32_t list = 0x01000401, write_blocks = 0x01000201, read_blocks = 0x01000200;
constexpr std::uint32_t clear = 0x11000002;

/// Worked example 2: four entries and packets A (2 words), B (3), C (1), D (2).
void example_2(Machine& m) {
  OrderingTable table(m.ram, 0x123000, 4);
  table.clear();
  for (const std::uint32_t at : {0x130000U, 0x130100U, 0x130200U, 0x130300U}) {
    for (std::uint32_t n = 1; n <= 3; ++n) m.ram.write(at + 4 * n, at + 4 * n);
  }
  m.ram.write(0x130000, 2U << 24);
  m.ram.write(0x130100, 3U << 24);
  m.ram.write(0x130200, 1U << 24);
  m.ram.write(0x130300, 2U << 24);
  table.insert(2, 0x130000);
  table.insert(2, 0x130100);
  table.insert(0, 0x130200);
  table.insert(3, 0x130300);
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("OTC links each entry to the one below and leaves its neighbours alone") {
    Machine m;
    m.ram.write(0x122ffc, 1);
    m.ram.write(0x123010, 2);
    m.start(6, 0x12300c, 4, clear);
    CHECK(m.ram.read(0x123000) == 0x00ffffff);
    CHECK(m.ram.read(0x123004) == 0x00123000);
    CHECK(m.ram.read(0x123008) == 0x00123004);
    CHECK(m.ram.read(0x12300c) == 0x00123008);
    CHECK(m.ram.read(0x122ffc) == 1);
    CHECK(m.ram.read(0x123010) == 2);
    CHECK(m.chcr(6) == 0x00000002);
    CHECK(m.madr(6) == 0x12300c);
    CHECK(m.bcr(6) == 4);
  }

  TEST_CASE("DMA2 sends the payloads in list order and ends at the marker") {
    Machine m;
    example_2(m);
    m.dma.write(dma::dicr, 0x00840000);
    m.start(2, 0x12300c, 0, list);
    CHECK(m.device.sent ==
          Words{0x130304, 0x130308, 0x130104, 0x130108, 0x13010c, 0x130004, 0x130008, 0x130204});
    CHECK(m.madr(2) == 0xffffff);
    CHECK(m.chcr(2) == 0x00000401);
    CHECK(m.dicr() == 0x84840000);
    CHECK(m.dma.take_interrupt());
    CHECK_FALSE(m.dma.take_interrupt());
  }

  TEST_CASE("a link with bit 23 that is not the marker is a bus error") {
    Machine m;
    m.ram.write(0x123000, 0x00900000);
    m.dma.write(dma::dicr, 0x00840000);
    m.start(2, 0x123000, 0, list);
    CHECK(m.device.sent.empty());
    CHECK(m.madr(2) == 0x900000);
    CHECK(m.chcr(2) == 0x00000401);
    CHECK(m.dicr() == 0x80848000);
  }

  TEST_CASE("links reach RAM through its mirrors") {
    Machine m;
    m.ram.write(0x123004, 0x01323000);
    m.ram.write(0x123008, 0xabcd);
    m.ram.write(0x123000, 0x00ffffff);
    m.start(2, 0x323004, 0, list);
    CHECK(m.device.sent == Words{0xabcd});
    CHECK(m.madr(2) == 0xffffff);
    CHECK(m.chcr(2) == 0x00000401);
  }

  TEST_CASE("a list that loops stays busy until CHCR is cleared") {
    Machine m;
    m.ram.write(0x123000, 0x00123000);
    CHECK(m.start(2, 0x123000, 0, list, 500) == 500);
    CHECK(m.chcr(2) == 0x01000401);
    CHECK(m.madr(2) == 0x123000);
    CHECK(m.dma.is_busy(2));
    CHECK(m.dma.run(m.port, 10) == 10);
    m.dma.write(dma::chcr(2), 0x00000401);
    CHECK(m.dma.run(m.port, 10) == 0);
    CHECK_FALSE(m.dma.is_busy(2));
  }

  TEST_CASE("slices move MADR and count blocks down, a burst leaves both alone") {
    Machine m;
    for (std::uint32_t n = 0; n < 12; ++n) m.ram.write(0x130000 + 4 * n, n);
    m.start(2, 0x130000, 0x00030004, write_blocks);
    CHECK(m.device.sent == Words{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    CHECK(m.madr(2) == 0x130030);
    CHECK(m.bcr(2) == 0x00000004);
    CHECK(m.chcr(2) == 0x00000201);
    m.device.sent.clear();
    m.start(2, 0x130000, 5, 0x11000001);
    CHECK(m.device.sent == Words{0, 1, 2, 3, 4});
    CHECK(m.madr(2) == 0x130000);
    CHECK(m.bcr(2) == 5);
    CHECK(m.chcr(2) == 0x00000001);
  }

  TEST_CASE("a count of 0 clears 65536 entries") {
    Machine m;
    m.ram.write(0x05fffc, 77);
    m.start(6, 0x09fffc, 0, clear);
    CHECK(m.ram.read(0x09fffc) == 0x0009fff8);
    CHECK(m.ram.read(0x060004) == 0x00060000);
    CHECK(m.ram.read(0x060000) == 0x00ffffff);
    CHECK(m.ram.read(0x05fffc) == 77);
  }

  // Worked examples 2 and 9 are in ordering_table.cpp; 10 is the GTE's.

  TEST_CASE("OTC of one entry writes the end marker") {
    Machine m;
    m.start(6, 0x1000, 1, clear);
    CHECK(m.ram.read(0x1000) == 0x00ffffff);
    CHECK(m.ram.read(0x0ffc) == 0);
  }

  TEST_CASE("OTC that counts below address 0 stops with a bus error") {
    Machine m;
    m.ram.write(0x1ffffc, 5);
    m.start(6, 0x4, 4, clear);
    CHECK(m.ram.read(0x4) == 0);
    CHECK(m.ram.read(0x0) == 0x1ffffc);
    CHECK(m.ram.read(0x1ffffc) == 5);
    CHECK(m.chcr(6) == 0x00000002);
    CHECK((m.dicr() & 0x80008000) == 0x80008000);
  }

  TEST_CASE("only start, trigger and bit 30 of CHCR6 can be written") {
    Machine m;
    m.dma.write(dma::dpcr, 0);  // off, so that nothing starts
    for (const auto& [written, read] :
         {std::pair{0x70770703U, 0x50000002U}, std::pair{0U, 2U}, std::pair{0x8e88f8fcU, 2U}}) {
      m.dma.write(dma::chcr(6), written);
      CHECK(m.chcr(6) == read);
    }
  }

  TEST_CASE("OTC needs its enable bit, start and trigger, and ignores all other settings") {
    for (const std::uint32_t chcr : {0x01000002U, 0x10000002U, 0x00000002U}) {
      Machine m;
      m.start(6, 0x1000, 2, chcr);
      CHECK(m.ram.read(0x1000) == 0);
    }
    for (const std::uint32_t chcr : {0x11000000U, 0x11000003U, 0x11000202U, 0x11000402U, 0x11000602U}) {
      Machine m;
      m.start(6, 0x1000, 2, chcr);
      CHECK(m.ram.read(0x1000) == 0x0ffc);
      CHECK(m.ram.read(0x0ffc) == 0xffffff);
    }
  }

  TEST_CASE("a disabled channel waits, and starts when it is enabled") {
    Machine m;
    m.dma.write(dma::dpcr, 0x07654321);
    CHECK(m.start(6, 0x1000, 2, clear) == 0);
    CHECK(m.chcr(6) == 0x11000002);
    m.dma.write(dma::dpcr, 0x0f654321);
    CHECK(m.dma.run(m.port, 100) == 2);
    CHECK(m.ram.read(0x1000) == 0x0ffc);
  }

  TEST_CASE("registers keep the bits that exist") {
    Machine m;
    m.dma.write(dma::dpcr, 0);
    m.dma.write(dma::madr(2), 0xffffffff);
    CHECK(m.madr(2) == 0x00ffffff);
    m.dma.write(dma::bcr(2), 0x12345678);
    CHECK(m.bcr(2) == 0x12345678);
    m.dma.write(dma::chcr(2), 0xffffffff);
    CHECK(m.chcr(2) == 0x71770703);
    m.dma.write(dma::dicr, 0x7fff7fff);
    CHECK(m.dicr() == 0x00ff007f);
    CHECK(Dma(m.ram).read(dma::dpcr) == 0x07654321);
    CHECK(m.dma.read(dma::madr(3)) == 0);
  }

  TEST_CASE("a channel's flag needs its mask and the master enable, and is cleared by writing 1") {
    for (const auto& [enabled, expected] :
         {std::pair{0x00800000U, 0x00800000U}, std::pair{0x00040000U, 0x00040000U},
          std::pair{0x00840000U, 0x84840000U}}) {
      Machine m;
      m.dma.write(dma::dicr, enabled);
      m.start(2, 0xffffff, 0, list);
      CHECK(m.chcr(2) == 0x00000401);
      CHECK(m.dicr() == expected);
      m.dma.write(dma::dicr, enabled | 0x04000000);
      CHECK(m.dicr() == enabled);
    }
  }

  TEST_CASE("bit 15 of DICR forces the interrupt until it is cleared") {
    Machine m;
    m.dma.write(dma::dicr, 0x8000);
    CHECK(m.dicr() == 0x80008000);
    CHECK(m.dma.take_interrupt());
    m.dma.write(dma::dicr, 0);
    CHECK(m.dicr() == 0);
  }

  TEST_CASE("a list waits while the GPU does not request data") {
    Machine m;
    m.ram.write(0x1000, 0x01ffffff);
    m.device.gpustat = 0;
    CHECK(m.start(2, 0x1000, 0, list) == 0);
    CHECK(m.chcr(2) == list);
    m.device.gpustat = 0x62000000;  // requests, but to send
    CHECK(m.dma.run(m.port, 10) == 0);
    m.device.gpustat = 0x42000000;
    CHECK(m.dma.run(m.port, 10) == 2);
  }

  TEST_CASE("slices read from the GPU into RAM, forwards and backwards") {
    Machine m;
    m.device.gpustat = 0x6a000000;
    m.start(2, 0x1000, 0x00020002, read_blocks);
    CHECK(m.ram.read(0x1000) == 100);
    CHECK(m.ram.read(0x100c) == 103);
    CHECK(m.madr(2) == 0x1010);
    m.start(2, 0x100c, 0x00010002, read_blocks | 2);
    CHECK(m.ram.read(0x100c) == 104);
    CHECK(m.ram.read(0x1008) == 105);
    CHECK(m.madr(2) == 0x1004);
  }

  TEST_CASE("a chopped burst shows its progress in MADR and BCR") {
    Machine m;
    CHECK(m.start(2, 0x1000, 10, 0x11020101, 8) == 8);  // windows of 4 words
    CHECK(m.madr(2) == 0x1020);
    CHECK(m.bcr(2) == 2);
    CHECK(m.chcr(2) == 0x01020101);
    m.dma.run(m.port, 100);
    CHECK(m.madr(2) == 0x1028);
    CHECK(m.bcr(2) == 0);
    CHECK(m.chcr(2) == 0x00020101);
    CHECK(m.device.sent.size() == 10);
  }

  TEST_CASE("a transfer that leaves RAM ends there with a bus error") {
    Machine m;
    m.start(2, 0x7ffff8, 0x00010004, write_blocks);
    CHECK(m.device.sent.size() == 2);
    CHECK(m.madr(2) == 0x800000);
    CHECK(m.chcr(2) == 0x00000201);
    CHECK(m.dicr() == 0x80008000);
  }

  TEST_CASE("a payload at the end of RAM goes on at its beginning") {
    Machine m;
    m.ram.write(0x1ffffc, 0x01ffffff);
    m.ram.write(0, 42);
    m.start(2, 0x1ffffc, 0, list);
    CHECK(m.device.sent == Words{42});
  }

  TEST_CASE("the channel with the lower priority number moves first, of equal ones the higher channel") {
    for (const auto& [dpcr, table_first] :
         {std::pair{0x09000a00U, true}, std::pair{0x0a000900U, false}, std::pair{0x09000900U, true}}) {
      Machine m;
      m.ram.write(0x1000, 0x01ffffff);  // OTC will overwrite this tag
      m.dma.write(dma::dpcr, 0);
      m.start(6, 0x1000, 1, clear);
      m.start(2, 0x1000, 0, list);
      m.dma.write(dma::dpcr, dpcr);
      m.dma.run(m.port, 100);
      CHECK(m.device.sent.size() == (table_first ? 0 : 1));
    }
  }

  TEST_CASE("random registers over random RAM stay within the budget and within RAM") {
    std::mt19937 random(17);
    Machine m;
    for (auto& word : m.ram.words()) word = static_cast<std::uint32_t>(random());
    for (int n = 0; n < 3000; ++n) {
      for (const std::uint32_t address : {dma::madr(2), dma::bcr(2), dma::chcr(2), dma::madr(6), dma::bcr(6),
                                          dma::chcr(6), dma::dpcr, dma::dicr}) {
        m.dma.write(address, static_cast<std::uint32_t>(random()));
      }
      m.device.gpustat = static_cast<std::uint32_t>(random());
      m.device.sent.clear();
      CHECK(m.dma.run(m.port, 1000) < 1000 + 0x10000);
    }
  }
}
