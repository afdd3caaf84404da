#include "scene/split_order.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scene/snap.h"

namespace scene {
namespace {

// The GPU draws a quad as triangles 0,1,2 and 1,2,3, each complete in itself: two
// packets draw the same pixels.
Primitive half_of(const Primitive& quad, std::size_t first) {
  Primitive half = quad;
  half.count = 3;
  for (std::size_t k = 0; k < 3; ++k) half.corner[k] = quad.corner[first + k];
  if (!quad.gouraud)
    half.corner[0].colour = quad.corner[0].colour;  // a flat polygon has the colour of its corner 0
  return half;
}

exact::Triangle on_screen(const Primitive& p, std::uint8_t fraction_mask, int scale) {
  exact::Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner& c = p.corner[k];
    t[k] = {(c.sxy.x * 256 + (c.fraction_x & fraction_mask)) * scale,
            (c.sxy.y * 256 + (c.fraction_y & fraction_mask)) * scale, c.z_20_12};
  }
  return t;
}

}  // namespace

void SplitOrder::begin() {
  triangles_.clear();
  lines_.clear();
  ordered_.clear();
  splits_ = 0;
  was_stopped_ = false;
}

void SplitOrder::operator()(const Primitive& p) {
  if (p.count == 2) {
    lines_.push_back(p);
  } else if (p.count == 3) {
    triangles_.push_back(p);
  } else {
    triangles_.push_back(half_of(p, 0));
    triangles_.push_back(half_of(p, 1));
  }
}

base::Result<void> SplitOrder::finish(int width, int height, std::uint8_t fraction_mask, int scale,
                                      const std::function<bool(double)>& keep_going) {
  std::vector<exact::Triangle> triangles;
  triangles.reserve(triangles_.size());
  for (const Primitive& p : triangles_) triangles.push_back(on_screen(p, fraction_mask, scale));
  const exact::SplitLimits limits{.keep_going = keep_going};
  auto order = exact::split_into_order(triangles, {0, 0, width * scale - 1, height * scale - 1}, limits);
  if (order.was_too_much) {
    return base::fail("visibility bsp: its pieces have more than " + std::to_string(limits.most_spans) +
                          " rows in all, the limit of memory; expected fewer polygons that pierce each other",
                      base::Exit::bad_input);
  }
  splits_ = order.splits;
  was_stopped_ = order.was_stopped;
  ordered_.reserve(order.pieces.size() + lines_.size());
  for (exact::Piece& piece : order.pieces) {
    ordered_.push_back({triangles_[piece.triangle], piece.is_whole, std::move(piece.rows)});
  }
  place_lines();
  return {};
}

std::uint32_t SplitOrder::snap_pieces() {
  std::vector<OrderedPrimitive> whole;
  std::vector<Primitive> triangles;
  std::uint32_t pieces = 0;
  for (OrderedPrimitive& o : ordered_) {
    if (o.is_whole) {
      whole.push_back(std::move(o));
      continue;
    }
    ++pieces;
    triangles.clear();
    snap(o.primitive, o.rows, triangles);
    for (const Primitive& triangle : triangles) whole.push_back({triangle, true, {}});
  }
  ordered_ = std::move(whole);
  return pieces;
}

// Behind the last polygon whose key is not nearer; lines at one place from far to near.
void SplitOrder::place_lines() {
  if (lines_.empty()) return;
  std::vector<std::size_t>
      last;  // polygons that are farther than all that follow: rising places, falling keys
  for (std::size_t i = 0; i < ordered_.size(); ++i) {
    while (!last.empty() && ordered_[last.back()].primitive.otz <= ordered_[i].primitive.otz) last.pop_back();
    last.push_back(i);
  }
  struct Placed {
    std::size_t behind;  // that many polygons
    const Primitive* line;
  };
  std::vector<Placed> placed;
  for (const Primitive& line : lines_) {
    const auto nearer = std::partition_point(
        last.begin(), last.end(), [&](std::size_t i) { return ordered_[i].primitive.otz >= line.otz; });
    placed.push_back({nearer == last.begin() ? 0 : *std::prev(nearer) + 1, &line});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return a.behind != b.behind ? a.behind < b.behind : a.line->otz > b.line->otz;
  });
  std::vector<OrderedPrimitive> all;
  all.reserve(ordered_.size() + placed.size());
  std::size_t polygon = 0;
  for (const Placed& p : placed) {
    for (; polygon < p.behind; ++polygon) all.push_back(std::move(ordered_[polygon]));
    all.push_back({*p.line, true, {}});
  }
  for (; polygon < ordered_.size(); ++polygon) all.push_back(std::move(ordered_[polygon]));
  ordered_ = std::move(all);
}

}  // namespace scene
