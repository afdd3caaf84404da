#pragma once
// Primitives into lists in main RAM. A frame that does not fit is cut into ranges of buckets, each a list of
// its own, drawn far to near.
//
//     10000h  environment: draw area, offset, mask, fill      (the first 64 KiB are the console's kernel)
//             ordering table, one word a bucket
//             packets: [annotation node ->] primitive node

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ot/main_ram.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"
#include "ot/sort.h"
#include "scene/frame.h"
#include "scene/plan.h"
#include "scene/submit.h"

namespace scene {

/// Words of a primitive's own node; at most 14.
std::size_t encode(const Primitive& p, const PacketStyle& style, std::span<std::uint32_t> out);
/// Words of its annotation node; at most 14.
std::size_t encode_annotation(const Primitive& p, const PacketStyle& style, std::span<std::uint32_t> out);

/// Buckets first..last, both included.
struct BucketRange {
  std::uint32_t first = 0, last = 0;
};

/// Counts the bytes of every bucket, and cuts them into ranges that fit.
class BucketSizes {
 public:
  BucketSizes(const BucketRule& rule, const PacketStyle& style)
      : rule_(rule), style_(style), bytes_(rule.length) {}
  void operator()(const Primitive& p) { add(p, rule_.of(p)); }
  void add(const Primitive& p, std::uint32_t bucket);
  /// Ranges far to near, each at most `available` bytes. Error: the number of a
  /// bucket that is larger than that.
  [[nodiscard]] base::Result<std::vector<BucketRange>> ranges(std::uint32_t available) const;

 private:
  BucketRule rule_;
  PacketStyle style_;
  std::vector<std::uint32_t> bytes_;
};

/// The list in RAM. One object lives through all frames, so that its memory does, too.
class ListBuilder {
 public:
  /// Clears the table and writes the environment node.
  void begin(ot::MainRam& ram, const Plan& plan, const BucketRange& range,
             std::span<const std::uint32_t> environment);
  void operator()(const Primitive& p) {
    const std::int64_t wanted = rule_.wanted(p);
    if (add(p, rule_.limited(wanted)) && (wanted < 0 || wanted >= rule_.length)) note_out_of_range(wanted);
  }
  /// The same into a bucket of the caller's choice. False: it belongs to another list, or there is no room.
  bool add(const Primitive& p, std::uint32_t bucket);
  /// Links everything; afterwards the list can be walked from head().
  void end();

  /// Visibility sorted and bsp, after end(): a primitive's bucket and the first tag
  /// of its nodes, in list order.
  [[nodiscard]] std::span<const ot::Keyed> sorted() const { return sorted_.items(); }

  [[nodiscard]] bool is_full() const { return full_; }
  [[nodiscard]] std::uint32_t head() const;
  [[nodiscard]] std::uint32_t table_address() const;
  [[nodiscard]] std::uint32_t table_length() const { return sorts_ ? 0 : rule_.length; }
  [[nodiscard]] std::uint32_t primitives() const { return primitives_; }
  [[nodiscard]] const OutOfRange& out_of_range() const { return out_of_range_; }
  [[nodiscard]] std::uint32_t words() const { return words_; }
  [[nodiscard]] std::uint32_t ram_bytes() const;
  /// Bytes for packets in a RAM of that size.
  [[nodiscard]] static std::uint32_t room(const ot::MainRam& ram, std::uint32_t table_length);

 private:
  void note_out_of_range(std::int64_t wanted);

  ot::MainRam* ram_ = nullptr;
  std::optional<ot::OrderingTable> table_;
  std::optional<ot::PacketArena> arena_;
  std::vector<ot::Keyed> keyed_;
  ot::SortedList sorted_;
  BucketRule rule_;
  PacketStyle style_;
  BucketRange range_;
  ot::Order order_ = ot::Order::lifo;
  bool sorts_ = false, full_ = false;
  std::uint32_t arena_begin_ = 0, primitives_ = 0, words_ = 0;
  OutOfRange out_of_range_;
};

}  // namespace scene
