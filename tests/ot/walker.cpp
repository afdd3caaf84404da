#include "ot/walker.h"

#include <doctest/doctest.h>

#include <random>
#include <set>
#include <vector>

using namespace ot;

namespace {

/// The rules of a walk with a set of visited tags: slow and plain.
WalkResult walk_with_set(const MainRam& ram, std::uint32_t first) {
  WalkResult r;
  std::set<std::uint32_t> seen;
  std::uint32_t from = no_tag;
  for (std::uint32_t at = first; at != 0xffffff;) {
    const auto stop = [&](WalkEnd end) { return WalkResult{end, at, from, r.nodes, r.words}; };
    if ((at & 0x800000) != 0) return stop(WalkEnd::outside_ram);
    const auto offset = at % ram.size_bytes() / 4 * 4;
    if (!seen.insert(offset).second) return stop(WalkEnd::loop);
    const auto word = ram.read(offset);
    if (offset + 4 + 4 * (word >> 24) > ram.size_bytes()) return stop(WalkEnd::payload_past_end);
    ++r.nodes;
    r.words += word >> 24;
    from = at;
    at = word & 0xffffff;
  }
  return r;
}

std::vector<std::uint32_t> sent(const MainRam& ram, std::uint32_t first) {
  std::vector<std::uint32_t> words;
  walk(ram, first, [&](std::uint32_t, std::span<const std::uint32_t> p) {
    words.insert(words.end(), p.begin(), p.end());
  });
  return words;
}

struct Sent {
  WalkResult result;
  std::vector<std::uint32_t> words;
  bool operator==(const Sent&) const = default;
};

Sent sent_to_fault(const MainRam& ram, std::uint32_t first, std::uint32_t max_nodes) {
  Sent sent;
  sent.result =
      walk_to_fault(ram.words(), first, max_nodes, [&](std::uint32_t, std::span<const std::uint32_t> p) {
        sent.words.insert(sent.words.end(), p.begin(), p.end());
      });
  return sent;
}

}  // namespace

TEST_SUITE("ot") {
  TEST_CASE("the walk sends the payloads in list order, the last one included") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x02002000);
    ram.write(0x1004, 11);
    ram.write(0x1008, 12);
    ram.write(0x2000, 0x00003000);
    ram.write(0x3000, 0x01ffffff);
    ram.write(0x3004, 31);
    CHECK(sent(ram, 0x1000) == std::vector<std::uint32_t>{11, 12, 31});
    std::vector<std::uint32_t> tags;
    CHECK(walk(ram, 0x1000, [&](std::uint32_t tag, auto) { tags.push_back(tag); }));
    CHECK(tags == std::vector<std::uint32_t>{0x1000, 0x2000, 0x3000});
  }

  TEST_CASE("the end marker as head is an empty list") {
    const MainRam ram(RamSize::mib2);
    CHECK(validate(ram, 0xffffff) == WalkResult{});
  }

  TEST_CASE("a tag that links to itself is a loop from itself") {
    MainRam ram(RamSize::mib2);
    ram.write(0x123000, 0x00123000);
    const auto r = validate(ram, 0x123000);
    CHECK(r == WalkResult{WalkEnd::loop, 0x123000, 0x123000, 1, 0});
    CHECK(r.message() == "tag 123000h is linked again from tag 123000h (a loop)");
  }

  TEST_CASE("a loop names the first tag met twice and the tag that closes it, and sends nothing") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x01002000);
    ram.write(0x2000, 0x01003000);
    ram.write(0x3000, 0x01004000);
    ram.write(0x4000, 0x01002000);
    CHECK(validate(ram, 0x1000) == WalkResult{WalkEnd::loop, 0x2000, 0x4000, 4, 4});
    CHECK(sent(ram, 0x1000).empty());
  }

  TEST_CASE("a mirror of a tag is the same tag") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x00201000);
    CHECK(validate(ram, 0x1000) == WalkResult{WalkEnd::loop, 0x201000, 0x1000, 1, 0});
    MainRam large(RamSize::mib8);
    large.write(0x1000, 0x00201000);
    large.write(0x201000, 0x00ffffff);
    CHECK(validate(large, 0x1000) == WalkResult{.nodes = 2});
  }

  TEST_CASE("a link with bit 23 that is not the end marker is outside RAM") {
    MainRam ram(RamSize::mib2);
    ram.write(0x123000, 0x00900000);
    const auto r = validate(ram, 0x123000);
    CHECK(r == WalkResult{WalkEnd::outside_ram, 0x900000, 0x123000, 1, 0});
    CHECK(r.message() == "tag 123000h links to 900000h, outside RAM");
    CHECK(validate(ram, 0x800000).message() == "the head of the list links to 800000h, outside RAM");
  }

  TEST_CASE("a payload past the end of RAM is refused") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x001ffff8);
    ram.write(0x1ffff8, 0x01ffffff);
    CHECK(validate(ram, 0x1000));
    ram.write(0x1ffff8, 0x02ffffff);
    const auto r = validate(ram, 0x1000);
    CHECK(r == WalkResult{WalkEnd::payload_past_end, 0x1ffff8, 0x1000, 1, 0});
    CHECK(r.message() == "the payload of tag 1FFFF8h (linked from tag 001000h) runs past the end of RAM");
  }

  TEST_CASE("walks of random links end as the plain walk says") {
    std::mt19937 random(3);
    const auto pick = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
    MainRam ram(RamSize::mib2);
    int ends[4] = {};
    for (int n = 0; n < 3000; ++n) {
      const std::uint32_t tags = 1 + pick(60);
      const auto somewhere = [&]() -> std::uint32_t {
        if (pick(50) == 0) return 0xffffff;
        if (pick(200) == 0) return 0x800000 | pick(0x800000);
        return pick(4) * 0x200000 + 0x1ffff0 - pick(tags) * 0x100;
      };
      for (std::uint32_t t = 0; t < tags; ++t) ram.write(0x1ffff0 - t * 0x100, pick(5) << 24 | somewhere());
      const auto first = somewhere();
      const auto expected = walk_with_set(ram, first);
      CHECK(validate(ram, first) == expected);
      ++ends[static_cast<int>(expected.end)];
      std::uint32_t words = 0;
      walk(ram, first,
           [&](std::uint32_t, auto payload) { words += static_cast<std::uint32_t>(payload.size()); });
      CHECK(words == (expected ? expected.words : 0));
    }
    for (const int count : ends) CHECK(count > 50);  // every end was met
  }

  TEST_CASE("a walk to the fault sends what lies before it, each tag of a loop once") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x01002000);
    ram.write(0x1004, 11);
    ram.write(0x2000, 0x01003000);
    ram.write(0x2004, 21);
    ram.write(0x3000, 0x01002000);
    ram.write(0x3004, 31);
    CHECK(sent_to_fault(ram, 0x1000, 100) ==
          Sent{{WalkEnd::loop, 0x2000, 0x3000, 3, 3}, std::vector<std::uint32_t>{11, 21, 31}});
    ram.write(0x3000, 0x01900000);
    CHECK(sent_to_fault(ram, 0x1000, 100) ==
          Sent{{WalkEnd::outside_ram, 0x900000, 0x3000, 3, 3}, std::vector<std::uint32_t>{11, 21, 31}});
    CHECK(sent_to_fault(ram, 0x900000, 100) == Sent{{WalkEnd::outside_ram, 0x900000, no_tag, 0, 0}, {}});
  }

  TEST_CASE("a walk to the fault sends as many tags as it may and names the next one") {
    MainRam ram(RamSize::mib2);
    ram.write(0x1000, 0x01002000);
    ram.write(0x1004, 11);
    ram.write(0x2000, 0x01003000);
    ram.write(0x2004, 21);
    ram.write(0x3000, 0x00ffffff);
    const Sent cut{{WalkEnd::too_long, 0x3000, 0x2000, 2, 2}, {11, 21}};
    CHECK(sent_to_fault(ram, 0x1000, 2) == cut);
    CHECK(cut.result.message() ==
          "the list goes on after 2 tags, with tag 003000h (linked from tag 002000h)");
    CHECK(sent_to_fault(ram, 0x1000, 3) == Sent{{.nodes = 3, .words = 2}, {11, 21}});
    CHECK(sent_to_fault(ram, 0x1000, 0) == Sent{{WalkEnd::too_long, 0x1000, no_tag, 0, 0}, {}});
  }

  TEST_CASE("a loop is called a loop as long as its tags are no more than allowed") {
    for (std::uint32_t length = 1; length < 40; ++length) {
      for (std::uint32_t back = 0; back < length; ++back) {
        MainRam ram(RamSize::mib2);
        for (std::uint32_t t = 0; t < length; ++t) ram.write(16 * t, 16 * (t + 1 < length ? t + 1 : back));
        CHECK(validate(ram.words(), 0, length) == validate(ram, 0));
        CHECK(validate(ram.words(), 0, length - 1).end == WalkEnd::too_long);
      }
    }
  }

  TEST_CASE("a loop through all of RAM is found") {
    MainRam ram(RamSize::mib8);
    for (std::uint32_t at = 0; at < ram.size_bytes(); at += 4) ram.write(at, (at + 4) % ram.size_bytes());
    CHECK(validate(ram, 0) == WalkResult{WalkEnd::loop, 0, ram.size_bytes() - 4, ram.size_bytes() / 4, 0});
  }
}
