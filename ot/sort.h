#pragma once
// A list sorted by key, without buckets: what the ordering table approximates. O(n) passes over the keys,
// each of them over all primitives, where the table needs one store a primitive.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ot/field.h"

namespace ot {

/// A node, or a chain of nodes, and where it belongs: larger keys are farther.
struct Keyed {
  std::uint32_t key = 0;
  std::uint32_t first_node = 0, last_node = 0;
  bool operator==(const Keyed&) const = default;
};

/// One stable pass of a radix sort, ascending by `bits` bits of the keys from `shift` on (16 at most).
template <class Item>
void radix_pass(std::span<const Item> from, std::span<Item> to, int shift, int bits) {
  const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
  std::vector<std::uint32_t> begin(std::size_t{mask} + 2);
  for (const auto& item : from) ++begin[(item.key >> shift & mask) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  for (const auto& item : from) to[begin[item.key >> shift & mask]++] = item;
}

/// Collects primitives and chains them far to near. Of equal keys the last inserted is drawn first, as in a
/// bucket of the ordering table.
class SortedList {
 public:
  void clear() { items_.clear(); }
  void insert(std::uint32_t key, std::uint32_t first_node, std::uint32_t last_node) {
    items_.push_back({key, first_node, last_node});
  }
  [[nodiscard]] std::size_t size() const { return items_.size(); }

  /// Sorts, links each node's end to the next one's beginning in `memory` (byte links), the last one to
  /// tag::end, and returns the head; tag::end if there is nothing.
  std::uint32_t link(std::span<std::uint32_t> memory);

  /// In the order of drawing, after link().
  [[nodiscard]] std::span<const Keyed> items() const { return items_; }

 private:
  std::vector<Keyed> items_, scratch_;
};

}  // namespace ot
