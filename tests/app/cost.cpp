#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <string>
#include <thread>

#include "app/window/cost_meter.h"
#include "app/window/cost_table.h"
#include "cost/axes.h"
#include "demos/demos.h"

using app::CostTable;

namespace {

CostTable table_at(const scene::Knobs& knobs) {
  CostTable table;
  table.follow(knobs);
  return table;
}

const app::CostLine& line_of(const CostTable& table, std::string_view axis, std::string_view setting) {
  for (const auto& line : table.lines()) {
    if (line.axis->name == axis && line.setting->name == setting) return line;
  }
  FAIL("no such line");
  return table.lines().front();
}

// Measures every setting once: the frame as it is takes `now` ms, each other one `other`.
void measure_all(CostTable& table, double now, double other) {
  for (int i = 0; i < 200 && table.known() < table.all(); ++i) {
    const bool is_current = table.next() == table.current();
    table.add(is_current ? now : other);
  }
}

}  // namespace

TEST_SUITE("cost panel") {
  TEST_CASE("a rolling median forgets what is older than its window") {
    app::RollingMedian times;
    times.add(3);
    CHECK(times.median() == 3);
    times.add(5);
    CHECK(times.median() == 4);
    times.add(100);
    CHECK(times.median() == 5);  // one outlier moves nothing far
    for (std::size_t i = 0; i < app::RollingMedian::window; ++i) times.add(7);
    CHECK(times.count() == app::RollingMedian::window);
    CHECK(times.median() == 7);
  }

  TEST_CASE("the spread of nine times leaves out the two lowest and the two highest") {
    app::RollingMedian times;
    for (const double ms : {9.0, 1.0, 8.0, 2.0, 7.0, 3.0, 6.0, 4.0, 5.0}) times.add(ms);
    CHECK(times.spread().low == 3);
    CHECK(times.spread().high == 7);
  }

  TEST_CASE("a setting is dearer or cheaper only where its spread lies beyond that of the frame as it is") {
    auto table = table_at({});
    const scene::Knobs now;
    const auto feed = [&table, &now](double other, double swing) {
      for (std::size_t i = 0; i < table.lines().size() * 6; ++i) {
        const bool is_now = table.next() == now;
        table.add((is_now ? 10.0 : other) + (i % 2 == 0 ? swing : -swing));
      }
    };
    const auto order = [&table, &now] {
      for (const auto& line : table.lines()) {
        if (line.knobs != now) return table.against_current(line);
      }
      return 0;
    };
    CHECK(order() == 0);  // nothing is known yet
    feed(12, 0.5);
    CHECK(order() == 1);
    table = table_at({});
    feed(8, 0.5);
    CHECK(order() == -1);
    table = table_at({});
    feed(11, 3);
    CHECK(order() == 0);
  }

  TEST_CASE("a table is settled when every line that can be drawn has been measured nine times") {
    auto table = table_at({});
    CHECK_FALSE(table.is_settled());
    for (std::size_t i = 0; i < table.lines().size() * 12; ++i) {
      table.next();
      i % 7 == 3 ? table.fail("no") : table.add(1);
    }
    CHECK(table.is_settled());
  }

  TEST_CASE("there is a line for every setting of every axis of the cost report") {
    const auto table = table_at({});
    std::size_t settings = 0;
    for (const auto& axis : cost::axes()) settings += axis.settings.size();
    CHECK(table.lines().size() == settings);
  }

  TEST_CASE("each axis has exactly one current line at the console's settings") {
    const auto table = table_at({});
    for (const auto& axis : cost::axes()) {
      CAPTURE(axis.name);
      int current = 0;
      for (const auto& line : table.lines()) current += line.axis == &axis && line.is_current ? 1 : 0;
      CHECK(current == 1);
      CHECK(line_of(table, axis.name, axis.settings[axis.console].name).is_current);
    }
  }

  TEST_CASE("a table length that no line has leaves visibility without a current line") {
    scene::Knobs knobs;
    knobs.buckets = 1000;
    const auto table = table_at(knobs);
    for (const auto& line : table.lines()) CHECK((line.axis->name != "visibility" || !line.is_current));
  }

  TEST_CASE("of two lines that change nothing the one that says more is the current one") {
    scene::Knobs knobs;
    REQUIRE(scene::set_knob(knobs, "antialias", "rotated-16"));
    REQUIRE(scene::set_knob(knobs, "aa-filter", "tent"));
    const auto table = table_at(knobs);
    CHECK(line_of(table, "antialias", "rotated-16 tent").is_current);
    CHECK_FALSE(line_of(table, "antialias", "rotated-16").is_current);
  }

  TEST_CASE("a line changes the knobs of its own axis alone") {
    scene::Knobs knobs;
    REQUIRE(scene::set_knob(knobs, "filter", "bilinear"));
    const auto table = table_at(knobs);
    auto expected = knobs;
    REQUIRE(scene::set_knob(expected, "texture", "perspective"));
    CHECK(line_of(table, "texture", "perspective").knobs == expected);
  }

  TEST_CASE("every setting has its turn, the frame as it is among them again and again") {
    auto table = table_at({});
    int current = 0;
    std::size_t others = 0;
    while (others < table.all()) {
      if (table.next() == table.current()) {
        table.add(1);
        ++current;
      } else {
        table.add(2);
        ++others;
      }
    }
    CHECK(table.known() == table.all());
    CHECK(current >= static_cast<int>(table.all()) / CostTable::between);
  }

  TEST_CASE("a ratio is a line's time over the frame's, and 1 for the settings in use") {
    auto table = table_at({});
    CHECK_FALSE(table.ratio(line_of(table, "texture", "perspective")));
    measure_all(table, 2, 5);
    CHECK(*table.current_ms() == 2);
    CHECK(*table.ms(line_of(table, "texture", "perspective")) == 5);
    CHECK(*table.ratio(line_of(table, "texture", "perspective")) == 2.5);
    CHECK(*table.ratio(line_of(table, "texture", "affine")) == 1);
  }

  TEST_CASE("a setting that cannot be drawn says why and is not tried again") {
    auto table = table_at({});
    table.next();
    table.add(1);
    const auto refused = table.next();
    table.fail("too large");
    std::size_t told = 0;
    for (const auto& line : table.lines()) told += line.error == "too large" ? 1 : 0;
    CHECK(told == 1);
    for (int i = 0; i < 200; ++i) {
      CHECK(table.next() != refused);
      table.add(1);
    }
  }

  TEST_CASE("measurements stay while the knobs do, and begin again with others") {
    auto table = table_at({});
    measure_all(table, 2, 5);
    table.follow({});
    CHECK(table.known() == table.all());
    scene::Knobs other;
    other.buckets = 64;
    table.follow(other);
    CHECK(table.known() == 0);
    CHECK_FALSE(table.current_ms());
  }

  TEST_CASE("a setting reads as the command line has it") {
    const auto table = table_at({});
    CHECK(app::options_of(*line_of(table, "texture", "affine 4x4").setting) ==
          "--texture affine --subdivide 4");
  }

  TEST_CASE("the meter measures every setting of a scene within what it is granted") {
    app::CostMeter meter(demos::make(*demos::find("cyclic")));
    scene::Knobs knobs;
    knobs.width = 256;
    using namespace std::chrono_literals;
    const auto give_up = std::chrono::steady_clock::now() + 60s;
    do {
      meter.follow(30, knobs, {}, 50);
      std::this_thread::sleep_for(5ms);
    } while (meter.table().known() < meter.table().all() && std::chrono::steady_clock::now() < give_up);
    const auto table = meter.table();
    CHECK(table.known() == table.all());
    REQUIRE(table.current_ms());
    CHECK(*table.current_ms() > 0);
    // 64 samples a pixel are not free: an order of magnitude, not a benchmark.
    CHECK(*table.ratio(line_of(table, "antialias", "ssaa-8x8")) > 3);
  }

  TEST_CASE("a meter that is granted nothing measures nothing, and stops when told") {
    app::CostMeter meter(demos::make(*demos::find("cyclic")));
    using namespace std::chrono_literals;
    meter.follow(0, {}, {}, 0);
    std::this_thread::sleep_for(20ms);
    CHECK_FALSE(meter.table().current_ms());
    CHECK_FALSE(meter.has_ended());
    meter.stop();
    for (int i = 0; i < 1000 && !meter.has_ended(); ++i) std::this_thread::sleep_for(5ms);
    CHECK(meter.has_ended());
  }
}
