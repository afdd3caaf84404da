#pragma once
// Which samples lie inside a triangle whose corners stand on a 1/256 grid: the edge rule of the console (left
// and top edges in, right and bottom edges out) carried over to finer positions and to any
// sample point. Exact: every division is an integer one and keeps its remainder, so two triangles that share
// an edge never both own a sample and never leave one out, whatever the resolution or the sample pattern.
//
// Ranges. A canvas unit is 1/256 of a canvas pixel. Corners are within +-2^24 units (+-2048 console pixels at
// eight times the resolution need 2^22), heights below 2^25; the largest product is 2^51.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <utility>

namespace gpu::canvas {

inline constexpr int unit_bits = 8;  ///< a canvas pixel is 2^8 units wide
inline constexpr std::int64_t units_per_pixel = std::int64_t{1} << unit_bits;

/// A point in canvas units.
struct Point {
  std::int64_t x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// Half-open range of pixels or rows; empty when end <= begin.
struct Range {
  int begin = 0, end = 0;
  [[nodiscard]] bool is_empty() const { return end <= begin; }
  bool operator==(const Range&) const = default;
};

inline Range intersect(Range a, Range b) { return {std::max(a.begin, b.begin), std::min(a.end, b.end)}; }
inline Range unite(Range a, Range b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

/// True floor and ceiling of a / b for b > 0; `/` truncates towards zero.
constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
constexpr std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return a / b + (a % b > 0 ? 1 : 0); }

/// Twice the signed area: positive when a, b, c turn clockwise on a screen whose y points down.
constexpr std::int64_t doubled_area(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - b.y) - (c.x - b.x) * (b.y - a.y);
}

/// First pixel at or to the right of one edge, row by row: ceil of the exact
/// crossing, stepped with its remainder.
class EdgeCrossing {
 public:
  EdgeCrossing() = default;
  /// `upper.y < lower.y`. The row's sample line is y = row * 256 + sample.y, the pixel's
  /// sample x = i * 256 + sample.x.
  EdgeCrossing(Point upper, Point lower, Point sample, int row) {
    const auto height = lower.y - upper.y;
    assert(height > 0);
    const auto run = lower.x - upper.x;
    divisor_ = height * units_per_pixel;
    const auto crossing =
        height * (upper.x - sample.x) + run * (row * units_per_pixel + sample.y - upper.y) + divisor_ - 1;
    pixel_ = floor_div(crossing, divisor_);
    remainder_ = crossing - pixel_ * divisor_;
    const auto step = run * units_per_pixel;
    pixel_step_ = floor_div(step, divisor_);
    remainder_step_ = step - pixel_step_ * divisor_;
  }

  [[nodiscard]] int pixel() const { return static_cast<int>(pixel_); }
  void step() {
    pixel_ += pixel_step_;
    remainder_ += remainder_step_;
    if (remainder_ >= divisor_) {
      remainder_ -= divisor_;
      ++pixel_;
    }
  }

 private:
  std::int64_t pixel_ = 0, remainder_ = 0, divisor_ = 1, pixel_step_ = 0, remainder_step_ = 0;
};

/// The covered pixels of one triangle for one sample point, row after row from `rows().begin`.
class Coverage {
 public:
  Coverage() = default;
  /// Corners in any order; `clip_rows` limits the rows walked and changes no crossing.
  Coverage(std::array<Point, 3> corners, Point sample, Range clip_rows) : sample_(sample) {
    auto& [top, middle, bottom] = corners;
    if (middle.y < top.y) std::swap(middle, top);
    if (bottom.y < middle.y) std::swap(bottom, middle);
    if (middle.y < top.y) std::swap(middle, top);
    if (doubled_area(top, middle, bottom) == 0) return;
    rows_ = intersect({first_row(top.y), first_row(bottom.y)}, clip_rows);
    if (rows_.is_empty()) {
      rows_ = {};
      return;
    }
    middle_ = middle;
    bottom_ = bottom;
    turn_ = first_row(middle.y);
    row_ = rows_.begin;
    long_edge_ = {top, bottom, sample, row_};
    short_edge_ =
        row_ < turn_ ? EdgeCrossing(top, middle, sample, row_) : EdgeCrossing(middle, bottom, sample, row_);
  }

  [[nodiscard]] Range rows() const { return rows_; }

  /// Pixels of the next row; call once per row of rows(), in order.
  Range next() {
    const auto [begin, end] = std::minmax({long_edge_.pixel(), short_edge_.pixel()});
    const Range covered{begin, end};
    if (++row_ < rows_.end) {
      long_edge_.step();
      if (row_ == turn_) {
        short_edge_ = {middle_, bottom_, sample_, row_};
      } else {
        short_edge_.step();
      }
    }
    return covered;
  }

 private:
  /// The first row whose sample line is at or below y.
  [[nodiscard]] int first_row(std::int64_t y) const {
    return static_cast<int>(ceil_div(y - sample_.y, units_per_pixel));
  }

  Point sample_{}, middle_{}, bottom_{};
  Range rows_{};
  int turn_ = 0, row_ = 0;
  EdgeCrossing long_edge_, short_edge_;
};

/// The same rule for single points: what Coverage says of a row, point by point.
class Inside {
 public:
  explicit Inside(std::array<Point, 3> corners) : corners_(corners) {
    std::ranges::sort(corners_, {}, &Point::y);
    if (doubled_area(corners_[0], corners_[1], corners_[2]) == 0) corners_[2].y = corners_[0].y;
  }

  /// Rows of pixels any point of which, up to half a pixel from the sample line, may be inside.
  [[nodiscard]] Range rows() const {
    constexpr std::int64_t half = units_per_pixel / 2;
    return {static_cast<int>(ceil_div(corners_[0].y - half + 1, units_per_pixel)),
            static_cast<int>(ceil_div(corners_[2].y + half, units_per_pixel))};
  }

  [[nodiscard]] bool contains(Point p) const {
    const auto& [top, middle, bottom] = corners_;
    if (p.y < top.y || p.y >= bottom.y) return false;
    const bool is_right_of_short =
        p.y < middle.y ? is_right_of(p, top, middle) : is_right_of(p, middle, bottom);
    return is_right_of(p, top, bottom) != is_right_of_short;
  }

 private:
  /// On the edge or to the right of it; `upper.y < lower.y`.
  static bool is_right_of(Point p, Point upper, Point lower) {
    return (p.x - upper.x) * (lower.y - upper.y) >= (lower.x - upper.x) * (p.y - upper.y);
  }

  std::array<Point, 3> corners_;
};

}  // namespace gpu::canvas
