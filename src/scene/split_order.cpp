#include "scene/split_order.h"

#include <algorithm>
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

void SplitOrder::finish(int width, int height, std::uint8_t fraction_mask, int scale) {
  std::vector<exact::Triangle> triangles;
  triangles.reserve(triangles_.size());
  for (const Primitive& p : triangles_) triangles.push_back(on_screen(p, fraction_mask, scale));
  auto order = exact::split_into_order(triangles, {0, 0, width * scale - 1, height * scale - 1});
  splits_ = order.splits;
  ordered_.reserve(order.pieces.size() + lines_.size());
  for (exact::Piece& piece : order.pieces) {
    ordered_.push_back({triangles_[piece.triangle], piece.is_whole, std::move(piece.rows)});
  }
  place_lines();
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

void SplitOrder::place_lines() {
  for (const Primitive& line : lines_) {
    const auto last = std::find_if(ordered_.rbegin(), ordered_.rend(),
                                   [&](const OrderedPrimitive& o) { return o.primitive.otz >= line.otz; });
    ordered_.insert(last.base(), {line, true, {}});
  }
}

}  // namespace scene
