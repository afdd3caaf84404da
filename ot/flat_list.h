#pragma once
// The same walk, faster: a list that goes through an ordering table is followed from many of its entries at
// once, so that the waits for memory overlap, into a flat list of tags. Same order, same faults found, same
// result as walk().

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ot/ordering_table.h"
#include "ot/walker.h"

namespace ot {

/// Scratch memory for walks, kept between frames: 4 bytes a tag.
template <class Links>
class FlatList {
 public:
  /// Follows the list that begins at `first` and runs through `table`. The result is that of validate();
  /// after a good one send() may be called until the list is changed.
  ///
  /// Lanes follow pieces of the list, each from one entry of the table to the next one below that another
  /// lane began with. If every lane arrives there and the last one at tag::end, the pieces are the list. If
  /// one does not (a packet linked twice skips entries, a list loops, a link is bad), the list is validated
  /// tag by tag.
  WalkResult follow(const BasicOrderingTable<Links>& table, std::uint32_t first);

  /// Calls sink(tag_address, payload) in list order as walk() does, but only for nodes with a payload: the
  /// entries of the table send nothing.
  template <class Sink>
  void send(Sink&& sink) const {
    for (const auto& piece : pieces_) {
      send_tags(std::span(tags_[piece.lane]).subspan(piece.begin, piece.end - piece.begin), sink);
    }
  }

  template <class Sink>
  WalkResult walk(const BasicOrderingTable<Links>& table, std::uint32_t first, Sink&& sink) {
    const auto result = follow(table, first);
    if (result) send(sink);
    return result;
  }

 private:
  static constexpr std::size_t lanes = 32;            ///< pieces followed at once
  static constexpr std::size_t ahead = 24;            ///< tags that are fetched before they are sent
  static constexpr std::uint32_t piece_entries = 32;  ///< entries of the table in a piece

  struct Piece {
    std::uint32_t lane, begin, end;  ///< tags_[lane][begin .. end-1]
  };
  struct Lane {
    std::uint32_t address = 0, stop = 0, piece = 0;
    std::uint32_t begin = 0, count = 0;  ///< tags_: where the piece begins, where the next tag goes
    std::uint32_t nodes = 0, words = 0;
  };

  void fetch(std::uint32_t address) const {
    const auto* at = memory_.data() + Links::index(address, memory_.size());
    __builtin_prefetch(at);
    __builtin_prefetch(at + 9);  // most packets are 10 words long: the end may lie in the next line
  }

  template <class Sink>
  void send_tags(std::span<const std::uint32_t> tags, Sink& sink) const {
    for (std::size_t n = 0; n < tags.size(); ++n) {
      if (n + ahead < tags.size()) fetch(tags[n + ahead]);
      const auto index = Links::index(tags[n], memory_.size());
      sink(tags[n], memory_.subspan(index + 1, tag::Length::get(memory_[index])));
    }
  }

  bool follow_table(const BasicOrderingTable<Links>& table, WalkResult& result);
  WalkResult follow_plainly(std::uint32_t first);

  std::span<const std::uint32_t> memory_;
  std::array<std::vector<std::uint32_t>, lanes> tags_;
  std::vector<Piece> pieces_;
};

extern template class FlatList<ByteLinks>;
extern template class FlatList<WordLinks>;

}  // namespace ot
