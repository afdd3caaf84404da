#pragma once
// Visibility `bsp`: triangles are split until a right painter's order exists.
//
// The order is exact and unique: at every pixel the pieces come in the order (farther first, then lower
// index), so equal depths show the later triangle and nothing depends on how the order was found. First the
// graph of "must be drawn before" over the pixels triangles share; where it has no cycle nothing is split.
// Inside a cycle one triangle's plane of 1/z divides the others, as in a BSP tree [Fuchs, Kedem, Naylor
// 1980]: behind it, itself, in front of it.
//
// A piece is its triangle's pixels on one side of planes: a set of row spans. Drawn, it uses the whole
// triangle's set-up (edges, gradients) limited to these spans, so the pieces of a triangle are the triangle,
// pixel for pixel.
//
// Not modelled: samples other than pixel centres of the raster handed in.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "exact/depth_order.h"
#include "exact/rows.h"

namespace exact {

using Triangle = std::array<Corner, 3>;

struct Piece {
  std::uint32_t triangle = 0;  ///< index into what was handed in
  bool is_whole = true;        ///< nothing was cut off: it can be drawn without limits
  Rows rows;                   ///< the pixels it draws
};

struct SplitOrder {
  std::vector<Piece> pieces;  ///< farthest first; triangles without pixels have none
  std::uint32_t splits = 0;   ///< cuts made: pieces less triangles with pixels
  std::uint32_t cycles = 0;   ///< components of more than one piece met on the way
  DecisionCounts decisions;
  /// Of two kinds of haste, both only when asked for: the rest is in the order of one depth a piece.
  bool was_stopped = false;   ///< keep_going said so
  bool was_too_much = false;  ///< most_spans was passed
};

/// How long a split may take. Triangles that all pierce each other have as many pieces as pixels times
/// layers.
struct SplitLimits {
  std::function<bool(double done)> keep_going{};  ///< asked often; done: 0..1 of the pieces known so far
  std::size_t most_spans = 6'000'000;             ///< of all pieces together
};

/// Orders the pixels of `triangles` inside `area`, splitting where it must. Corners within corner_limit;
/// triangles that break the hardware's size rule are the caller's to leave out.
SplitOrder split_into_order(std::span<const Triangle> triangles, const Area& area,
                            const SplitLimits& limits = {});

}  // namespace exact
