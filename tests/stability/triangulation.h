#pragma once
// Random triangulations of a rectangle without T-junctions, as sets of integer triangles: whatever draws them
// must hit every pixel of the rectangle once and no other.

#include <cstdint>
#include <vector>

#include "gpu/columns.h"
#include "tests/random.h"

namespace stability {

using tests::Random;

/// Start with two triangles, then insert points: a triangle that holds the point, also on its border, is
/// replaced by the triangles between the point and its edges. Slivers and needles come by themselves.
inline std::vector<gpu::Corners> triangulate(Random& random, int width, int height, int points) {
  using gpu::Corners;
  using gpu::Point;
  const Point a{0, 0}, b{width, 0}, c{0, height}, d{width, height};
  std::vector<Corners> mesh{{a, b, c}, {b, d, c}};
  for (int i = 0; i < points; ++i) {
    const Point p{random.between(0, width), random.between(0, height)};
    std::vector<Corners> next;
    for (const auto& t : mesh) {
      const auto area = [](Point x, Point y, Point z) { return gpu::doubled_area({x, y, z}); };
      const Corners* triangle = &t;
      const bool positive = gpu::doubled_area(t) > 0;
      bool inside = true;
      for (std::size_t e = 0; e < 3; ++e) {
        const int side = area((*triangle)[e], (*triangle)[(e + 1) % 3], p);
        inside = inside && (positive ? side >= 0 : side <= 0);
      }
      if (!inside) {
        next.push_back(t);
        continue;
      }
      for (std::size_t e = 0; e < 3; ++e) {
        const Corners piece{t[e], t[(e + 1) % 3], p};
        if (gpu::doubled_area(piece) != 0) next.push_back(piece);
      }
    }
    mesh = std::move(next);
  }
  return mesh;
}

/// `count` triangles round one inner vertex of a rectangle, whose border they share.
inline std::vector<gpu::Corners> fan(gpu::Point centre, int width, int height, int count) {
  using gpu::Point;
  const int border = 2 * (width + height);
  const auto at = [&](int along) -> Point {
    along %= border;
    if (along < width) return {along, 0};
    along -= width;
    if (along < height) return {width, along};
    along -= height;
    if (along < width) return {width - along, height};
    return {0, height - (along - width)};
  };
  std::vector<Point> rim;
  for (int i = 0; i < count; ++i) rim.push_back(at(static_cast<int>(std::int64_t{i} * border / count)));
  for (const int corner :
       {0, width, width + height, 2 * width + height}) {  // or the fan cuts the corners off
    auto& nearest = rim[static_cast<std::size_t>((std::int64_t{corner} * count + border - 1) / border)];
    nearest = at(corner);
  }
  std::vector<gpu::Corners> mesh;
  for (std::size_t i = 0; i < rim.size(); ++i) mesh.push_back({centre, rim[i], rim[(i + 1) % rim.size()]});
  return mesh;
}

}  // namespace stability
