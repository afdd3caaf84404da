#pragma once
// Which pixels a triangle covers: the hardware's rule, exactly, for everyone who must agree with it.
//
// The sample point of pixel (x, y) is (x, y) itself. Left and top edges belong to the triangle, right and
// bottom ones do not, so two triangles that share an edge share no pixel and leave no hole.
// [docs/hardware.md#top-left-rule]

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "gpu/rules.h"

namespace gpu {

struct Point {
  std::int32_t x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

using Corners = std::array<Point, 3>;

/// Twice the signed area; 0 for a needle without any.
constexpr std::int32_t doubled_area(const Corners& c) {
  return (c[1].x - c[0].x) * (c[2].y - c[1].y) - (c[2].x - c[1].x) * (c[1].y - c[0].y);
}

constexpr bool is_too_large(const Corners& c) {
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
  return is_too_large(right - left, bottom - top);
}

/// The corners from top to bottom; of equal rows the earlier comes first.
constexpr Corners sorted_by_row(Corners c) {
  if (c[1].y < c[0].y) std::swap(c[0], c[1]);
  if (c[2].y < c[1].y) std::swap(c[1], c[2]);
  if (c[1].y < c[0].y) std::swap(c[0], c[1]);
  return c;
}

/// The smallest integer not left of the edge from a (above) to b at a row; b.y > a.y.
constexpr std::int32_t edge_at(Point a, Point b, std::int32_t row) {
  const std::int64_t numerator = std::int64_t{b.x - a.x} * (row - a.y);
  const std::int32_t height = b.y - a.y;
  const auto quotient = static_cast<std::int32_t>(numerator / height);
  return a.x + quotient + (numerator % height > 0 ? 1 : 0);
}

/// The columns of one row, left .. right-1; left == right when there are none.
struct Columns {
  std::int32_t left = 0, right = 0;
  [[nodiscard]] constexpr bool is_empty() const { return left >= right; }
  bool operator==(const Columns&) const = default;
};

/// A part of the screen, one run of columns per row, rows from `top` down; nothing outside them. A polygon
/// drawn within limits is the whole polygon (edges, gradients) with all other pixels left out: the pieces of
/// a split polygon are the polygon, pixel for pixel. Coordinates as transmitted, before the drawing offset.
struct Limits {
  std::int32_t top = 0;
  std::span<const Columns> rows;  ///< the caller's
  [[nodiscard]] constexpr Columns at(std::int32_t row) const {
    const std::int64_t index = std::int64_t{row} - top;
    if (index < 0 || index >= static_cast<std::int64_t>(rows.size())) return {};
    return rows[static_cast<std::size_t>(index)];
  }
};

/// `sorted` as sorted_by_row gives it, sorted[0].y <= row < sorted[2].y.
constexpr Columns covered_columns(const Corners& sorted, std::int32_t row) {
  const std::int32_t along = edge_at(sorted[0], sorted[2], row);
  const std::int32_t across =
      row < sorted[1].y ? edge_at(sorted[0], sorted[1], row) : edge_at(sorted[1], sorted[2], row);
  return {std::min(along, across), std::max(along, across)};
}

/// f(row, left, right) for every row with pixels, top to bottom; the pixels are left .. right-1. Neither the
/// drawing area nor wrapping is applied. Draws nothing that the size rule refuses.
template <class F>
constexpr void for_each_covered_row(const Corners& corners, F&& f) {
  if (doubled_area(corners) == 0 || is_too_large(corners)) return;
  const Corners sorted = sorted_by_row(corners);
  for (std::int32_t row = sorted[0].y; row < sorted[2].y; ++row) {
    const Columns columns = covered_columns(sorted, row);
    if (columns.left < columns.right) f(row, columns.left, columns.right);
  }
}

}  // namespace gpu
