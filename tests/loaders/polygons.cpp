#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "load/faces.h"

namespace {

using scene::none;

std::vector<load::Piece> split(const std::vector<glm::vec3>& polygon) {
  std::uint64_t work = load::split_work;
  std::vector<load::Piece> pieces;
  load::split_polygon(polygon, work, pieces);
  return pieces;
}

// Signed area seen from +z; pieces of a correctly split polygon are all positive and add up to its own.
double area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return 0.5 * (double{b.x - a.x} * double{c.y - a.y} - double{b.y - a.y} * double{c.x - a.x});
}

TEST_SUITE("loaders") {
  TEST_CASE("a triangle stays one, a flat convex quad stays a quad, fewer corners are nothing") {
    CHECK(split({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == std::vector<load::Piece>{{0, 1, 2, none}});
    CHECK(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == std::vector<load::Piece>{{0, 1, 2, 3}});
    CHECK(split({{0, 0, 0}, {1, 0, 0}}).empty());
    CHECK(split({}).empty());
  }

  TEST_CASE("a bent quad becomes two triangles") {
    CHECK(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}).size() == 2);
  }

  TEST_CASE("a convex polygon becomes a fan round its first corner") {
    std::vector<glm::vec3> hexagon{{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};
    CHECK(split(hexagon) ==
          std::vector<load::Piece>{{0, 1, 2, none}, {0, 2, 3, none}, {0, 3, 4, none}, {0, 4, 5, none}});
  }

  TEST_CASE("concave polygons are covered exactly: every piece faces the front and the areas add up") {
    const std::vector<glm::vec3> arrow{{0, 0, 0}, {4, -3, 0}, {0, 5, 0}, {-4, -3, 0}};
    const std::vector<glm::vec3> comb{{0, 0, 0}, {7, 0, 0}, {7, 3, 0}, {6, 3, 0}, {6, 1, 0}, {4, 1, 0},
                                      {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    for (const auto& polygon : {arrow, comb}) {
      double whole = 0;
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        whole += area(polygon[0], polygon[i], polygon[i + 1]);
      double sum = 0;
      for (const load::Piece& p : split(polygon)) {
        REQUIRE(p[3] == none);
        const double piece = area(polygon[p[0]], polygon[p[1]], polygon[p[2]]);
        CHECK(piece > 0);
        sum += piece;
      }
      CHECK(sum == doctest::Approx(whole));
    }
  }

  TEST_CASE("a polygon that crosses itself or has no area gives corners - 2 pieces and ends") {
    const std::vector<glm::vec3> star{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}};
    CHECK(split(star).size() == 3);
    CHECK(split(std::vector<glm::vec3>(9, {1, 1, 1})).size() == 7);
    CHECK(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size() == 3);
  }

  TEST_CASE("when the work allowed is used up, concave polygons are still split, and at once") {
    std::vector<glm::vec3> saw;
    for (int i = 0; i < 20000; ++i) saw.emplace_back(i, i % 2 == 0 ? 0 : 1, 0);
    saw.emplace_back(20000, 100, 0);
    saw.emplace_back(-1, 100, 0);
    std::uint64_t work = 1000;
    std::vector<load::Piece> pieces;
    load::split_polygon(saw, work, pieces);
    CHECK(pieces.size() == saw.size() - 2);
    CHECK(work < 1000);
  }

  TEST_CASE("a box is a closed surface; without one side, or turned inside out, it is not") {
    scene::Mesh cube;
    for (unsigned i = 0; i < 8; ++i) cube.positions.emplace_back(i & 1U, i >> 1U & 1U, i >> 2U);
    const std::vector<std::array<std::uint32_t, 4>> sides{{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                                          {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
    for (const auto& side : sides) cube.faces.push_back({.vertex = side});
    CHECK(load::faces_of_closed_surfaces(cube) == std::vector<bool>(6, true));

    scene::Mesh open = cube;
    open.faces.pop_back();
    CHECK(load::faces_of_closed_surfaces(open) == std::vector<bool>(5, false));

    scene::Mesh inside_out = cube;
    for (scene::Face& f : inside_out.faces) std::swap(f.vertex[1], f.vertex[3]);
    CHECK(load::faces_of_closed_surfaces(inside_out) == std::vector<bool>(6, false));
  }

  TEST_CASE("surfaces are judged apart, and vertices that lie on one another count as one") {
    scene::Mesh mesh;
    // A tetrahedron of twelve vertices, and one triangle beside it.
    const glm::vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};
    for (const auto& triangle : {std::array{a, c, b}, std::array{a, b, d}, std::array{b, c, d},
                                 std::array{c, a, d}, std::array{a + 9.0F, b + 9.0F, c + 9.0F}}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), triangle.begin(), triangle.end());
      mesh.faces.push_back({.vertex = {first, first + 1, first + 2, none}});
    }
    CHECK(load::faces_of_closed_surfaces(mesh) == std::vector<bool>{true, true, true, true, false});
  }
}

}  // namespace
