#include "ot/walker.h"

#include <string>

#include "ot/describe.h"

namespace ot {
namespace {

/// The tags of a list one by one. Stands on a tag or, when `fault` is set or the
/// list is at its end, before it.
struct Steps {
  std::span<const std::uint32_t> memory;
  std::uint32_t address;
  std::uint32_t from = no_tag;

  [[nodiscard]] std::size_t index() const { return links::index(address, memory.size()); }
  [[nodiscard]] std::uint32_t word() const { return memory[index()]; }
  [[nodiscard]] bool at_end() const { return address == tag::end; }
  void step() {
    const auto next = tag::Next::get(word());
    from = address;
    address = next;
  }
};

/// The list is known to loop with a period of `length` tags: the first tag that is met twice, who links to
/// it, and what lies before.
WalkResult describe_loop(std::span<const std::uint32_t> memory, std::uint32_t first, std::size_t length) {
  WalkResult result{.end = WalkEnd::loop};
  Steps behind{memory, first};
  Steps ahead{memory, first};
  const auto step_ahead = [&] {
    ++result.nodes;
    result.words += tag::Length::get(ahead.word());
    ahead.step();
  };
  for (std::size_t n = 0; n < length; ++n) step_ahead();
  while (ahead.index() != behind.index()) {
    step_ahead();
    behind.step();
  }
  result.bad_tag = ahead.address;
  result.linked_from = ahead.from;
  return result;
}

/// Where the list ends, or how it fails to, unless that takes more than `max_steps`: then too_long, without
/// the tag.
WalkResult find_end(std::span<const std::uint32_t> memory, std::uint32_t first, std::uint64_t max_steps) {
  WalkResult result;
  const auto stop = [&](WalkEnd end, const Steps& at) {
    result.end = end;
    result.bad_tag = at.address;
    result.linked_from = at.from;
    return result;
  };
  // Brent: remember the tag met at every power of two; a loop meets it again.
  std::size_t remembered = memory.size();
  std::size_t since = 0;
  std::size_t limit = 1;
  for (Steps at{memory, first}; !at.at_end(); at.step()) {
    if (links::is_outside(at.address)) return stop(WalkEnd::outside_ram, at);
    const auto index = at.index();
    if (index == remembered) return describe_loop(memory, first, since);
    if (since == limit || remembered == memory.size()) {
      if (since == limit) limit *= 2;
      remembered = index;
      since = 0;
    }
    const auto length = tag::Length::get(memory[index]);
    if (index + 1 + length > memory.size()) return stop(WalkEnd::payload_past_end, at);
    if (result.nodes == max_steps) return stop(WalkEnd::too_long, at);
    ++since;
    ++result.nodes;
    result.words += length;
  }
  return result;
}

/// The list has more good tags than `max_nodes`.
WalkResult cut(std::span<const std::uint32_t> memory, std::uint32_t first, std::uint32_t max_nodes) {
  WalkResult result{.end = WalkEnd::too_long, .nodes = max_nodes};
  Steps at{memory, first};
  for (std::uint32_t n = 0; n < max_nodes; ++n, at.step()) result.words += tag::Length::get(at.word());
  result.bad_tag = at.address;
  result.linked_from = at.from;
  return result;
}

}  // namespace

WalkResult validate(std::span<const std::uint32_t> memory, std::uint32_t first, std::uint32_t max_nodes) {
  // A loop of n tags, those before it included, is found within 3 n steps.
  const WalkResult result = find_end(memory, first, 3 * std::uint64_t{max_nodes} + 3);
  return result.nodes > max_nodes ? cut(memory, first, max_nodes) : result;
}

std::string WalkResult::message() const {
  const std::string from =
      linked_from == no_tag ? "the head of the list" : "tag " + address_text(linked_from);
  switch (end) {
    case WalkEnd::loop:
      return "tag " + address_text(bad_tag) + " is linked again from " + from + " (a loop)";
    case WalkEnd::outside_ram:
      return from + " links to " + address_text(bad_tag) + ", outside RAM";
    case WalkEnd::payload_past_end:
      return "the payload of tag " + address_text(bad_tag) + " (linked from " + from +
             ") runs past the end of RAM";
    case WalkEnd::too_long:
      return "the list goes on after " + std::to_string(nodes) + " tags, with tag " + address_text(bad_tag) +
             " (linked from " + from + ")";
    case WalkEnd::done:
      break;
  }
  return std::to_string(nodes) + " tags, " + std::to_string(words) + " words";
}

}  // namespace ot
