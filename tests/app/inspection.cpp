#include "app/window/inspection.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "app/viewer.h"
#include "demos/demos.h"

namespace {

struct Inspected {
  explicit Inspected(const scene::Knobs& knobs)
      : machine(demos::make(*demos::find("cyclic")), knobs), inspection(machine, knobs) {
    state.knobs = knobs;
    state.frame = 12;
    REQUIRE(machine.draw(12, knobs));
    REQUIRE(inspection.update(state));
  }
  app::Viewer machine;
  app::Inspection inspection;
  app::WindowState state;
};

bool is_one_colour(const base::Picture& picture) {
  return std::ranges::all_of(picture.pixels, [&](const auto& p) { return p == picture.pixels.front(); });
}

std::size_t pixels_unlike(const base::Picture& picture, const base::Rgba& colour) {
  return static_cast<std::size_t>(
      std::ranges::count_if(picture.pixels, [&](const auto& p) { return !(p == colour); }));
}

}  // namespace

TEST_SUITE("app") {
  TEST_CASE("the first K draws of a frame are its picture with the later ones undone, on the canvas too") {
    scene::Knobs fine;
    fine.position = scene::Position::fine;
    for (const scene::Knobs& knobs : {scene::Knobs{}, fine}) {
      Inspected on(knobs);
      const auto& inspection = on.inspection;
      CHECK(inspection.unwatched().empty());
      REQUIRE(inspection.draws() > 2);
      CHECK(inspection.after(inspection.draws()).pixels == on.machine.picture().pixels);
      const auto filled = inspection.after(1);
      CHECK(is_one_colour(filled));
      // Every draw shows more of the beams.
      std::size_t before = 0;
      for (int count = 2; count <= inspection.draws(); ++count) {
        const auto shown = pixels_unlike(inspection.after(count), filled.pixels.front());
        CHECK(shown >= before);
        before = shown;
      }
      CHECK(before > 10'000);
      CHECK(inspection.after(inspection.draws() - 1).pixels != on.machine.picture().pixels);
      CHECK(inspection.report().wrong_pixels() > 0);
      CHECK(inspection.map(app::Map::truth).pixels != on.machine.picture().pixels);
    }
  }

  TEST_CASE("a frame of more samples than pixels is not watched, and the knobs that make it so are named") {
    scene::Knobs knobs;
    knobs.resolution = 2;
    knobs.position = scene::Position::fine;
    const Inspected on(knobs);
    REQUIRE(on.inspection.unwatched().size() == 1);
    CHECK(on.inspection.unwatched()[0]->name == "resolution");
    CHECK(on.inspection.draws() == 1);  // the fill of VRAM
  }
}
