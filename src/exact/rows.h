#pragma once
// Which pixels a triangle covers: the hardware's rule, with sub-pixel corners allowed. Sample
// points are the integer coordinates; left and top edges are inside, right and bottom edges are
// not. [docs/hardware.md#top-left-rule]

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "exact/depth_order.h"
#include "gpu/columns.h"

namespace exact {

using gpu::Columns;  // the pixels left .. right-1 of a row

/// Consecutive rows from `top` down, one span each.
struct Rows {
  int top = 0;
  std::vector<Columns> spans;

  [[nodiscard]] int bottom() const {
    return top + static_cast<int>(spans.size());
  }  ///< one past the last row
  [[nodiscard]] Columns at(int y) const {
    return y < top || y >= bottom() ? Columns{} : spans[static_cast<std::size_t>(y - top)];
  }
  [[nodiscard]] bool covers(int x, int y) const {
    const Columns span = at(y);
    return x >= span.left && x < span.right;
  }
  [[nodiscard]] std::uint64_t pixels() const;
  bool operator==(const Rows&) const = default;
};

/// All four edges inside it, as the drawing area.
struct Area {
  int left = 0, top = 0, right = 1023, bottom = 511;
  bool operator==(const Area&) const = default;
};

/// The covered pixels of `corners` inside `area`. A row that holds none is an empty span; no rows at top and
/// bottom are empty. Corners within corner_limit; the size rule is the caller's.
Rows covered_rows(std::array<Corner, 3> corners, const Area& area);

/// Drops empty rows at top and bottom.
void trim(Rows& rows);

}  // namespace exact
