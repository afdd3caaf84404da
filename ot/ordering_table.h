#pragma once
// The ordering table: an array of tags without payload, each linked to the one before it. Inserting a packet
// at entry k puts it into the list just behind that entry, so a table is a bucket sort that costs O(1) a
// packet. Entry length-1 is the head of the list: drawn first, farthest away.
//
// Not modelled: the time DMA6 takes to clear a table (ot/dma.h has its registers).

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ot/field.h"
#include "ot/links.h"
#include "ot/main_ram.h"

namespace ot {

enum class Order : std::uint8_t {
  lifo,  ///< the console's AddPrim: within a bucket the last packet inserted is drawn first
  fifo,  ///< within a bucket the first packet inserted is drawn first; keeps a tail per bucket
};

/// A table of `length` entries at `base` (a link; word aligned) in memory that the caller owns and that
/// outlives the table. Nothing is written until clear().
class OrderingTable {
 public:
  OrderingTable(std::span<std::uint32_t> memory, std::uint32_t base, std::uint32_t length,
                Order order = Order::lifo)
      : memory_(memory), base_(base), length_(length), order_(order) {
    assert(length > 0 && base % links::unit == 0);
    assert(base / links::unit + std::size_t{length} <= memory.size());
  }
  OrderingTable(MainRam& ram, std::uint32_t base, std::uint32_t length, Order order = Order::lifo)
      : OrderingTable(ram.words(), base, length, order) {}

  /// What OTC (DMA6) writes: entry k links to entry k-1, entry 0 ends the list. [docs/hardware.md#otc]
  void clear() {
    const auto entries = memory_.subspan(base_ / links::unit, length_);
    entries[0] = tag::end;
    for (std::uint32_t k = 1; k < length_; ++k) entries[k] = tag::Next::put(entry(k - 1));
    if (order_ == Order::fifo) {
      tails_.resize(length_);
      for (std::uint32_t k = 0; k < length_; ++k) tails_[k] = entry(k);
    }
  }

  /// Puts a node, or nodes already chained from `first_node` to `last_node`, into bucket 0..length-1. A chain
  /// keeps its order. The lengths of all tags stay.
  void insert(std::uint32_t bucket, std::uint32_t first_node, std::uint32_t last_node) {
    assert(bucket < length_);
    std::uint32_t before = entry(bucket);
    if (order_ == Order::fifo) {
      before = tails_[bucket];
      tails_[bucket] = last_node;
    }
    std::uint32_t& from = at(before);
    std::uint32_t& last = at(last_node);
    last = tag::Next::set(last, from);
    from = tag::Next::set(from, first_node);
  }
  void insert(std::uint32_t bucket, std::uint32_t node) { insert(bucket, node, node); }

  /// Puts a whole table into a bucket: a model that sorts by itself and lies in the scene as
  /// one. Call it after inner.clear() and before anything is inserted into `inner`, whose
  /// packets then find their way by themselves.
  void insert(std::uint32_t bucket, const OrderingTable& inner) {
    assert(tag::Next::get(at(inner.entry(0))) == tag::end);
    insert(bucket, inner.head(), inner.entry(0));
  }

  /// The tag at which drawing starts.
  [[nodiscard]] std::uint32_t head() const { return entry(length_ - 1); }
  /// The tag of one bucket: the walk passes it before the packets of the bucket.
  [[nodiscard]] std::uint32_t entry(std::uint32_t bucket) const { return base_ + bucket * links::unit; }
  /// The bucket whose entry this tag is; nothing for every other tag.
  [[nodiscard]] std::optional<std::uint32_t> bucket_of(std::uint32_t tag_address) const {
    const auto bucket = (tag_address - base_) / links::unit;  // wraps far beyond length below the base
    if (tag_address < base_ || bucket >= length_) return std::nullopt;
    return bucket;
  }
  [[nodiscard]] std::uint32_t length() const { return length_; }
  [[nodiscard]] std::uint32_t base() const { return base_; }
  [[nodiscard]] Order order() const { return order_; }
  [[nodiscard]] std::span<const std::uint32_t> memory() const { return memory_; }

 private:
  std::uint32_t& at(std::uint32_t link) { return memory_[links::index(link, memory_.size())]; }

  std::span<std::uint32_t> memory_;
  std::uint32_t base_, length_;
  Order order_;
  std::vector<std::uint32_t> tails_;  ///< last node of each bucket; fifo only
};

}  // namespace ot
