#pragma once
// walk: follows the links of a list and hands every payload on, in list order. What DMA2 does in linked-list
// mode, except that the list is checked first: a list that does not end well sends nothing, or, with
// walk_to_fault, what lies before its fault. (The registers of DMA2, which loop for ever as the console does,
// are ot/dma.h.)

#include <cstdint>
#include <span>
#include <string>

#include "ot/field.h"
#include "ot/links.h"
#include "ot/main_ram.h"

namespace ot {

enum class WalkEnd : std::uint8_t {
  done,              ///< the list ended with tag::end
  loop,              ///< a link leads back to a tag already visited
  outside_ram,       ///< a link has bit 23 set and is not tag::end
  payload_past_end,  ///< a payload does not fit between its tag and the end of RAM
  too_long,          ///< there are more tags than the caller allows
};

inline constexpr std::uint32_t no_tag = 0xffffffff;
/// More tags than any memory has: a list is as long as it likes.
inline constexpr std::uint32_t any_number_of_nodes = 0xffffffff;

struct WalkResult {
  WalkEnd end = WalkEnd::done;
  /// loop: the first tag met twice; too_long: the first tag too many; else the tag that cannot be read
  std::uint32_t bad_tag = no_tag;
  std::uint32_t linked_from = no_tag;  ///< the tag whose link led there; no_tag: it was the first of the list
  std::uint32_t nodes = 0;             ///< good tags up to the end or the fault, each counted once
  std::uint32_t words = 0;             ///< payload words of those

  explicit operator bool() const { return end == WalkEnd::done; }
  /// One clause: "tag 123000h is linked again from tag 12300Ch (a loop)".
  [[nodiscard]] std::string message() const;
  bool operator==(const WalkResult&) const = default;
};

/// Follows a list from `first` without reading payloads. Time grows with the number of tags, also for a loop
/// (Brent's cycle search), and no further than with three times `max_nodes`; nothing is allocated. The first
/// tag::end met ends the list, after its payload.
WalkResult validate(std::span<const std::uint32_t> memory, std::uint32_t first,
                    std::uint32_t max_nodes = any_number_of_nodes);

inline WalkResult validate(const MainRam& ram, std::uint32_t first) { return validate(ram.words(), first); }

/// Calls sink(tag_address, payload) for the first `nodes` tags, all of them good.
template <class Sink>
void send_nodes(std::span<const std::uint32_t> memory, std::uint32_t first, std::uint32_t nodes,
                Sink&& sink) {
  std::uint32_t address = first;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const auto index = links::index(address, memory.size());
    const auto word = memory[index];
    sink(address, memory.subspan(index + 1, tag::Length::get(word)));
    address = tag::Next::get(word);
  }
}

/// Calls sink(tag_address, payload) for every node, payloads of 0 words (table entries) included. The address
/// is the link as stored; the span lies in `memory`, which the sink must not write to. Nothing is sent unless
/// the whole list is good.
template <class Sink>
WalkResult walk(std::span<const std::uint32_t> memory, std::uint32_t first, Sink&& sink) {
  const WalkResult result = validate(memory, first);
  if (result) send_nodes(memory, first, result.nodes, sink);
  return result;
}

/// The same for a host whose program may send any list: what lies before a fault is sent, each tag of a loop
/// once, `max_nodes` tags at most. The result tells the fault.
template <class Sink>
WalkResult walk_to_fault(std::span<const std::uint32_t> memory, std::uint32_t first, std::uint32_t max_nodes,
                         Sink&& sink) {
  const WalkResult result = validate(memory, first, max_nodes);
  send_nodes(memory, first, result.nodes, sink);
  return result;
}

template <class Sink>
WalkResult walk(const MainRam& ram, std::uint32_t first, Sink&& sink) {
  return walk(ram.words(), first, sink);
}

}  // namespace ot
