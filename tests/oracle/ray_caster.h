#pragma once
// The slow plain reference for depth: rays through triangles in space, in rational arithmetic. It shares no
// formula with src/inspect: there 1/z is a plane on the screen, here z comes from the plane equation of three
// points in space.

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <optional>

namespace oracle {

using Rational = boost::multiprecision::cpp_rational;

/// A corner as the screen has it.
struct Corner {
  int x = 0, y = 0;     ///< 1/256 pixel
  std::uint32_t z = 1;  ///< 20.12, not 0
};

/// z (20.12 units) at which the ray through the sample point of pixel x, y meets the triangle; nothing where
/// it misses. The camera is at the origin, the screen at distance 1; a ray on an edge hits when the inside of
/// the triangle is right of it or, for a horizontal edge, below it.
std::optional<Rational> cast_ray(const std::array<Corner, 3>& triangle, int x, int y);

}  // namespace oracle
