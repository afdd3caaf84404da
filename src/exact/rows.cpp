#include "exact/rows.h"

#include <cassert>

namespace exact {
namespace {

// The quotient rounded up; divisor > 0.
std::int64_t ceil_div(std::int64_t dividend, std::int64_t divisor) {
  return dividend / divisor + (dividend % divisor > 0 ? 1 : 0);
}

// The first pixel at or right of edge from-to on pixel row y; from.y < to.y.
std::int64_t first_pixel(const Corner& from, const Corner& to, int y) {
  const std::int64_t height = to.y - from.y;
  const std::int64_t down = std::int64_t{y} * 256 - from.y;
  // x = from.x + (to.x - from.x) * down / height, in 1/256 pixel; one division keeps it exact.
  return ceil_div(from.x * height + std::int64_t{to.x - from.x} * down, 256 * height);
}

}  // namespace

std::uint64_t Rows::pixels() const {
  std::uint64_t count = 0;
  for (const Columns& span : spans) count += static_cast<std::uint64_t>(std::max(0, span.right - span.left));
  return count;
}

void trim(Rows& rows) {
  while (!rows.spans.empty() && rows.spans.back().is_empty()) rows.spans.pop_back();
  const auto first =
      std::find_if(rows.spans.begin(), rows.spans.end(), [](Columns s) { return !s.is_empty(); });
  rows.top += static_cast<int>(first - rows.spans.begin());
  rows.spans.erase(rows.spans.begin(), first);
}

Rows covered_rows(std::array<Corner, 3> corners, const Area& area) {
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.y < b.y; });
  const auto& [upper, middle, lower] = corners;
  const int first = std::max(static_cast<int>(ceil_div(upper.y, 256)), area.top);
  const int end = std::min(static_cast<int>(ceil_div(lower.y, 256)), area.bottom + 1);
  Rows rows{first, {}};
  for (int y = first; y < end; ++y) {
    const std::int64_t along = first_pixel(upper, lower, y);
    const std::int64_t across =
        y * 256 < middle.y ? first_pixel(upper, middle, y) : first_pixel(middle, lower, y);
    const auto left = std::max<std::int64_t>(std::min(along, across), area.left);
    const auto right = std::min<std::int64_t>(std::max(along, across), area.right + 1);
    rows.spans.push_back(left < right
                             ? Columns{static_cast<std::int32_t>(left), static_cast<std::int32_t>(right)}
                             : Columns{});
  }
  trim(rows);
  return rows;
}

}  // namespace exact
