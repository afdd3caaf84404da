#pragma once
// Semi-transparent polygons of a z-buffered frame, waiting for all that is opaque.

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/primitive.h"
#include "gpu/transfer.h"

namespace gpu {

/// Each polygon keeps the draw state it was issued under, its palette included:
/// later commands may change both.
class DepthQueue {
 public:
  struct Entry {
    Primitive primitive;
    std::uint32_t palette = 0;   ///< index for palette()
    std::uint32_t farthest = 0;  ///< largest z of its vertices
    std::uint32_t draw = 0;      ///< number in the trace
  };

  /// A frame of more is drawn in groups of so many, each far to near, so that no stream takes more memory
  /// than a large scene does. [ours]
  static constexpr std::size_t most = std::size_t{1} << 19;

  [[nodiscard]] bool is_empty() const { return entries_.empty(); }
  [[nodiscard]] bool is_full() const { return entries_.size() >= most || palettes_.size() >= most / 4; }
  void add(const Primitive& primitive, const ClutCache& clut, std::uint32_t draw);
  /// Far to near; equal ones in list order. [ours]
  void sort();
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] std::vector<Entry>& entries() { return entries_; }
  [[nodiscard]] const std::uint16_t* palette(const Entry& entry) const {
    return palettes_[entry.palette].data();
  }
  /// The trace that gave them their numbers is gone.
  void forget_draws() {
    for (Entry& entry : entries_) entry.draw = no_draw;
  }
  /// Keeps the memory for the next frame.
  void clear();
  [[nodiscard]] std::uint64_t bytes() const;

  using Palette = std::array<std::uint16_t, ClutCache::size>;
  /// All that it consists of, for saved states.
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor(self.entries_, self.palettes_, self.last_load_);
  }

 private:
  std::vector<Entry> entries_;
  std::vector<Palette> palettes_;
  std::uint32_t last_load_ = 0;  // ClutCache::loads() when the last palette was copied
};

}  // namespace gpu
