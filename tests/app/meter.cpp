// The one thing that runs beside the window: the cost meter's thread. The same file is a program of its own
// under ThreadSanitizer (./run test-long).

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/viewer.h"
#include "app/window/cost_meter.h"
#include "demos/demos.h"
#include "load/load.h"

namespace {

using Clock = std::chrono::steady_clock;

/// Waits for it, but not for ever.
template <class Condition>
bool happens(Condition&& condition) {
  const auto end = Clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// A file's animation, whose state a copy of the scene might share.
scene::Scene animated_file() {
  auto loaded = load::parse_x3d(
      "<X3D><Scene><Viewpoint position='0 0 8'/><Transform DEF='T'><Shape><Box/></Shape></Transform>"
      "<TimeSensor DEF='C' cycleInterval='2' loop='true'/>"
      "<PositionInterpolator DEF='P' key='0 0.5 1' keyValue='0 0 0 1 1 0 0 0 0'/>"
      "<OrientationInterpolator DEF='O' key='0 1' keyValue='0 1 0 0 0 1 0 3'/>"
      "<ROUTE fromNode='C' fromField='fraction_changed' toNode='P' toField='set_fraction'/>"
      "<ROUTE fromNode='C' fromField='fraction_changed' toNode='O' toField='set_fraction'/>"
      "<ROUTE fromNode='P' fromField='value_changed' toNode='T' toField='set_translation'/>"
      "<ROUTE fromNode='O' fromField='value_changed' toNode='T' toField='set_rotation'/></Scene></X3D>",
      {"animated.x3d", "/nonexistent"});
  REQUIRE(loaded);
  REQUIRE(loaded->scene.animate);
  return std::move(loaded->scene);
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("the cost meter measures beside the window that draws the same scene, and follows its knobs") {
    std::vector<scene::Scene> scenes{animated_file()};
    for (const auto* demo : {"crates", "glass"}) scenes.push_back(demos::make(*demos::find(demo)));
    for (auto& scene : scenes) {
      scene::Knobs knobs;
      app::Viewer machine(std::move(scene), knobs);
      app::CostMeter meter(machine.scene_as_given());
      std::int64_t frame = 0;
      const auto draw = [&] {
        REQUIRE(machine.draw(++frame, knobs));
        meter.follow(frame, knobs, {}, 6);
      };
      CHECK(happens([&] { return draw(), meter.table().known() >= 4 && meter.table().current_ms(); }));
      knobs.visibility = scene::Visibility::zbuffer;
      draw();
      CHECK(meter.table().current() == knobs);
      CHECK(happens([&] { return draw(), meter.table().known() >= 2 && meter.table().current_ms(); }));
    }
  }

  TEST_CASE(
      "a meter that is stopped ends after the frame it draws; one that is dropped at once does no harm") {
    app::CostMeter meter(demos::make(*demos::find("crates")));
    meter.follow(0, {}, {}, 50);
    meter.stop();
    CHECK(happens([&] { return meter.has_ended(); }));
    app::CostMeter dropped(demos::make(*demos::find("crates")));
    dropped.follow(0, {}, {}, 50);
  }

  TEST_CASE("a meter that is granted nothing more rests") {
    app::CostMeter meter(demos::make(*demos::find("cyclic")));
    meter.follow(0, {}, {}, 6);
    CHECK(happens([&] { return meter.table().current_ms().has_value() || meter.table().known() > 0; }));
    // It may be in a measurement when the grant is spent; after that nothing changes.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto known = meter.table().known();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    CHECK(meter.table().known() == known);
  }
}
