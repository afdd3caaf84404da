#include "app/window/window_state.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "app/window/pad_keys.h"

using app::KeyAction;
using app::WindowState;
using scene::Visibility;

namespace {

// Presses a key as the window does.
void press(WindowState& state, std::string_view key) {
  const auto asked = app::asked_by_key(key);
  REQUIRE(asked);
  app::handle(state, *asked);
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("no two rows of the key table claim the same key or button") {
    std::set<std::string_view> keys;
    std::set<std::string_view> buttons;
    for (const auto& row : app::bindings()) {
      CHECK(keys.insert(row.key).second);
      if (!row.other_key.empty()) CHECK(keys.insert(row.other_key).second);
      if (!row.button.empty()) CHECK(buttons.insert(row.button).second);
    }
  }

  TEST_CASE("the help names every key of the table and what it does, and nothing else") {
    const auto help = app::key_help();
    std::size_t lines = 1;  // the heading
    for (const auto& row : app::bindings()) {
      CHECK(help.find("  " + std::string(row.key)) != std::string::npos);
      CHECK(help.find(row.does) != std::string::npos);
      ++lines;
    }
    lines += app::gestures().size();
    CHECK(static_cast<std::size_t>(std::count(help.begin(), help.end(), '\n')) == lines);
  }

  TEST_CASE("every action but selecting a scene by number is on a key") {
    std::set<KeyAction> on_a_key;
    for (const auto& row : app::bindings()) on_a_key.insert(row.action);
    for (int i = 0; i <= static_cast<int>(KeyAction::quit); ++i) {
      const auto action = static_cast<KeyAction>(i);
      CAPTURE(i);
      CHECK(on_a_key.contains(action) == (action != KeyAction::select_scene));
    }
  }

  TEST_CASE("keys that the manual promises do what it says") {
    struct Promise {
      const char* key;
      KeyAction action;
    };
    for (const auto& promise : {Promise{"Tab", KeyAction::switch_visibility},
                                {"V", KeyAction::split},
                                {"D", KeyAction::differences},
                                {"Space", KeyAction::pause},
                                {"N", KeyAction::next_frame},
                                {"PageDown", KeyAction::next_scene},
                                {"PageUp", KeyAction::previous_scene},
                                {"F1", KeyAction::help},
                                {"H", KeyAction::help},
                                {"F2", KeyAction::knobs},
                                {"K", KeyAction::knobs},
                                {"F3", KeyAction::vram},
                                {"F11", KeyAction::fullscreen},
                                {"C", KeyAction::cost},
                                {"F12", KeyAction::save_picture},
                                {"Shift F12", KeyAction::save_window},
                                {"Escape", KeyAction::close},
                                {"Ctrl +", KeyAction::larger_text},
                                {"Q", KeyAction::quit}}) {
      CAPTURE(promise.key);
      const auto asked = app::asked_by_key(promise.key);
      REQUIRE(asked);
      CHECK(asked->action == promise.action);
    }
  }

  TEST_CASE("a key that means nothing asks for nothing") {
    CHECK_FALSE(app::asked_by_key("F7"));
    CHECK_FALSE(app::asked_by_key(""));
    CHECK_FALSE(app::asked_by_button(""));
  }

  TEST_CASE("Tab switches to the z-buffer and back") {
    WindowState state;
    press(state, "Tab");
    CHECK(state.knobs.visibility == Visibility::zbuffer);
    CHECK(state.other_knobs().visibility == Visibility::ot);
    press(state, "Tab");
    CHECK(state.knobs.visibility == Visibility::ot);
  }

  TEST_CASE("M goes through all modes, and the other picture is always of another mode") {
    WindowState state;
    std::set<Visibility> seen;
    for (int i = 0; i < 4; ++i) {
      seen.insert(state.knobs.visibility);
      CHECK(state.other != state.knobs.visibility);
      press(state, "M");
    }
    CHECK(seen.size() == 4);
    CHECK(state.knobs.visibility == Visibility::ot);
  }

  TEST_CASE("buckets halve and double between 1 and 65536, by powers of two") {
    WindowState state;
    state.knobs.buckets = 1000;
    press(state, "-");
    CHECK(state.knobs.buckets == 512);
    press(state, "-");
    CHECK(state.knobs.buckets == 256);
    press(state, "=");
    CHECK(state.knobs.buckets == 512);
    for (int i = 0; i < 20; ++i) press(state, "=");
    CHECK(state.knobs.buckets == 65536);
    for (int i = 0; i < 20; ++i) press(state, "-");
    CHECK(state.knobs.buckets == 1);
  }

  TEST_CASE("a digit selects that scene, if there is one, from its first frame and camera") {
    WindowState state;
    state.scenes = 3;
    state.frame = 100;
    app::orbit(state.camera, 1, 0);
    press(state, "4");
    CHECK(state.scene == 0);
    CHECK(state.frame == 100);
    press(state, "3");
    CHECK(state.scene == 2);
    CHECK(state.frame == 0);
    CHECK(state.camera == app::CameraOffset{});
  }

  TEST_CASE("PageDown and PageUp go round the scenes") {
    WindowState state;
    state.scenes = 2;
    press(state, "PageUp");
    CHECK(state.scene == 1);
    press(state, "PageDown");
    CHECK(state.scene == 0);
  }

  TEST_CASE("N pauses and goes on by one frame; B goes back, never before the first") {
    WindowState state;
    press(state, "N");
    CHECK(state.paused);
    CHECK(state.frame == 1);
    press(state, "B");
    press(state, "B");
    CHECK(state.frame == 0);
  }

  TEST_CASE("with vsync 60 frames of animation pass in a second of any refresh rate") {
    for (const int refresh : {30, 60, 75, 144, 240}) {
      CAPTURE(refresh);
      WindowState state;
      for (int i = 0; i < refresh; ++i) app::let_pass(state, 1.0 / refresh);
      CHECK(state.frame >= 59);
      CHECK(state.frame <= 60);
    }
  }

  TEST_CASE("at 50 Hz a second of 50 frames is 60 frames of animation; at 60 Hz each is one") {
    WindowState state;
    state.pace = app::Pace::hz50;
    for (int i = 0; i < 50; ++i) app::let_pass(state, 0);
    CHECK(state.frame == 60);
    state.pace = app::Pace::hz60;
    state.late = 0;
    for (int i = 0; i < 50; ++i) app::let_pass(state, 0);
    CHECK(state.frame == 110);
  }

  TEST_CASE("a stall of a minute is a tenth of a second of animation, and a clock set back is nothing") {
    WindowState state;
    app::let_pass(state, 60);
    CHECK(state.frame == 6);
    app::let_pass(state, -60);
    CHECK(state.frame == 6);
  }

  TEST_CASE("nothing passes while paused") {
    WindowState state;
    press(state, "Space");
    app::let_pass(state, 1);
    CHECK(state.frame == 0);
  }

  TEST_CASE(
      "Escape closes the menu, then the help, then the panel opened last, then leaves full screen, and "
      "never quits") {
    WindowState state;
    press(state, "F2");
    press(state, "F4");
    press(state, "F11");
    press(state, "F1");
    state.menu = true;
    press(state, "Escape");
    CHECK(state.close_menu);
    CHECK(state.help);
    state.menu = false;
    press(state, "Escape");
    CHECK_FALSE(state.help);
    CHECK(state.shows(app::Panel::inspect));
    press(state, "Escape");
    CHECK_FALSE(state.shows(app::Panel::inspect));
    CHECK(state.shows(app::Panel::knobs));
    press(state, "Escape");
    CHECK_FALSE(state.shows(app::Panel::knobs));
    CHECK(state.fullscreen);
    press(state, "Escape");
    CHECK_FALSE(state.fullscreen);
    press(state, "Escape");
    CHECK_FALSE(state.quit);
    press(state, "Q");
    CHECK(state.quit);
  }

  TEST_CASE("letters grow and shrink by quarters, between a half and four times, and go back") {
    WindowState state;
    press(state, "Ctrl +");
    CHECK(state.text_size == 1.25);
    for (int i = 0; i < 40; ++i) press(state, "Ctrl +");
    CHECK(state.text_size == 4);
    for (int i = 0; i < 40; ++i) press(state, "Ctrl -");
    CHECK(state.text_size == 0.5);
    press(state, "Ctrl 0");
    CHECK(state.text_size == 1);
  }

  TEST_CASE("E opens the inspector, shows its next map, and opens nothing twice") {
    WindowState state;
    press(state, "E");
    CHECK(state.shows(app::Panel::inspect));
    CHECK(state.map == app::Map::errors);
    press(state, "E");
    CHECK(state.map == app::Map::overdraw);
    CHECK(state.dock.open.size() == 1);
  }

  TEST_CASE("two pictures are drawn only for the split screen and for differences") {
    WindowState state;
    CHECK_FALSE(state.compares());
    press(state, "V");
    CHECK(state.compares());
    press(state, "V");
    press(state, "D");
    CHECK(state.compares());
  }

  TEST_CASE("no key of the console's controller is a key of the window but for camera and differences") {
    for (const auto& row : app::pad_keys) {
      CAPTURE(row.key);
      CHECK(app::is_pad_key(row.key));
      if (row.key != "D") CHECK_FALSE(app::asked_by_key(row.key));
    }
    CHECK_FALSE(app::is_pad_key("Q"));
  }

  TEST_CASE("a program that runs goes on by one frame a call, however long that took") {
    WindowState state;
    state.frame = 7;
    state.recorded = {.last = 7, .from = {}, .to = {}, .is_growing = true};
    app::let_pass(state, 1);
    CHECK(state.frame == 8);
    app::let_pass(state, 1);
    CHECK(state.frame == 8);  // which is not there yet
  }

  TEST_CASE("N makes a frame of a program that there was not, and none of one that has ended") {
    WindowState state;
    state.frame = 7;
    state.recorded = {.last = 7, .from = {}, .to = {}, .is_growing = true};
    press(state, "N");
    CHECK(state.frame == 8);
    state.frame = 7;
    state.recorded.has_ended = true;
    press(state, "N");
    CHECK(state.frame == 7);
  }

  TEST_CASE("a program that has ended rests at its last frame, and is not begun again") {
    WindowState state;
    state.frame = 6;
    state.recorded = {.last = 7, .from = {}, .to = {}, .is_growing = true, .has_ended = true};
    app::let_pass(state, 1);
    CHECK(state.frame == 7);
    CHECK(state.paused);
  }
}
