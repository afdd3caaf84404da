#pragma once
// A rectangle of VRAM that is being filled, copied, sent or received, and the cache of one palette.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "gpu/primitive.h"
#include "gpu/state.h"
#include "gpu/vram.h"

namespace gpu {

/// A rectangle that words go into or come out of, row by row; both coordinates wrap.
struct Transfer {
  int x = 0, y = 0, width = 0, height = 0;
  int column = 0, row = 0;       ///< the next pixel
  std::uint32_t draw = no_draw;  ///< number in the trace

  [[nodiscard]] bool is_active() const { return row < height; }
  [[nodiscard]] std::int64_t pixels_left() const { return std::int64_t{height - row} * width - column; }
  /// By pixels of one row.
  void advance(int count) {
    column += count;
    if (column < width) return;
    column = 0;
    ++row;
  }
};

/// Pixels of a row that a copy reads before it writes them. [GPU copies]
inline constexpr int copied_at_once = 128;

/// f(x, y, count) for the pieces of a copy in the order made: rows from the top, in a row from the left. All
/// pixels of a piece are read before they are written. x, y count from the corners.
template <class F>
void for_each_copied_piece(const Primitive& copy, F&& f) {
  for (int y = 0; y < copy.height; ++y) {
    for (int x = 0; x < copy.width; x += copied_at_once) f(x, y, std::min(copied_at_once, copy.width - x));
  }
}

/// The GPU's copy of the palette in use: loaded when a textured primitive names another one, and not when
/// VRAM changes under it. [docs/hardware.md#clut-cache]
class ClutCache {
 public:
  /// 256 entries, and two halfwords that a vector may read and nobody uses.
  static constexpr std::size_t size = 256 + 2;

  void invalidate() { tag_ = no_tag; }
  /// Before a textured primitive. 15-bit textures neither load nor invalidate; a palette loaded for 8-bit
  /// texels serves 4-bit ones, the other way round it is loaded again.
  void use(const Vram& vram, std::uint16_t clut, TexelFormat format);
  [[nodiscard]] const std::uint16_t* entries() const { return entries_.data(); }
  /// Counts loads: two primitives with the same number saw the same palette.
  [[nodiscard]] std::uint32_t loads() const { return loads_; }
  /// All that it consists of, for saved states.
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& visitor) {
    visitor(self.entries_, self.loads_, self.tag_, self.loaded_);
  }

 private:
  static constexpr std::uint32_t no_tag = 0xffffffff;

  alignas(64) std::array<std::uint16_t, size> entries_{};
  std::uint32_t loads_ = 0;
  std::uint32_t tag_ = no_tag;  // CLUT halfword without bit 15
  TexelFormat loaded_ = TexelFormat::none;
};

}  // namespace gpu
