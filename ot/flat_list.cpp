#include "ot/flat_list.h"

#include <algorithm>

namespace ot {

template <class Links>
WalkResult FlatList<Links>::follow(const BasicOrderingTable<Links>& table, std::uint32_t first) {
  memory_ = table.memory();
  WalkResult result;
  if (first == table.head() && follow_table(table, result)) return result;
  return follow_plainly(first);
}

/// False: the list is not simply what hangs on the table, from its head to an end.
template <class Links>
bool FlatList<Links>::follow_table(const BasicOrderingTable<Links>& table, WalkResult& result) {
  const auto words = memory_.size();
  const auto count = (table.length() + piece_entries - 1) / piece_entries;
  pieces_.resize(count);
  // Piece 0 begins at the head; piece p stops where piece p+1 begins.
  const auto begin_of = [&](std::uint32_t p) { return table.entry(table.length() - 1 - p * piece_entries); };
  const auto stop_of = [&](std::uint32_t p) { return p + 1 < count ? begin_of(p + 1) : tag::end; };

  std::array<Lane, lanes> lane{};
  std::uint32_t next_piece = 0;
  std::size_t running = 0;
  for (; running < lanes && next_piece < count; ++running, ++next_piece) {
    lane[running] = {.address = begin_of(next_piece), .stop = stop_of(next_piece), .piece = next_piece};
  }
  // The buffers never need more room than one tag for each word; they keep what they have grown to.
  for (auto& tags : tags_) tags.resize(std::max<std::size_t>(tags.size(), 1024));

  // A lane that has no piece left changes places with the last one that runs.
  std::array<std::uint32_t, lanes> buffer{};
  for (std::uint32_t l = 0; l < lanes; ++l) buffer[l] = l;
  while (running > 0) {
    for (std::size_t l = 0; l < running;) {
      Lane& at = lane[l];
      auto& tags = tags_[buffer[l]];
      const auto index = Links::index(at.address, words);
      const auto word = memory_[index];
      const auto length = tag::Length::get(word);
      if (index + 1 + length > words) return false;
      if (at.nodes > words) return false;  // more tags than words: a loop
      if (at.count == tags.size()) tags.resize(2 * tags.size());
      tags[at.count] = at.address;
      at.count += length != 0 ? 1 : 0;  // no branch: whether a tag has a payload cannot be predicted
      ++at.nodes;
      at.words += length;
      const auto next = tag::Next::get(word);
      at.address = next;
      if (next == at.stop) {
        pieces_[at.piece] = {buffer[l], at.begin, at.count};
        if (next_piece < count) {
          at.address = begin_of(next_piece);
          at.stop = stop_of(next_piece);
          at.begin = at.count;
          at.piece = next_piece++;
        } else {
          result.nodes += at.nodes;
          result.words += at.words;
          --running;
          std::swap(lane[l], lane[running]);
          std::swap(buffer[l], buffer[running]);
          continue;
        }
      } else if (Links::is_outside(next, words)) {
        return false;  // also tag::end before its time
      }
      __builtin_prefetch(
          &memory_[Links::index(at.address, words)]);  // read when its turn comes, a round later
      ++l;
    }
  }
  return true;
}

template <class Links>
WalkResult FlatList<Links>::follow_plainly(std::uint32_t first) {
  const auto result = validate<Links>(memory_, first);
  pieces_.clear();
  if (!result) return result;
  auto& tags = tags_[0];
  tags.resize(std::max<std::size_t>(tags.size(), result.nodes));
  auto address = first;
  std::uint32_t count = 0;
  for (std::uint32_t n = 0; n < result.nodes; ++n) {
    const auto word = memory_[Links::index(address, memory_.size())];
    tags[count] = address;
    count += tag::Length::get(word) != 0 ? 1 : 0;
    address = tag::Next::get(word);
  }
  pieces_.push_back({0, 0, count});
  return result;
}

template class FlatList<ByteLinks>;
template class FlatList<WordLinks>;

}  // namespace ot
