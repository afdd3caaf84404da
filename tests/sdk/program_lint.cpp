#include "sdk/program_lint.h"

#include <doctest/doctest.h>

#include <algorithm>

TEST_SUITE("sdk") {
  namespace {

  constexpr std::uint32_t table = 0x20000, length = 16, packet = 0x30000, other_packet = 0x30100, bytes = 20;
  const int places[2] = {};
  const sdk::CallSite here = &places[0], there = &places[1];

  std::string kinds(const sdk::ProgramLint& lint) {
    std::string text;
    for (const auto& finding : lint.findings()) text.append(text.empty() ? "" : " ").append(finding.kind);
    return text;
  }

  struct Linted : sdk::ProgramLint {
    Linted() { clear_table(table, length, here); }
    void put(std::uint32_t entry, std::uint32_t at = packet) { link(entry, at, at, bytes, here); }
  };

  }  // namespace

  TEST_CASE("a frame as it should be has no finding") {
    Linted lint;
    for (int frame = 0; frame < 3; ++frame) {
      lint.put(table + 4);
      lint.draw(table + 4 * (length - 1), here);
      lint.sync();
      lint.clear_table(table, length, here);
    }
    CHECK(kinds(lint).empty());
  }

  TEST_CASE("a packet in the word behind a table is named with the entry and the length") {
    Linted lint;
    lint.put(table + 4 * length);
    REQUIRE(kinds(lint) == "bucket-range");
    CHECK(lint.findings()[0].text == "entry 16 of the table at 020000h, which has 16");
  }

  TEST_CASE("a packet in front of a table is named, too") {
    Linted lint;
    lint.put(table - 4);
    REQUIRE(kinds(lint) == "bucket-range");
    CHECK(lint.findings()[0].text == "entry -1 of the table at 020000h, which has 16");
  }

  TEST_CASE("a packet far from every table belongs to a list of the program's own") {
    Linted lint;
    lint.put(table + 0x1000);
    CHECK(kinds(lint).empty());
  }

  TEST_CASE("a packet that is the word behind the table is linked to itself") {
    Linted lint;
    lint.put(table + 4 * length, table + 4 * length);
    CHECK(kinds(lint) == "linked-to-itself bucket-range");
  }

  TEST_CASE("the same packet twice in one table") {
    Linted lint;
    lint.put(table);
    lint.put(table + 4);
    CHECK(kinds(lint) == "linked-twice");
  }

  TEST_CASE("a packet may be linked again after the table was cleared") {
    Linted lint;
    lint.put(table);
    lint.draw(table, here);
    lint.sync();
    lint.clear_table(table, length, here);
    lint.put(table);
    CHECK(kinds(lint).empty());
  }

  TEST_CASE("a packet that still hangs in a table nobody has drawn must not go into another") {
    Linted lint;
    lint.clear_table(0x28000, length, here);
    lint.put(table);
    lint.put(0x28000);
    CHECK(kinds(lint) == "two-tables");
  }

  TEST_CASE("once the other table is drawn and DrawSync waited for it, the packet is free") {
    Linted lint;
    lint.clear_table(0x28000, length, here);
    lint.put(table);
    lint.draw(table, here);
    lint.sync();
    lint.put(0x28000);
    CHECK(kinds(lint).empty());
  }

  TEST_CASE("clearing a table with packets in it loses them") {
    Linted lint;
    lint.put(table);
    lint.clear_table(table, length, here);
    CHECK(kinds(lint) == "cleared-late");
  }

  TEST_CASE("a table that is drawn twice without clearing draws its old packets again") {
    Linted lint;
    lint.put(table);
    lint.draw(table, here);
    lint.sync();
    lint.put(table + 4, other_packet);
    lint.draw(table, here);
    CHECK(kinds(lint) == "not-cleared");
  }

  TEST_CASE("a table is the GPU's from DrawOTag to DrawSync") {
    Linted lint;
    lint.draw(table, here);
    lint.put(table);
    CHECK(kinds(lint) == "written-while-drawn");
  }

  TEST_CASE("a packet over a table, or over an environment, has left its buffer") {
    Linted lint;
    lint.environment(0x30110, 92);
    lint.put(table, table - 8);
    lint.put(table, other_packet);
    REQUIRE(kinds(lint) == "overrun");
    CHECK(lint.findings()[0].times == 2);
  }

  TEST_CASE("texels right of VRAM come from its left edge") {
    sdk::ProgramLint lint;
    constexpr std::uint32_t page_960 = 15, bits_4 = 0, bits_15 = 2 << 7;
    lint.textured(page_960 | bits_4, 255);  // 64 columns of VRAM
    CHECK(kinds(lint).empty());
    lint.textured(page_960 | bits_15, 63);
    CHECK(kinds(lint).empty());
    lint.textured(page_960 | bits_15, 64);
    CHECK(kinds(lint) == "texture-page");
  }

  TEST_CASE("an overflow is ignored if the packet is linked before FLAG is read") {
    Linted lint;
    lint.flag_set(true);
    lint.flag_read();
    lint.put(table);
    CHECK(kinds(lint).empty());
    lint.flag_set(true);
    lint.flag_set(false);
    lint.put(table, other_packet);
    CHECK(kinds(lint) == "flag-ignored");
  }

  TEST_CASE("findings of one kind and one place are counted, those of another place listed") {
    sdk::ProgramLint lint;
    lint.frame = 3;
    lint.note("list", here, "first");
    lint.frame = 4;
    lint.note("list", here, "second");
    lint.note("list", there, "third");
    REQUIRE(lint.findings().size() == 2);
    CHECK(lint.findings()[0].times == 2);
    CHECK(lint.findings()[0].frame == 3);
    CHECK(lint.findings()[0].text == "first");
    CHECK(lint.findings()[1].text == "third");
  }

  TEST_CASE("the bucket of an entry is counted from its table's begin") {
    Linted lint;
    const auto entry = lint.entry(table + 20);
    REQUIRE(entry);
    CHECK(entry->table == table);
    CHECK(entry->length == length);
    CHECK(entry->bucket == 5);
    CHECK_FALSE(lint.entry(table + 4 * length));
  }

  TEST_CASE("a table that is put into another one is drawn with it") {
    constexpr std::uint32_t nested = 0x24000;
    Linted lint;
    for (int frame = 0; frame < 3; ++frame) {
      lint.clear_table(nested, 4, here);
      lint.put(nested + 4);
      lint.link(table + 8, nested + 12, nested, 4, here);
      lint.draw(table + 4 * (length - 1), here);
      lint.sync();
      lint.clear_table(table, length, here);
    }
    CHECK(kinds(lint).empty());
  }
}
