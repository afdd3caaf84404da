#include "scene/snap.h"

#include <algorithm>
#include <cmath>

namespace scene {
namespace {

using gpu::Point;

// A quotient; run > 0.
struct Slope {
  std::int64_t rise, run;
  [[nodiscard]] bool is_below(const Slope& other) const { return rise * other.run < other.rise * run; }
};

// The farthest point from xs[from] that one edge can reach. xs[k] is the first whole pixel at or right of the
// edge in row k: a slope s fits if xs[k] - 1 < xs[from] + s * (k - from) <= xs[k], and those that fit all
// rows on the way lie between low (excluded) and high (included).
std::size_t farthest_reach(std::span<const std::int32_t> xs, std::size_t from) {
  std::size_t best = from + 1;
  Slope low{xs[best] - xs[from] - 1, 1}, high{xs[best] - xs[from], 1};
  for (std::size_t k = from + 2; k < xs.size() && low.is_below(high); ++k) {
    const auto run = static_cast<std::int64_t>(k - from);
    const Slope here{xs[k] - xs[from], run}, least{here.rise - 1, run};
    if (low.is_below(here) && !high.is_below(here)) best = k;
    if (low.is_below(least)) low = least;
    if (here.is_below(high)) high = here;
  }
  return best;
}

// Whole points, from row `top` to the row after the last, whose edges have exactly the first pixels `xs`.
std::vector<Point> side(std::vector<std::int32_t> xs, std::int32_t top) {
  xs.push_back(xs.back());  // the lower end, in a row that no longer counts
  std::vector<Point> corners;
  for (std::size_t k = 0;; k = farthest_reach(xs, k)) {
    corners.push_back({xs[k], top + static_cast<std::int32_t>(k)});
    if (k + 1 == xs.size()) return corners;
  }
}

// Above 0 if a, b, c turn clockwise on the screen.
std::int64_t turn(Point a, Point b, Point c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

bool is_inside(Point p, const gpu::Corners& t) {
  return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
}

// Corner k of the clockwise outline, if nothing else of the outline reaches into it.
bool is_ear(const std::vector<Point>& outline, const gpu::Corners& t) {
  return turn(t[0], t[1], t[2]) > 0 && std::none_of(outline.begin(), outline.end(), [&](Point p) {
           return p != t[0] && p != t[1] && p != t[2] && is_inside(p, t);
         });
}

// Cuts off one ear after the other [Meisters 1975: there are always two]; corners without area just go.
void cut_ears(std::vector<Point> outline, std::vector<gpu::Corners>& out) {
  for (std::size_t k = 0, unsuccessful = 0; outline.size() > 2 && unsuccessful < outline.size();) {
    const std::size_t n = outline.size();
    k %= n;
    const gpu::Corners t{outline[(k + n - 1) % n], outline[k], outline[(k + 1) % n]};
    const bool has_area = turn(t[0], t[1], t[2]) != 0;
    if (has_area && !is_ear(outline, t)) {
      ++k;
      ++unsuccessful;
      continue;
    }
    if (has_area) out.push_back(t);
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(k));
    unsuccessful = 0;
  }
}

// Rows that all have pixels: in each the sides are a pixel apart or more, so they never cross.
void add_shape(std::span<const gpu::Columns> rows, std::int32_t top, std::vector<gpu::Corners>& out) {
  std::vector<std::int32_t> left, right;
  for (const gpu::Columns& row : rows) {
    left.push_back(row.left);
    right.push_back(row.right);
  }
  auto outline = side(std::move(right), top);  // down the right side and up the left one
  const auto up = side(std::move(left), top);
  outline.insert(outline.end(), up.rbegin(), up.rend());
  cut_ears(std::move(outline), out);
}

// The parent's attributes at a whole point, each affine on the screen (z: its inverse).
class Attributes {
 public:
  explicit Attributes(const Primitive& parent) : corners_(parent.corner) {
    for (std::size_t k = 0; k < 3; ++k) at_[k] = {corners_[k].sxy.x, corners_[k].sxy.y};
  }

  [[nodiscard]] Corner at(Point p) const {
    const auto area = static_cast<double>(turn(at_[0], at_[1], at_[2]));
    const std::array weight{static_cast<double>(turn(p, at_[1], at_[2])) / area,
                            static_cast<double>(turn(at_[0], p, at_[2])) / area,
                            static_cast<double>(turn(at_[0], at_[1], p)) / area};
    const auto mixed = [&](auto&& of) {
      return weight[0] * of(corners_[0]) + weight[1] * of(corners_[1]) + weight[2] * of(corners_[2]);
    };
    const auto byte = [&](auto&& of) {
      return static_cast<std::uint8_t>(std::clamp(std::floor(mixed(of) + 0.5), 0.0, 255.0));
    };
    Corner c = corners_[0];
    c.sxy = {static_cast<std::int16_t>(p.x), static_cast<std::int16_t>(p.y)};
    c.fraction_x = c.fraction_y = 0;
    c.colour.r = byte([](const Corner& from) { return from.colour.r; });
    c.colour.g = byte([](const Corner& from) { return from.colour.g; });
    c.colour.b = byte([](const Corner& from) { return from.colour.b; });
    c.uv = {byte([](const Corner& from) { return from.uv.u; }),
            byte([](const Corner& from) { return from.uv.v; })};
    const double nearness = mixed([](const Corner& from) { return 1.0 / std::max(from.z_20_12, 1U); });
    constexpr double farthest = 4294967295.0;
    c.z_20_12 =
        nearness * farthest > 1 ? static_cast<std::uint32_t>(std::floor(1 / nearness + 0.5)) : 0xffffffffU;
    return c;
  }

 private:
  std::array<Corner, 4> corners_;
  std::array<Point, 3> at_;
};

}  // namespace

std::vector<gpu::Corners> triangles_over(const exact::Rows& rows) {
  std::vector<gpu::Corners> out;
  const auto& spans = rows.spans;
  for (std::size_t i = 0; i < spans.size();) {
    std::size_t end = i;
    while (end < spans.size() && !spans[end].is_empty()) ++end;
    if (end > i)
      add_shape(std::span(spans).subspan(i, end - i), rows.top + static_cast<std::int32_t>(i), out);
    i = end + 1;
  }
  return out;
}

std::uint32_t snap(const Primitive& parent, const exact::Rows& rows, std::vector<Primitive>& out) {
  const Attributes attributes(parent);
  const auto triangles = triangles_over(rows);
  for (const gpu::Corners& t : triangles) {
    Primitive p = parent;
    for (std::size_t k = 0; k < 3; ++k) p.corner[k] = attributes.at(t[k]);
    if (!p.gouraud) p.corner[0].colour = parent.corner[0].colour;
    out.push_back(p);
  }
  return static_cast<std::uint32_t>(triangles.size());
}

}  // namespace scene
