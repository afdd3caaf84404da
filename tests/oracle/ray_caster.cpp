#include "ray_caster.h"

namespace oracle {
namespace {

struct Point {
  Rational x, y, z;
};

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Rational dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// The point of space that projects to the corner.
Point in_space(const Corner& corner) {
  const Rational z(corner.z);
  return {Rational(corner.x, 256) * z, Rational(corner.y, 256) * z, z};
}

// Is the sample on the inner side of edge a-b, or on it and the edge a left or top
// one? c is the third corner.
bool is_inside(const Corner& a, const Corner& b, const Corner& c, long px, long py) {
  const auto side = [&](long x, long y) {
    return (long{b.x} - a.x) * (y - a.y) - (long{b.y} - a.y) * (x - a.x);
  };
  const long inner = side(c.x, c.y), sample = side(px, py);
  if (sample != 0) return (sample > 0) == (inner > 0);
  // On the edge. Step a little to the right, or down along a horizontal edge: inside
  // means the edge is inclusive.
  const long nudged = a.y == b.y ? side(px, py + 1) : side(px + 1, py);
  return (nudged > 0) == (inner > 0);
}

}  // namespace

std::optional<Rational> cast_ray(const std::array<Corner, 3>& t, int x, int y) {
  const long area = (long{t[1].x} - t[0].x) * (t[2].y - t[0].y) - (long{t[2].x} - t[0].x) * (t[1].y - t[0].y);
  if (area == 0) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_inside(t[i], t[(i + 1) % 3], t[(i + 2) % 3], 256L * x, 256L * y)) return std::nullopt;
  }
  const Point a = in_space(t[0]), b = in_space(t[1]), c = in_space(t[2]);
  const Point normal = cross(b - a, c - a);
  const Point ray{x, y, 1};
  return dot(normal, a) / dot(normal, ray);
}

}  // namespace oracle
