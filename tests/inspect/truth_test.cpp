#include "inspect/truth.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "../oracle/ray_caster.h"
#include "random_triangles.h"
#include "stage.h"

namespace {

using oracle::Rational;

// One triangle of a random scene as the oracle sees it: every pixel by itself, all in rationals.
struct Hit {
  std::uint32_t draw;
  Rational z;
  bool blends;
};

struct Surface {
  std::array<oracle::Corner, 3> corners;
  std::uint32_t draw;
  bool blends;
};

tests::Kind kind_of(int scene) {
  return tests::all_kinds[static_cast<std::size_t>(scene) % tests::all_kinds.size()];
}

// On whole pixels, as the console draws.
std::array<oracle::Corner, 3> for_oracle(const exact::Triangle& t) {
  std::array<oracle::Corner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {t[i].x & ~255, t[i].y & ~255, std::max(t[i].z, 1U)};
  return corners;
}

std::vector<Hit> cast(const std::vector<Surface>& surfaces, int x, int y) {
  std::vector<Hit> hits;
  for (const Surface& s : surfaces) {
    if (auto z = oracle::cast_ray(s.corners, x, y)) hits.push_back({s.draw, std::move(*z), s.blends});
  }
  return hits;
}

bool is_wrong(const std::vector<Hit>& hits) {
  const Hit *winner = nullptr, *owner = nullptr;
  for (const Hit& hit : hits) {
    if (hit.blends) continue;
    winner = &hit;
    if (owner == nullptr || hit.z < owner->z) owner = &hit;
  }
  if (winner != nullptr && winner->z != owner->z) return true;
  std::vector<Rational> seen;
  for (const Hit& hit : hits) {
    if (!hit.blends) continue;
    const bool is_seen = winner == nullptr || hit.draw > winner->draw;
    if (is_seen) seen.push_back(hit.z);
    if (winner == nullptr || hit.z == winner->z) continue;
    if (is_seen != (hit.z < winner->z)) return true;
  }
  return !std::is_sorted(seen.begin(), seen.end(), std::greater<>());
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("the wrong pixels are those an independent ray caster finds: 4,096 random scenes") {
    tests::RandomTriangles random(31);
    constexpr int size = 8, scenes_per_frame = 256;
    std::uint64_t wrong_pixels = 0, right_pixels = 0;
    for (int frame = 0; frame < 16; ++frame) {
      tests::Stage stage;
      std::vector<std::uint32_t> expected;
      std::uint32_t draw = 0;
      for (int scene = 0; scene < scenes_per_frame; ++scene) {
        const int left = scene % 16 * size, top = scene / 16 * size;
        stage.move_to(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top));
        std::vector<Surface> surfaces;
        for (const auto& t : random.scene(kind_of(scene), 2 + scene % 5, size)) {
          surfaces.push_back({for_oracle(t), draw++, frame % 3 == 0 && random.between(0, 1) != 0});
          const auto& c = surfaces.back().corners;
          stage.raw_polygon({{c[0].x / 256, c[0].y / 256, c[0].z},
                             {c[1].x / 256, c[1].y / 256, c[1].z},
                             {c[2].x / 256, c[2].y / 256, c[2].z}},
                            {.bucket = 1, .semi_transparent = surfaces.back().blends});
        }
        for (int y = 0; y < size; ++y) {
          for (int x = 0; x < size; ++x) {
            if (is_wrong(cast(surfaces, x, y)))
              expected.push_back(static_cast<std::uint32_t>((top + y) * 1024 + left + x));
          }
        }
      }
      const auto report = stage.report();
      std::vector<std::uint32_t> found;
      for (const auto& wrong : report.wrong) found.push_back(wrong.pixel);
      std::sort(expected.begin(), expected.end());
      REQUIRE(found == expected);
      wrong_pixels += found.size();
      right_pixels += report.pixels_drawn - found.size();
    }
    CHECK(wrong_pixels > 5000);
    CHECK(right_pixels > 5000);
  }

  TEST_CASE("equal depths are right whichever is on top") {
    tests::Stage stage;
    stage.quad(0, 0, 4, 4, 100, {.bucket = 1});
    stage.quad(0, 0, 4, 4, 100, {.bucket = 1});
    const auto once = stage.report();
    CHECK(once.wrong_pixels() == 0);
    CHECK(once.decisions.exact == 0);  // the same corners: nothing to compute
    stage.quad(0, 0, 5, 3, 100, {.bucket = 1});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 0);
    CHECK(report.decisions.exact > 0);
  }

  TEST_CASE("the two triangles of a quad have their own planes") {
    // A quad bent along its diagonal from (8,0) to (0,8): the first half lies at z
    // 100, the second falls to z 300.
    tests::Stage stage;
    stage.polygon({{0, 0, 100}, {8, 0, 100}, {0, 8, 100}, {8, 8, 300}});
    stage.quad(7, 7, 8, 8, 200);  // the quad's 1/z at (7,7) is 1/100 - 6/8 * (1/100 - 1/300) = 1/200: equal
    stage.quad(6, 6, 7, 7, 200);  // at (6,6) it is nearer: the small quad is wrong there
    const auto report = stage.report();
    REQUIRE(report.wrong_pixels() == 1);
    CHECK(report.wrong[0].pixel == 6 * 1024 + 6);
  }

  TEST_CASE("a hole in a texture hides nothing") {
    tests::Stage stage;
    stage.gpu().vram().at(641, 0) = 0x7fff;
    stage.quad(0, 0, 4, 4, 200);
    stage.quad(0, 0, 4, 2, 300, {.texel = ot::Uv{0, 0}});  // texel 0000h: writes nothing
    stage.quad(0, 2, 4, 4, 300, {.texel = ot::Uv{1, 0}});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 8);
    CHECK(report.fragments == 16 + 8);
    REQUIRE(report.lint.size() == 1);
    CHECK(report.lint[0] ==
          inspect::LintItem{"not-seen", "0:2",
                            "1 polygon drew nothing: every pixel transparent, masked or behind"});
  }

  TEST_CASE("a texel's bit 15 alone decides whether it is a layer") {
    tests::Stage stage;
    stage.gpu().vram().at(640, 0) = 0x8001;
    stage.gpu().vram().at(641, 0) = 0x0001;
    stage.quad(0, 0, 4, 4, 200);
    stage.quad(0, 0, 4, 2, 100,
               {.semi_transparent = true, .texel = ot::Uv{0, 0}});  // a pane: the wall stays owner
    stage.quad(0, 2, 4, 4, 100, {.semi_transparent = true, .texel = ot::Uv{1, 0}});  // a wall
    stage.quad(0, 0, 4, 4, 150, {.semi_transparent = true});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 16);
    CHECK(report.count(inspect::Cause::blend_order) ==
          16);  // above: over the nearer pane; below: behind the wall
  }

  TEST_CASE("primitives without depth are layers, never owners or winners") {
    tests::Stage stage;
    stage.quad(0, 0, 4, 4, 200);
    stage.rectangle(0, 0, 8, 8);
    stage.quad(0, 0, 4, 2, 100);
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 0);
    CHECK(report.pixels_drawn == 64);
    CHECK(report.polygons_judged == 2);
  }

  TEST_CASE("nothing is judged where nothing has depth, and the report says so") {
    tests::Stage stage;
    stage.rectangle(0, 0, 8, 8);
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 0);
    CHECK(inspect::to_text(report).find("nothing could be judged") != std::string::npos);
  }

  TEST_CASE("a triangle that wraps below the bottom of VRAM is judged at its own sample points") {
    // Drawing area rows 512..519 are stored at rows 0..7. z grows downwards from 100
    // at row 512 to 300 at row 520.
    tests::Stage stage;
    stage.gpu().gp0(0xe3000000 | 512 << 10);
    stage.gpu().gp0(0xe4000000 | 519 << 10 | 7);
    stage.upright(0, 512, 8, 520, 100, 300);
    stage.quad(0, 512, 8, 520, 150);  // equal at row 516
    CHECK(stage.report().wrong_pixels() == 32);
  }

  TEST_CASE("a triangle of a thousand columns is judged at its own sample points from end to end") {
    // z grows to the right from 100 at column 0 to 300 at column 1000: 1/z is 1/150 at column 500.
    tests::Stage stage;
    stage.gpu().gp0(0xe3000000);
    stage.gpu().gp0(0xe4000000 | 7 << 10 | 1023);
    stage.quad(0, 0, 1000, 8, 100, 300);
    stage.quad(0, 0, 1000, 8, 150);
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 4000);
    const auto is_left = [](const auto& wrong) { return wrong.pixel % 1024 < 500; };
    CHECK(std::all_of(report.wrong.begin(), report.wrong.end(), is_left));
  }
}
