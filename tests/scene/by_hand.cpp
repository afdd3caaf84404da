// Thresholds of the scene, each met exactly and passed by a little.

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "scene/halve.h"
#include "scene/lists.h"
#include "scene/split_order.h"
#include "scene/texture.h"

namespace {

scene::Projection projection() {
  scene::Projection p;
  p.width = 320;
  p.height = 240;
  p.h = 256;
  p.near_z = 129;
  return p;
}

scene::Primitive flat_triangle(const scene::PacketMaterial& material, std::uint32_t otz) {
  scene::Primitive p;
  p.count = 3;
  p.material = &material;
  p.otz = otz;
  return p;
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE(
      "error-N halves an edge whose middle is more than N pixels off: L |za - zb| / (2 (za + zb)) of it") {
    // From (0, 0, 512) to (x, 0, 1536): |dz| / (2 sum) = 1/4, and x / 1536 * 256 pixels long.
    const scene::Clipper clipper(projection(), false);
    for (const int n : {1, 4}) {
      const scene::Halver halver({scene::SubdivideBy::error, n}, projection(), clipper);
      const auto halves = [&](double error) {
        return halver.halves({0, 0, 512}, {error * 4 * 1536 / 256, 0, 1536});
      };
      CHECK_FALSE(halves(n));
      CHECK_FALSE(halves(n * 0.99));
      CHECK(halves(n * 1.01));
    }
  }

  TEST_CASE("size-N halves an edge of more than N pixels, and none of exactly N") {
    const scene::Clipper clipper(projection(), false);
    const scene::Halver halver({scene::SubdivideBy::size, 8}, projection(), clipper);
    CHECK_FALSE(halver.halves({0, 0, 512}, {16, 0, 512}));
    CHECK(halver.halves({0, 0, 512}, {16.01, 0, 512}));
    CHECK_FALSE(halver.halves({0, 0, 512}, {0, 0, 5000}));
  }

  TEST_CASE(
      "A bucket that just fits is a list of its own; one byte less is an error that names both numbers") {
    const scene::PacketMaterial material{};
    scene::BucketSizes sizes({.length = 4}, {});
    const auto triangle = flat_triangle(material, 0);
    std::array<std::uint32_t, 16> words{};
    const auto bytes =
        static_cast<std::uint32_t>(4 * (1 + scene::encode(triangle, {}, words)));  // and its tag
    for (int n = 0; n < 3; ++n) sizes.add(triangle, 3);
    sizes.add(triangle, 2);
    sizes.add(triangle, 2);
    sizes.add(triangle, 0);
    const auto ranges = sizes.ranges(3 * bytes);
    REQUIRE(ranges);
    REQUIRE(ranges->size() == 2);  // bucket 3 fills a list; 2, 1 and 0 fill the next
    CHECK((*ranges)[0].first == 3);
    CHECK((*ranges)[0].last == 3);
    CHECK((*ranges)[1].first == 0);
    CHECK((*ranges)[1].last == 2);
    const auto refused = sizes.ranges(3 * bytes - 1);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().text.find(std::to_string(3 * bytes) + " bytes") != std::string::npos);
    REQUIRE(sizes.ranges(6 * bytes));
    CHECK(sizes.ranges(6 * bytes)->size() == 1);
  }

  TEST_CASE("A polygon may span as many whole periods of a texture as 8-bit coordinates can count") {
    const auto periods = [](int texels, bool windowed) {
      scene::TexelAxis axis;
      axis.texels = texels;
      axis.windowed = windowed;
      return axis.periods();
    };
    CHECK(periods(1, true) == 255);
    CHECK(periods(16, true) == 15);
    CHECK(periods(64, true) == 3);
    CHECK(periods(127, true) == 2);
    CHECK(periods(128, true) == 1);
    CHECK(periods(16, false) == 1);
  }

  TEST_CASE("Lines stand behind the last polygon that is not nearer, those at one place from far to near") {
    const scene::PacketMaterial material{};
    scene::SplitOrder order;
    order.begin();
    const auto polygon = [&](std::uint32_t otz, std::uint32_t z, int x) {
      scene::Primitive p = flat_triangle(material, otz);
      const std::array<std::array<int, 2>, 3> at{{{x, 0}, {x + 8, 0}, {x, 8}}};
      for (std::size_t k = 0; k < 3; ++k) {
        p.corner[k].sxy = {static_cast<std::int16_t>(at[k][0]), static_cast<std::int16_t>(at[k][1])};
        p.corner[k].z_20_12 = z << 12;
      }
      order(p);
    };
    const auto line = [&](std::uint32_t otz, std::uint32_t face) {
      scene::Primitive p = flat_triangle(material, otz);
      p.count = 2;
      p.face = face;
      order(p);
    };
    polygon(300, 300, 0);
    polygon(200, 200, 0);
    polygon(100, 100, 0);
    line(250, 1);  // before the polygon of 200
    line(100, 2);  // after all of them: 100 is not nearer than 100
    line(260, 3);  // at the place of line 1, and farther
    line(999, 4);  // before everything
    REQUIRE(order.finish(320, 240, 0, 1));
    std::vector<std::uint32_t> keys;
    for (const auto& o : order.far_to_near()) keys.push_back(o.primitive.otz);
    CHECK(keys == std::vector<std::uint32_t>{999, 300, 260, 250, 200, 100, 100});
    CHECK(order.far_to_near().back().primitive.count == 2);
  }
}
