#pragma once
// Random triangles on a small screen, with what makes depth comparison hard: common planes, common edges and
// corners, interpenetration, extreme depths, sub-pixel corners.

#include <array>
#include <vector>

#include "exact/split.h"
#include "tests/random.h"

namespace tests {

enum class Kind : std::uint8_t { anything, whole_pixels, nearly_coplanar, coplanar, sharing, extreme };
inline constexpr std::array all_kinds{Kind::anything, Kind::whole_pixels, Kind::nearly_coplanar,
                                      Kind::coplanar, Kind::sharing,      Kind::extreme};

class RandomTriangles : public Random {
 public:
  using Random::Random;

  /// `count` triangles around a screen of size x size pixels.
  std::vector<exact::Triangle> scene(Kind kind, int count, int size) {
    std::vector<exact::Triangle> triangles;
    triangles.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) triangles.push_back(triangle(kind, size, triangles));
    return triangles;
  }

 private:
  exact::Triangle triangle(Kind kind, int size, const std::vector<exact::Triangle>& others) {
    exact::Triangle t;
    for (auto& corner : t) {
      corner.x = between(-256, 256 * (size + 1));
      corner.y = between(-256, 256 * (size + 1));
      corner.z = static_cast<std::uint32_t>(between(100 * 4096, 200 * 4096));
      if (kind != Kind::anything && kind != Kind::extreme) {
        corner.x &= ~255;
        corner.y &= ~255;
      }
      if (kind == Kind::extreme)
        corner.z = between(0, 1) != 0 ? word() : static_cast<std::uint32_t>(between(0, 2));
      // One plane of 1/z for all: z = 720720 / (1 + x + 2y) is whole on a small screen's corners.
      if (kind == Kind::coplanar || kind == Kind::nearly_coplanar) {
        corner.x = between(0, 3) * 512;
        corner.y = between(0, 3) * 512;
        corner.z = 720720U / static_cast<std::uint32_t>(1 + corner.x / 512 + 2 * (corner.y / 512));
        if (kind == Kind::nearly_coplanar) corner.z += static_cast<std::uint32_t>(between(0, 1));
      }
    }
    if (kind == Kind::sharing && !others.empty()) {
      const auto& other = others[static_cast<std::size_t>(between(0, static_cast<int>(others.size()) - 1))];
      const int shared = between(1, 2);
      for (std::size_t i = 0; i < static_cast<std::size_t>(shared); ++i) t[i] = other[(i + 1) % 3];
    }
    return t;
  }
};

}  // namespace tests
