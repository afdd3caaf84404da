// The sums and the pairs of a report, on small stages.

#include "inspect/report.h"

#include <doctest/doctest.h>

#include "stage.h"

using tests::Stage;

namespace {

inspect::Report frame(std::uint32_t number, std::size_t wrong) {
  inspect::Report report;
  report.frame = number;
  report.wrong.resize(wrong);
  return report;
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("The worst frame is the first one with the most wrong pixels") {
    inspect::Sums sums;
    for (const auto& [number, wrong] : {std::pair{4U, 2U}, {5U, 7U}, {6U, 7U}, {7U, 1U}})
      sums.add(frame(number, wrong));
    CHECK(sums.frames == 4);
    CHECK(sums.wrong_pixels == 17);
    CHECK(sums.worst_frame == 5);
    CHECK(sums.worst_pixels == 7);
  }

  TEST_CASE("Pairs come with the most pixels first") {
    Stage stage;
    // Two far surfaces drawn over near ones: two columns wrong, then five.
    stage.quad(0, 0, 2, 8, 100, {.bucket = 1});
    stage.quad(3, 0, 8, 8, 100, {.bucket = 1});
    stage.quad(0, 0, 2, 8, 200, {.bucket = 0});
    stage.quad(3, 0, 8, 8, 200, {.bucket = 0});
    const auto report = stage.report();
    REQUIRE(report.pairs.size() == 2);
    CHECK(report.pairs[0].pixels == 40);
    CHECK(report.pairs[0].winner.draw == 3);
    CHECK(report.pairs[0].owner.draw == 1);
    CHECK(report.pairs[1].pixels == 16);
    CHECK(report.pairs[0].winner_depth == doctest::Approx(200));
    CHECK(report.pairs[0].owner_depth == doctest::Approx(100));
  }

  TEST_CASE("Of a quad that is folded over itself, the half that is seen says how deep it is") {
    Stage stage;
    // Corners 0, 1, 2 and 1, 2, 3: with corner 3 beside corner 0 both triangles cover the same pixels.
    stage.quad(0, 0, 8, 8, 10, {.bucket = 1});
    stage.polygon({{0, 0, 100}, {8, 0, 400}, {0, 8, 400}, {0, 0, 50}}, {.bucket = 0});
    const auto report = stage.report();
    REQUIRE_FALSE(report.pairs.empty());
    for (const auto& pair : report.pairs) {
      CHECK(pair.winner.draw == 1);
      CHECK(pair.winner_depth < 400);
      CHECK(pair.owner_depth == doctest::Approx(10));
    }
    // At the corner both halves lie exactly where their corners are: 100 and 50.
    CHECK(report.pairs[0].winner_depth == doctest::Approx(50));
  }

  TEST_CASE("Depths that are equal make no order between draws, however many layers share them") {
    // Twelve layers at one depth, twelve at another, drawn near first: all wrong, and none in a cycle.
    Stage stage;
    for (std::uint32_t n = 0; n < 12; ++n) stage.quad(0, 0, 8, 8, 100, {.bucket = 1});
    for (std::uint32_t n = 0; n < 12; ++n) stage.quad(0, 0, 8, 8, 200, {.bucket = 0});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() == 64);
    CHECK(report.count(inspect::Cause::key_inversion) == 64);
    CHECK(report.raw_count(inspect::Cause::cyclic_overlap) == 0);
    CHECK(report.raw_count(inspect::Cause::interpenetration) == 0);
  }

  TEST_CASE("A cycle through layers of one depth is a cycle") {
    // On the left A and B (one depth) lie behind C, on the right C lies behind A and B.
    Stage stage;
    stage.quad(0, 0, 8, 8, 100, 300, {.bucket = 2});
    stage.quad(0, 0, 8, 8, 100, 300, {.bucket = 2});
    stage.quad(0, 0, 8, 8, 200, 200, {.bucket = 1});
    stage.quad(0, 0, 8, 8, 200, 200, {.bucket = 1});
    const auto report = stage.report();
    CHECK(report.wrong_pixels() > 0);
    CHECK(report.raw_count(inspect::Cause::cyclic_overlap) == report.wrong_pixels());
    CHECK(report.raw_count(inspect::Cause::interpenetration) == report.wrong_pixels());
  }

  TEST_CASE("What judging a pixel takes grows with its layers as n log n, also when all depths are equal") {
    const auto decisions = [](std::uint32_t layers, bool ties) {
      Stage stage;
      for (std::uint32_t n = 0; n < layers; ++n)
        stage.quad(0, 0, 8, 8, ties ? 100 + n % 2 * 50 : 100 + n, {.bucket = 1});
      const auto report = stage.report();
      return static_cast<double>(report.decisions.filtered + report.decisions.exact);
    };
    for (const bool ties : {false, true}) {
      CAPTURE(ties);
      CHECK(decisions(200, ties) < 2.5 * decisions(100, ties));
      CHECK(decisions(400, ties) < 2.5 * decisions(200, ties));
    }
  }
}
