#include "cost/report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cost/finding.h"
#include "scenes.h"

using namespace cost_test;

namespace {

cost::SceneResult quick_sweep(std::vector<const cost::Axis*> axes, int stop_after = -1) {
  cost::Subject subject(runway(false), 0);
  cost::SweepOptions options;
  options.axes = std::move(axes);
  options.quick = true;
  options.rounds = 2;
  int asked = 0;
  options.stop = [&] { return stop_after >= 0 && ++asked > stop_after; };
  auto result = cost::sweep(subject, options);
  REQUIRE(result);
  return *result;
}

std::string text_of(const cost::SceneResult& result) {
  cost::Report report;
  report.scenes = {result};
  return cost::to_text(report);
}

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE(
      "a sweep measures every setting of an axis in both directions, and says what it found in a sentence") {
    const auto* axis = cost::find_axis("texture");
    const auto result = quick_sweep({axis});
    const auto wanted = std::ranges::count_if(axis->settings, &cost::Setting::in_quick);
    CHECK(static_cast<std::ptrdiff_t>(result.rows.size()) == 2 * wanted);
    CHECK(result.complete);
    CHECK(result.rounds == 2);
    for (const auto& row : result.rows) {
      CHECK(row.ms > 0);
      CHECK(row.stages.raster > 0);
      CHECK(row.picture.width == 320);
    }
    const auto text = cost::sentence(result, *axis);
    CHECK(text.find("perspective takes") != std::string::npos);
    CHECK(text.find("texels") != std::string::npos);
    CHECK(cost::sentence(result, *cost::find_axis("fog")).empty());
  }

  TEST_CASE(
      "a sweep draws each setting once a round, however many axes ask for it, and tells the time left") {
    cost::Subject subject(runway(false), 0);
    cost::SweepOptions options;
    options.axes = {cost::find_axis("transform"), cost::find_axis("position")};
    options.rounds = 3;
    std::vector<double> left;
    std::size_t steps = 0;
    options.progress = [&](std::size_t done, std::size_t all, double seconds_left) {
      CHECK(done == left.size() + 1);
      steps = all;
      left.push_back(seconds_left);
    };
    REQUIRE(cost::sweep(subject, options));
    // Three transforms and four positions, up and down; the console's and the most accurate are the same on
    // both.
    CHECK(steps == 3 * (2 * (3 + 4) - 2));
    CHECK(left.size() == steps);
    CHECK(left.front() > 0);
    CHECK(*std::min_element(left.begin(), left.end()) >= 0);
  }

  TEST_CASE("a sweep that is stopped reports what it has") {
    const auto* axis = cost::find_axis("texture");
    const auto result = quick_sweep({axis}, 9);  // in the second round of errors and timing
    CHECK_FALSE(result.complete);
    CHECK(result.rows.size() < 2 * axis->settings.size());
  }

  TEST_CASE("JSON, CSV and HTML hold every setting, and HTML needs no other file") {
    cost::Report report{.command = "otter cost runway",
                        .machine = "a machine",
                        .target = "a target",
                        .scenes = {quick_sweep({cost::find_axis("colour")})}};
    const auto& rows = report.scenes[0].rows;
    const auto json = nlohmann::json::parse(cost::to_json(report));
    CHECK(json["schema"] == "otter.cost/1");
    CHECK(json["scene"] == "runway");
    CHECK(json["width"] == 320);
    REQUIRE(json["settings"].size() == rows.size());
    for (const auto* key : {"axis", "direction", "setting", "ms", "stages", "bytes", "errors"}) {
      CHECK(json["settings"][0].contains(key));
    }
    const auto csv = cost::to_csv(report);
    CHECK(std::ranges::count(csv, '\n') == static_cast<std::ptrdiff_t>(rows.size()) + 1);
    const auto html = cost::to_html(report).page;
    CHECK(html.find("http://") == html.find("http://www.w3.org"));  // names of SVG, nothing to load
    CHECK(html.find("src=\"data:image/png;base64,") != std::string::npos);
    CHECK(html.find("Keeping colours") != std::string::npos);
    // Plots take their colours from the page, and no two of them name their parts alike.
    CHECK(html.find("var(--up)") != std::string::npos);
    CHECK(html.find("id='gp") == std::string::npos);
    CHECK(cost::to_text(report).find("15-dither") != std::string::npos);
  }

  TEST_CASE("no entry of the printed front is beaten by any row of the same report") {
    const auto result = quick_sweep({cost::find_axis("texture"), cost::find_axis("antialias")});
    const auto front = cost::front_of(result.rows);
    REQUIRE(front.size() > 1);
    const auto text = text_of(result);
    for (const auto* entry : front) {
      CHECK(text.find(entry->label() + "\n") != std::string::npos);
      for (const auto& row : result.rows) {
        CHECK_FALSE((row.ms < entry->ms && row.errors.colour_rms < entry->errors.colour_rms));
      }
    }
  }

  TEST_CASE("a report of a busy machine says so, one of a quiet machine does not") {
    cost::SceneResult result;
    result.rows.emplace_back().ms = 1;
    for (const double noise : {0.05, 0.3}) {
      result.noise = noise;
      const auto text = text_of(result);
      CHECK((text.find("the machine was busy") != std::string::npos) == (noise > 0.1));
    }
  }

  TEST_CASE("base64 of a picture is a PNG") {
    const auto text = cost::png_base64(base::Picture(3, 2, base::Rgba{1, 2, 3}));
    CHECK(text.starts_with("iVBORw0KGgo"));
    CHECK(text.size() % 4 == 0);
  }
}
