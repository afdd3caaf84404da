#include <doctest/doctest.h>

#include <string>

#include "app/commands/describe.h"
#include "app/window/knob_choices.h"

TEST_SUITE("window") {
  TEST_CASE("every choice that the panel offers is a value the knob takes and gives back") {
    for (const auto& knob : scene::knob_table()) {
      for (const auto& choice : app::knob_choices(knob)) {
        CAPTURE(std::string(knob.name));
        CAPTURE(choice);
        scene::Knobs knobs;
        CHECK(knob.set(knobs, choice));
        CHECK(knob.get(knobs) == choice);
      }
    }
  }

  TEST_CASE("every knob is either a choice or a range, and its range's ends are values it takes") {
    for (const auto& knob : scene::knob_table()) {
      CAPTURE(std::string(knob.name));
      const auto range = app::knob_range(knob);
      REQUIRE(range.has_value() == app::knob_choices(knob).empty());
      if (!range) continue;
      scene::Knobs knobs;
      CHECK(range->low < range->high);
      for (const double end : {range->low, range->high}) {
        const auto text = range->is_whole ? std::to_string(static_cast<int>(end)) : std::to_string(end);
        CHECK(knob.set(knobs, text));
      }
    }
  }

  TEST_CASE("the command line of the console's settings names the scene and the file alone") {
    CHECK(app::render_command("crates", 0, {}) == "otter render crates -o picture.png");
  }

  TEST_CASE("the command line names what is not the console's, flags without a value") {
    scene::Knobs knobs;
    knobs.visibility = scene::Visibility::zbuffer;
    knobs.depth_reversed = true;
    knobs.near_z = 0.5;
    CHECK(app::render_command("crates", 120, knobs) ==
          "otter render crates --frame 120 --visibility zbuffer --depth-reversed --near 0.5 -o picture.png");
  }

  TEST_CASE("the command line names the frame and the camera that was moved") {
    CHECK(app::render_command("crates", 7, {}, app::CameraPlace{{-1, 0.5F, 2}, 45, -3}) ==
          "otter render crates --frame 7 --camera=-1,0.5,2,45,-3 -o picture.png");
  }

  TEST_CASE("a file name with blanks or quotes is quoted for a shell") {
    CHECK(app::render_command("my model's.obj", 0, {}) == "otter render 'my model'\\''s.obj' -o picture.png");
  }

  TEST_CASE("knobs of depth matter in z-buffer mode alone, the table's where there is a table") {
    const auto matters = [](std::string_view name, scene::Visibility mode) {
      scene::Knobs knobs;
      knobs.visibility = mode;
      for (const auto& knob : scene::knob_table()) {
        if (knob.name == name) return app::knob_matters(knob, knobs);
      }
      FAIL("no such knob");
      return false;
    };
    CHECK_FALSE(matters("depth", scene::Visibility::ot));
    CHECK(matters("depth", scene::Visibility::zbuffer));
    CHECK(matters("near", scene::Visibility::zbuffer));
    CHECK(matters("buckets", scene::Visibility::ot));
    CHECK_FALSE(matters("buckets", scene::Visibility::sorted));
    CHECK_FALSE(matters("key", scene::Visibility::bsp));
    CHECK(matters("texture", scene::Visibility::ot));
  }

  TEST_CASE("modes are described with what they depend on") {
    scene::Knobs knobs;
    CHECK(app::describe(knobs) == "ordering table, 1,024 buckets, average z");
    knobs.visibility = scene::Visibility::zbuffer;
    CHECK(app::describe(knobs) == "z-buffer, 24 bits, hyperbolic");
    knobs.depth = scene::DepthFormat::float32;
    CHECK(app::describe(knobs) == "z-buffer, float, hyperbolic");
  }

  TEST_CASE("numbers are written with commas") {
    CHECK(app::with_commas(0) == "0");
    CHECK(app::with_commas(999) == "999");
    CHECK(app::with_commas(1000) == "1,000");
    CHECK(app::with_commas(1234567) == "1,234,567");
  }
}
