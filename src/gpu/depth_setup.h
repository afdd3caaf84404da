#pragma once
// From three vertices with depth to what the depth stage needs.

#include <array>

#include "gpu/depth.h"
#include "gpu/job.h"
#include "gpu/primitive.h"
#include "gpu/raster.h"

namespace gpu {

/// Fills job.depth for one triangle of a polygon with depth; `core` is the vertex that spans count from.
void put_depth(DepthJob& depth, DepthPlane& plane, const Primitive& primitive,
               const std::array<const Vertex*, 3>& triangle, const Vertex& core, Pass pass);

}  // namespace gpu
