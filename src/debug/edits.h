#pragma once
// What if: a clip with commands left out, moved or changed. The clip itself stays as it is; every change can
// be taken back.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "debug/clip.h"

namespace debug {

/// All of it by index into Clip::items as the frame was sent.
struct Edits {
  std::set<std::size_t> hidden{};
  std::set<std::size_t> solo{};  ///< not empty: of all drawing commands only these
  struct Move {
    std::size_t item = 0, target = 0;
    bool is_behind = false;  ///< of the target; else before it
    bool operator==(const Move&) const = default;
  };
  std::vector<Move> moves{};                                  ///< one after the other
  std::map<std::size_t, std::vector<std::uint32_t>> words{};  ///< in place of an item's own
  std::map<std::size_t, std::uint32_t> buckets{};             ///< it is linked into this one instead

  bool operator==(const Edits&) const = default;
  [[nodiscard]] bool is_empty() const { return *this == Edits{}; }
};

/// The clip as it is with the edits, and for each of its items the index it had.
struct Edited {
  Clip clip;
  std::vector<std::size_t> origin;
};
/// A command that is left out keeps what it sets: a hidden polygon still changes the texture page of those
/// that read it from the draw mode. An item linked into another bucket is the first drawn of it, as AddPrim
/// does. [docs/hardware.md]
Edited apply(const Clip& clip, const Edits& edits);

// --- the words of a command, by meaning ---

/// Where the vertices of a polygon, line, rectangle, fill, copy or upload stand in Item::words.
std::vector<std::size_t> vertex_words(const Item& item);
/// Where its colours stand.
std::vector<std::size_t> colour_words(const Item& item);

/// x and y of a vertex word, 11 bits with sign, and back; other bits stay.
struct Corner {
  int x = 0, y = 0;
};
Corner corner_of(std::uint32_t word);
std::uint32_t with_corner(std::uint32_t word, Corner corner);

}  // namespace debug
