#include "scene/clip.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "scene/project.h"

using scene::Clipper;
using scene::ClipPolygon;
using scene::ClipVertex;
using scene::Projection;

namespace {

Projection projection(std::int32_t near_z = 146) {
  Projection p;
  p.near_z = near_z;
  return p;
}

ClipVertex vertex(double x, double y, double z) {
  ClipVertex v;
  v.position = {x, y, z};
  return v;
}

ClipPolygon polygon(std::initializer_list<ClipVertex> vertices) {
  ClipPolygon p;
  for (const auto& v : vertices) p.add(v);
  return p;
}

bool inside(const Projection& p, glm::dvec3 v) {
  // Rounding to whole units moves a point by less than a pixel on the screen for each plane that made it.
  const double x = v.x * p.h / v.z;
  const double y = v.y * p.h / v.z;
  return v.z >= p.near_z && v.z <= 65535 && std::abs(x) <= scene::guard_band.half_width + 3 &&
         std::abs(y) <= scene::guard_band.half_height + 3 && std::abs(v.x) <= 32767 && std::abs(v.y) <= 32767;
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("a triangle inside all planes is left alone") {
    ClipPolygon in = polygon({vertex(0, 0, 300), vertex(50, 0, 300), vertex(0, 50, 400)});
    ClipPolygon out;
    Clipper(projection(), true).clip(in, out);
    REQUIRE(out.count == 3);
    CHECK(out.vertex[1].position == glm::dvec3(50, 0, 300));
  }

  TEST_CASE(
      "the near plane cuts a triangle with one vertex behind it into a quad whose new vertices lie on it") {
    ClipPolygon in = polygon({vertex(0, 0, 46), vertex(100, 0, 246), vertex(-100, 0, 346)});
    ClipPolygon out;
    Clipper(projection(), true).clip(in, out);
    REQUIRE(out.count == 4);
    // Half of the way from 46 to 246, a third of the way from 46 to 346.
    CHECK(out.vertex[0].position == glm::dvec3(50, 0, 146));
    CHECK(out.vertex[3].position == glm::dvec3(-33, 0, 146));
  }

  TEST_CASE("colours and texture coordinates are cut where the edge is") {
    ClipVertex behind = vertex(0, 0, 46);
    ClipVertex front = vertex(100, 0, 246);
    behind.colour = {0, 200, 100};
    front.colour = {100, 100, 100};
    front.uv = {200, 10};
    ClipPolygon in = polygon({behind, front, vertex(0, 90, 300)});
    ClipPolygon out;
    Clipper(projection(), true).clip(in, out);
    CHECK(out.vertex[0].colour == std::array<float, 3>{50, 150, 100});
    CHECK(out.vertex[0].uv == std::array<float, 2>{100, 5});
  }

  TEST_CASE("a triangle behind the near plane leaves nothing, and is known to be wholly behind it") {
    ClipPolygon in = polygon({vertex(0, 0, 46), vertex(100, 0, -246), vertex(-100, 0, 145)});
    const Clipper clipper(projection(), true);
    CHECK(clipper.wholly_beyond(in.corners()) == scene::Beyond::near_plane);
    ClipPolygon out;
    clipper.clip(in, out);
    CHECK(out.count == 0);
  }

  TEST_CASE("a triangle beyond one side of the picture is known, also if a vertex is behind the camera") {
    const Clipper clipper(projection(), true);
    CHECK(clipper.wholly_beyond(
              polygon({vertex(4000, 0, 500), vertex(5000, 0, -500), vertex(4000, 90, 300)}).corners()) ==
          scene::Beyond::picture);
    CHECK(clipper.wholly_beyond(
              polygon({vertex(-4000, 0, 500), vertex(5000, 0, 500), vertex(0, 90, 300)}).corners()) ==
          scene::Beyond::nothing);
    CHECK(clipper.wholly_beyond(
              polygon({vertex(0, 0, 65536), vertex(9, 0, 70000), vertex(9, 9, 99999)}).corners()) ==
          scene::Beyond::far_plane);
  }

  TEST_CASE("what is left of any triangle is inside all planes and has at most 13 corners") {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> xy(-90000, 90000);
    std::uniform_int_distribution<int> z(-3000, 70000);
    const Projection p = projection();
    const Clipper clipper(p, true);
    int left = 0;
    for (int i = 0; i < 20000; ++i) {
      const int scale = i % 3 == 0 ? 1 : i % 3 == 1 ? 20 : 300;
      const auto random_vertex = [&] {
        return vertex(xy(random) / scale, xy(random) / scale, z(random) / scale);
      };
      ClipPolygon in = polygon({random_vertex(), random_vertex(), random_vertex()});
      ClipPolygon out;
      clipper.clip(in, out);
      REQUIRE(out.count <= 13);
      for (std::size_t k = 0; k < out.count; ++k) REQUIRE(inside(p, out.vertex[k].position));
      left += out.count > 0 ? 1 : 0;
    }
    CHECK(left > 2000);
  }

  TEST_CASE("neighbours insert the same vertex on their common edge, whichever way round they name it") {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> xy(-4000, 4000);
    std::uniform_int_distribution<int> z(-1000, 3000);
    const Clipper clipper(projection(), true);
    int cuts = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto random_vertex = [&] { return vertex(xy(random), xy(random), z(random)); };
      const ClipVertex a = random_vertex();
      const ClipVertex b = random_vertex();
      ClipPolygon one = polygon({a, b, random_vertex()});
      ClipPolygon other = polygon({b, a, random_vertex()});
      ClipPolygon left;
      ClipPolygon right;
      clipper.clip(one, left);
      clipper.clip(other, right);
      // A line is an edge without a face: what it leaves of a-b, both faces must have.
      ClipPolygon edge = polygon({a, b});
      ClipPolygon kept;
      clipper.clip(edge, kept);
      const auto has = [](const ClipPolygon& p, glm::dvec3 v) {
        for (std::size_t k = 0; k < p.count; ++k)
          if (p.vertex[k].position == v) return true;
        return false;
      };
      for (std::size_t k = 0; k < kept.count; ++k) {
        REQUIRE(has(left, kept.vertex[k].position));
        REQUIRE(has(right, kept.vertex[k].position));
        cuts += kept.vertex[k].position != a.position && kept.vertex[k].position != b.position ? 1 : 0;
      }
    }
    CHECK(cuts > 5000);
  }

  TEST_CASE("a vertex that could be projected is never cut off, however near a plane it lies") {
    ClipVertex near = vertex(0, 0, 145.9);
    near.is_projectable = true;
    ClipPolygon in = polygon({near, vertex(50, 0, 300), vertex(0, 50, 50)});
    ClipPolygon out;
    Clipper(projection(), false).clip(in, out);
    CHECK(out.vertex[0].position == near.position);
  }

  TEST_CASE("a vertex that the near plane cuts lies on it to the last bit, whatever the edge's slope") {
    // Else the next stage would find it a rounding nearer or farther than its neighbour's.
    std::mt19937 random(7);
    const auto real = [&](double low, double high) {
      return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    Projection p = projection();
    p.near_z = 146;
    const Clipper clipper(p, false);
    for (int i = 0; i < 2000; ++i) {
      ClipPolygon in = polygon({vertex(real(-40, 40), real(-40, 40), real(20, 140)),
                                vertex(real(-40, 40), real(-40, 40), real(150, 900)),
                                vertex(real(-40, 40), real(-40, 40), real(150, 900))});
      ClipPolygon out;
      clipper.clip(in, out);
      REQUIRE(out.count == 4);
      int on_plane = 0;
      for (std::size_t v = 0; v < out.count; ++v) on_plane += out.vertex[v].position.z == 146;
      CHECK(on_plane == 2);
    }
  }

  TEST_CASE("clipping for the accurate transforms does not round") {
    ClipPolygon in = polygon({vertex(0, 0, 46), vertex(100, 0, 346), vertex(-100, 0, 346)});
    ClipPolygon out;
    Clipper(projection(), false).clip(in, out);
    CHECK(out.vertex[0].position.x == doctest::Approx(100.0 / 3).epsilon(1e-12));
  }
}
