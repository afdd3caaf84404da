#include "app/window/dock.h"

#include <doctest/doctest.h>

#include <string>

using app::Panel;
using app::Rect;
using app::Side;

namespace {

bool is_within(Rect inner, Rect outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.width >= 0 && inner.height >= 0 &&
         inner.x + inner.width <= outer.x + outer.width && inner.y + inner.height <= outer.y + outer.height;
}

bool overlap(Rect a, Rect b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

app::Dock all_open() {
  app::Dock dock;
  for (std::size_t i = 0; i < app::panel_count; ++i) dock.raise(static_cast<Panel>(i));
  return dock;
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("without panels the picture has the whole area") {
    const Rect area{0, 0, 960, 720};
    CHECK(app::lay_out({}, area, 1).picture == area);
    CHECK(app::lay_out({}, area, 1).panels.empty());
  }

  TEST_CASE("panels lie beside the picture and beside one another, within a window of any size") {
    for (const int width : {90, 320, 640, 1920}) {
      for (const int height : {1, 40, 220, 480, 1080}) {
        for (const double scale : {0.5, 1.0, 2.0, 4.0}) {
          CAPTURE(width);
          CAPTURE(height);
          CAPTURE(scale);
          const Rect area{0, 0, width, height};
          const auto layout = app::lay_out(all_open(), area, scale);
          CHECK(layout.panels.size() == app::panel_count);
          for (const auto& one : layout.panels) {
            CHECK(is_within(one.place, area));
            CHECK_FALSE(overlap(one.place, layout.picture));
            for (const auto& other : layout.panels) {
              if (one.panel != other.panel) CHECK_FALSE(overlap(one.place, other.place));
            }
          }
        }
      }
    }
  }

  TEST_CASE("a third of the width is left to the picture however wide the columns are") {
    auto dock = all_open();
    dock.width = {2000, 2000};
    CHECK(app::lay_out(dock, {0, 0, 900, 700}, 1).picture.width >= 300);
  }

  TEST_CASE("where panels would be too low the ones opened first fold to their titles") {
    auto dock = all_open();
    for (std::size_t i = 0; i < app::panel_count; ++i) dock.side[i] = Side::left;
    dock.raise(Panel::cost);
    int unfolded = 0;
    for (const auto& docked : app::lay_out(dock, {0, 0, 900, 300}, 1).panels) {
      if (!docked.is_folded) {
        ++unfolded;
        CHECK(docked.panel == Panel::cost);
      }
    }
    CHECK(unfolded == 1);
    for (const auto& docked : app::lay_out(dock, {0, 0, 900, 2000}, 1).panels) CHECK_FALSE(docked.is_folded);
  }

  TEST_CASE("a panel moved over stands in the other column") {
    app::Dock dock;
    dock.raise(Panel::knobs);
    CHECK(app::lay_out(dock, {0, 0, 900, 700}, 1).picture.x == 0);
    dock.move_over(Panel::knobs);
    const auto layout = app::lay_out(dock, {0, 0, 900, 700}, 1);
    CHECK(layout.panels[0].place.x == 0);
    CHECK(layout.picture.x == layout.panels[0].place.width);
  }

  TEST_CASE("a column is as wide as its edge was dragged to") {
    app::Dock dock;
    dock.raise(Panel::knobs);
    const Rect area{0, 0, 1000, 700};
    app::drag_edge(dock, Side::right, 800, area, 2);
    CHECK(dock.width[1] == 120);  // no narrower
    app::drag_edge(dock, Side::right, 600, area, 2);
    CHECK(dock.width[1] == 200);
    CHECK(app::lay_out(dock, area, 2).picture.width == 600);
  }

  TEST_CASE("panels are known by name") {
    for (std::size_t i = 0; i < app::panel_count; ++i) {
      CHECK(app::panel_named(app::panel_names[i]) == static_cast<Panel>(i));
    }
    CHECK_FALSE(app::panel_named("nothing"));
  }
}
