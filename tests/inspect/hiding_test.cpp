// What a fill, copy or upload erases, and what an opaque layer covers, is not judged any more.

#include <doctest/doctest.h>

#include <vector>

#include "inspect/history.h"
#include "inspect/maps.h"
#include "stage.h"

using inspect::Cause;
using tests::is_exactly;
using tests::Stage;

namespace {

using Words = std::vector<std::uint32_t>;

/// 16 x 4 pixels from the origin: fills are cut to 16 columns.
void fill(Stage& stage) { stage.gpu().gp0(Words{0x02404040, 0, 4U << 16 | 16}); }
void upload(Stage& stage) { stage.gpu().gp0(Words{0xa0000000, 0, 1U << 16 | 2, 0x12341234}); }
void copy(Stage& stage) { stage.gpu().gp0(Words{0x80000000, 32, 0, 4U << 16 | 8}); }

std::string verdict(Stage& stage, int x, int y) {
  const auto report = stage.report();
  return inspect::pixel_history(report, stage.trace(), x, y).back();
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("a near surface that a fill, a copy or an upload erased is nobody's owner any more") {
    struct Row {
      void (*erase)(Stage&);
      std::uint64_t pixels;
      const char* name;
    };
    for (const Row& row : {Row{fill, 32, "a fill"}, Row{copy, 32, "a copy"}, Row{upload, 2, "an upload"}}) {
      Stage list;
      list.quad(0, 0, 8, 8, 100);
      row.erase(list);
      list.quad(0, 0, 8, 8, 200);
      CHECK(is_exactly(list.report(), Cause::list_order, 64 - row.pixels));
      CHECK(verdict(list, 0, 0) ==
            "  right: shows 0:3; what was there before 0:2, " + std::string(row.name) + ", is erased");

      Stage deep{gpu::DepthOptions{}};
      deep.quad(0, 0, 8, 8, 100);
      row.erase(deep);
      deep.quad(0, 0, 8, 8, 200);
      CHECK(deep.report().wrong_pixels() == 0);
      // The depth there is empty again.
      CHECK(verdict(deep, 0, 0).starts_with("  right: shows 0:3"));
      CHECK(verdict(deep, 0, 7) == "  right: shows 0:1");
    }
  }

  TEST_CASE("a pixel whose polygons were erased says so, and shows what erased them") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100);
    fill(stage);
    CHECK(stage.report().wrong_pixels() == 0);
    CHECK(verdict(stage, 0, 0) == "  right: shows 0:2, a fill; what was there before it is erased");
    CHECK(verdict(stage, 0, 5) == "  right: shows 0:1");
  }

  TEST_CASE("what an opaque rectangle covers is not missed, in a list as before a z-buffer") {
    for (const bool deep : {false, true}) {
      Stage stage(deep ? std::optional(gpu::DepthOptions{}) : std::nullopt);
      stage.quad(0, 0, 8, 8, 100);
      stage.rectangle(0, 0, 8, 4);
      stage.quad(0, 0, 4, 8, 200);
      const auto report = stage.report();
      CHECK(report.wrong_pixels() == (deep ? 0 : 16));  // below the rectangle
      const std::string covered =
          "  right: shows 0:2, a rectangle; what was there before it is covered by a layer";
      CHECK(verdict(stage, 6, 0) == covered);
      // The list draws over the rectangle; a z-buffer still knows what is under it.
      CHECK(verdict(stage, 0, 0) == (deep ? covered
                                          : "  right: shows 0:3; what was there before 0:2, a "
                                            "rectangle, is covered by a layer"));
    }
  }

  TEST_CASE("a layer that lets light through covers nothing") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100);
    stage.gpu().gp0(Words{0x62808080, 0, 8U << 16 | 8});
    stage.quad(0, 0, 8, 8, 200);
    CHECK(is_exactly(stage.report(), Cause::list_order, 64));
  }

  TEST_CASE("truth lies over what a fill left") {
    Stage stage;
    stage.quad(0, 0, 8, 8, 100, {.rgb = {255, 0, 0}});
    fill(stage);
    stage.quad(0, 0, 8, 8, 50, {.semi_transparent = true, .rgb = {0, 0, 0}});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 0);
    CHECK(verdict(stage, 0, 0) ==
          "  right: shows 0:2, a fill under 1 blended over it; what was there before it is erased");
  }

  TEST_CASE("of a quad that folds over itself the half that is seen is named, with its own depth") {
    // Corners 0, 1, 2 and 1, 2, 3, with corner 3 beside corner 0: the second half is drawn over the first.
    Stage stage;
    stage.polygon({{0, 0, 100}, {8, 0, 100}, {0, 8, 100}, {0, 0, 400}});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() > 0);
    REQUIRE(report.pairs.size() == 1);
    CHECK(report.pairs[0].winner_half == 1);
    CHECK(report.pairs[0].owner_half == 0);
    CHECK(report.pairs[0].owner_depth == doctest::Approx(100));
    CHECK(report.pairs[0].winner_depth > 100);
    const auto lines = inspect::pixel_history(report, stage.trace(), 0, 0);
    REQUIRE(lines.size() == 4);
    CHECK(lines[1].find("0:1 (first half) quad wrote") != std::string::npos);
    CHECK(lines[2].find("depth 400.0000") != std::string::npos);
    CHECK(lines[3] ==
          "  wrong: shows 0:1 (second half) at depth 400.0000, should show 0:1 (first half) at depth "
          "100.0000: Interpenetration");
    CHECK(inspect::to_text(report).find("0:1 (second half) / 0:1 (first half)") != std::string::npos);
  }
}
