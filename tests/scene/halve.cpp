// Pieces chosen by what is on the screen: their bounds, and that nothing is lost or gained by cutting.

#include "scene/halve.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace {

using glm::dvec2, glm::dvec3;
using scene::ClipVertex;
using scene::Subdivide;
using scene::SubdivideBy;

using Three = std::array<ClipVertex, 3>;

scene::Projection projection() {
  scene::Projection p;
  p.width = 320;
  p.height = 240;
  p.h = 200;
  p.near_z = 101;
  return p;
}

dvec2 on_screen(dvec3 p) { return dvec2(p.x, p.y) * (projection().h / p.z); }

/// All pieces of a triangle; none of those in these tests leave the picture.
std::vector<Three> pieces_of(const Three& t, Subdivide by, bool whole = false) {
  const auto p = projection();
  const scene::Clipper clipper(p, whole);
  const scene::Halver halver(by, p, clipper);
  std::vector<Three> pieces;
  halver.triangle(t[0], t[1], t[2], [&](const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    pieces.push_back({a, b, c});
  });
  return pieces;
}

ClipVertex at(double x, double y, double z) {
  ClipVertex v;
  v.position = {x, y, z};
  return v;
}

/// A corner within the middle 200 pixels of the picture, at z from 150 to 30,000.
ClipVertex random_corner(std::mt19937& random) {
  const double z = 150 + static_cast<double>(random() % 29'851);
  const auto place = [&] { return (static_cast<double>(random() % 201) - 100) * z / 200; };
  const double x = place(), y = place();
  return at(x, y, z);
}

dvec3 normal(const Three& t) {
  return glm::cross(t[1].position - t[0].position, t[2].position - t[0].position);
}

template <class Check>
void for_each_edge(const std::vector<Three>& pieces, Check check) {
  for (const auto& t : pieces) {
    for (std::size_t k = 0; k < 3; ++k) check(t[k].position, t[(k + 1) % 3].position);
  }
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("halved by size, no edge of a piece is longer on the screen than asked for") {
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
      const Three t{random_corner(random), random_corner(random), random_corner(random)};
      double longest = 0;
      for_each_edge(pieces_of(t, {SubdivideBy::size, 16}), [&](dvec3 a, dvec3 b) {
        longest = std::max(longest, glm::distance(on_screen(a), on_screen(b)));
      });
      CHECK(longest <= 16);
    }
  }

  TEST_CASE("halved by error, affine interpolation moves no edge's middle by more than was asked for") {
    std::mt19937 random(2);
    for (int i = 0; i < 50; ++i) {
      const Three t{random_corner(random), random_corner(random), random_corner(random)};
      double worst = 0;
      for_each_edge(pieces_of(t, {SubdivideBy::error, 2}), [&](dvec3 a, dvec3 b) {
        // Affine interpolation shows the texel of the middle half way between the ends on the screen.
        const auto shown = (on_screen(a) + on_screen(b)) * 0.5;
        worst = std::max(worst, glm::distance(shown, on_screen((a + b) * 0.5)));
      });
      CHECK(worst <= 2 + 1e-9);
    }
  }

  TEST_CASE("a face that looks straight at the eye has no affine error and stays whole") {
    const Three t{at(-80, -80, 200), at(80, -80, 200), at(-80, 80, 200)};
    CHECK(pieces_of(t, {SubdivideBy::error, 1}).size() == 1);
  }

  TEST_CASE("a right angle with legs of 128 pixels falls into 8 pieces of at most 64") {
    // h / z = 1: units are pixels. All edges (128, 128, 181) are halved: 4 triangles with edges of 64, 64
    // and 90. Of those the 90 is halved once more, and the new edges are 45 long: two pieces of each.
    const Three t{at(-64, -64, 200), at(64, -64, 200), at(-64, 64, 200)};
    CHECK(pieces_of(t, {SubdivideBy::size, 64}).size() == 8);
  }

  TEST_CASE("pieces turn the same way as the whole and have its area together") {
    std::mt19937 random(3);
    for (int i = 0; i < 50; ++i) {
      const Three t{random_corner(random), random_corner(random), random_corner(random)};
      const auto whole = normal(t);
      double sum = 0;
      bool turned = false;
      for (const auto& piece : pieces_of(t, {SubdivideBy::size, 20})) {
        turned = turned || glm::dot(normal(piece), whole) < 0;
        sum += glm::length(normal(piece));
      }
      CHECK_FALSE(turned);
      CHECK(sum == doctest::Approx(glm::length(whole)).epsilon(1e-9));
    }
  }

  TEST_CASE("an edge is halved alike from both ends and for every face that lies at it") {
    std::mt19937 random(4);
    const auto p = projection();
    for (const bool whole : {false, true}) {
      const scene::Clipper clipper(p, whole);
      const scene::Halver halver({SubdivideBy::size, 4}, p, clipper);
      for (int i = 0; i < 200; ++i) {
        const auto a = random_corner(random), b = random_corner(random);
        CHECK(halver.halves(a.position, b.position) == halver.halves(b.position, a.position));
        CHECK(clipper.middle(a, b).position == clipper.middle(b, a).position);
      }
    }
  }

  TEST_CASE("the middle carries the means of colours and texture coordinates") {
    ClipVertex a = at(0, 0, 200), b = at(10, 0, 200);
    a.colour = {0, 100, 255};
    b.colour = {200, 100, 0};
    a.uv = {0, 255};
    b.uv = {64, 1};
    const auto p = projection();
    const auto middle = scene::Clipper(p, true).middle(a, b);
    CHECK(middle.colour == std::array<float, 3>{100, 100, 127.5F});
    CHECK(middle.uv == std::array<float, 2>{32, 128});
    CHECK_FALSE(middle.is_projectable);
  }
}
