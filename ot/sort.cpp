#include "ot/sort.h"

#include <algorithm>
#include <bit>

#include "ot/links.h"

namespace ot {

std::uint32_t SortedList::link(std::span<std::uint32_t> memory) {
  // Ascending, and the whole turned round: the largest key first, of equal keys the last inserted.
  std::uint32_t all_bits = 0;
  for (const auto& item : items_) all_bits |= item.key;
  constexpr int digit = 11;  // 2048 counters stay in the first-level cache
  scratch_.resize(items_.size());
  for (int shift = 0; shift < static_cast<int>(std::bit_width(all_bits)); shift += digit) {
    radix_pass<Keyed>(items_, scratch_, shift, digit);
    items_.swap(scratch_);
  }
  std::ranges::reverse(items_);

  std::uint32_t next = tag::end;
  for (auto item = items_.rbegin(); item != items_.rend(); ++item) {
    auto& last = memory[links::index(item->last_node, memory.size())];
    last = tag::Next::set(last, next);
    next = item->first_node;
  }
  return next;
}

}  // namespace ot
