#pragma once
// Pieces of split polygons as packets that any console can draw. A piece is its parent's pixels within row
// spans, which no packet can say; here it becomes triangles with whole corners.
//
// They cover exactly the pixels of the piece. What is lost is in the attributes: colour, u, v and depth at
// the new corners are rounded to what a packet holds, and corners that lie up to a pixel outside the parent
// are limited to 0..255. A flat untextured piece loses nothing.

#include <vector>

#include "exact/rows.h"
#include "gpu/columns.h"
#include "scene/submit.h"

namespace scene {

/// Triangles that together cover the pixels of `rows`, each once, by the hardware's rule. Their number grows
/// with the corners of the shape, not with its rows: edges that look straight are one edge.
[[nodiscard]] std::vector<gpu::Corners> triangles_over(const exact::Rows& rows);

/// Appends the triangles of `parent` (three corners) that cover `rows`. Returns how many.
std::uint32_t snap(const Primitive& parent, const exact::Rows& rows, std::vector<Primitive>& out);

}  // namespace scene
