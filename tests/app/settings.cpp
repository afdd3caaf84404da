#include "app/window/settings.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

using app::Panel;

namespace {

app::Settings unusual() {
  app::Settings settings;
  settings.knobs.visibility = scene::Visibility::zbuffer;
  settings.knobs.buckets = 77;
  settings.knobs.depth_reversed = true;
  settings.dock.raise(Panel::cost);
  settings.dock.raise(Panel::knobs);
  settings.dock.move_over(Panel::cost);
  settings.dock.width = {250, 411};
  settings.text_size = 1.75;
  settings.pace = app::Pace::hz50;
  return settings;
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("settings are read back as they were written") {
    for (const auto& settings : {app::Settings{}, unusual()}) {
      const auto read = app::parse_settings(app::to_text(settings));
      REQUIRE(read);
      CHECK(read->settings == settings);
      CHECK(read->ignored.empty());
    }
  }

  TEST_CASE("what is no settings file is refused with what was expected") {
    CHECK(app::parse_settings("").error().text == "expected JSON");
    CHECK(app::parse_settings("{\"schema\":").error().text == "expected JSON");
    for (const std::string text : {"[]", "7", "{}", R"({"schema":"otter.window/2"})", R"({"schema":1})"}) {
      CAPTURE(text);
      const auto read = app::parse_settings(text);
      REQUIRE_FALSE(read);
      CHECK(read.error().text == R"(expected "schema": "otter.window/1")");
    }
  }

  TEST_CASE("what the file says wrongly is named and left as at first, and the rest counts") {
    for (const std::string text :
         {R"("knobs":{"buckets":"-1"})", R"("knobs":{"colours":"15"})", R"("knobs":[])",
          R"("knobs":{"buckets":5})", R"("panels":{"cost":"top"})", R"("panels":{"open":["door"]})",
          R"("panels":{"open":7})", R"("panels":{"widths":[1]})", R"("panels":{"widths":[1e99,"a"]})",
          R"("text":0)", R"("text":"big")", R"("pace":60)"}) {
      CAPTURE(text);
      const auto read = app::parse_settings(R"({"schema":"otter.window/1",)" + text + "}");
      REQUIRE(read);
      CHECK_FALSE(read->ignored.empty());
      CHECK(read->settings == app::Settings{});
    }
    const auto read = app::parse_settings(
        R"({"schema":"otter.window/1","knobs":{"buckets":"many","depth":"16"},"text":2})");
    REQUIRE(read);
    CHECK(read->ignored.size() == 1);
    CHECK(read->settings.knobs.depth == scene::DepthFormat::bits16);
    CHECK(read->settings.text_size == 2);
  }

  TEST_CASE("knobs named on the command line count more than remembered ones, at the console's value too") {
    auto knobs = unusual().knobs;
    scene::Knobs asked;
    asked.key = scene::Key::farthest;
    app::overrule(knobs, asked, {"visibility", "key"});
    CHECK(knobs.visibility == scene::Visibility::ot);
    CHECK(knobs.key == scene::Key::farthest);
    CHECK(knobs.buckets == 77);
  }

  TEST_CASE("settings lie in the folder that XDG_CONFIG_HOME names, or in ~/.config") {
    setenv("XDG_CONFIG_HOME", "/somewhere", 1);
    CHECK(app::default_settings_file() == "/somewhere/otter/window.json");
    setenv("HOME", "/home/me", 1);
    setenv("XDG_CONFIG_HOME", "relative", 1);  // to be ignored, as the standard says
    CHECK(app::default_settings_file() == "/home/me/.config/otter/window.json");
    unsetenv("XDG_CONFIG_HOME");
    unsetenv("HOME");
    CHECK_FALSE(app::default_settings_file());
  }
}
