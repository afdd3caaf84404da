#pragma once
// Which of many keys are equal, in a time that no choice of keys can stretch: by sorting, not by hashing.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace load {

struct Distinct {
  std::vector<std::uint32_t> number;  ///< of each key; equal ones have one, counted by first appearance
  std::vector<std::uint32_t> first;   ///< of each number: the first key that has it
};

/// `Key` needs operator<. Takes O(n log n).
template <class Key>
Distinct number_distinct(const std::vector<Key>& keys) {
  struct Item {
    Key key;
    std::uint32_t index;
  };
  std::vector<Item> items;
  items.reserve(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) items.push_back({keys[i], i});
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return a.key < b.key || (!(b.key < a.key) && a.index < b.index);
  });
  Distinct out;
  out.number.resize(keys.size());  // until numbered: the first key equal to it
  for (std::size_t i = 0, begin = 0; i < items.size(); ++i) {
    if (items[begin].key < items[i].key) begin = i;
    out.number[items[i].index] = items[begin].index;
  }
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    if (out.number[i] == i) {
      out.number[i] = static_cast<std::uint32_t>(out.first.size());
      out.first.push_back(i);
    } else {
      out.number[i] = out.number[out.number[i]];
    }
  }
  return out;
}

}  // namespace load
