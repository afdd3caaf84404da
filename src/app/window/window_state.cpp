#include "app/window/window_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace app {
namespace {

constexpr std::array key_bindings{
    Binding{KeyAction::switch_visibility, "Tab", "", "a",
            "switch between the ordering table and the z-buffer"},
    Binding{KeyAction::split, "V", "", "b", "split screen: both, with a divider to drag"},
    Binding{KeyAction::differences, "D", "", "x", "show the pixels on which the two differ"},
    Binding{KeyAction::next_visibility, "M", "", "", "next mode: ot, sorted, bsp, zbuffer"},
    Binding{KeyAction::fewer_buckets, "-", "Keypad -", "dpdown", "half as many buckets"},
    Binding{KeyAction::more_buckets, "=", "Keypad +", "dpup", "twice as many buckets"},
    Binding{KeyAction::next_key, "Y", "", "", "sort by average, nearest or farthest vertex"},
    Binding{KeyAction::next_depth, "Z", "", "", "z-buffer of 16, 24, 32 bits or float"},
    Binding{KeyAction::pause, "Space", "", "y", "pause"},
    Binding{KeyAction::next_frame, "N", "", "dpright", "pause, and one frame forward"},
    Binding{KeyAction::previous_frame, "B", "", "dpleft", "pause, and one frame back"},
    Binding{KeyAction::next_pace, "P", "", "", "pace: vsync, 60 Hz, 50 Hz, slow motion"},
    Binding{KeyAction::loop, "L", "", "", "recording: loop from here; again: to here; again: no loop"},
    Binding{KeyAction::fast, "F9", "", "", "live program: as fast as it can; again: at its pace"},
    Binding{KeyAction::program_keys, "Insert", "", "",
            "live program: all keys but Insert and F1 - F12 are its own; again: those without meaning here"},
    Binding{KeyAction::camera_home, "Home", "", "rightstick", "camera back to where the scene has it"},
    Binding{KeyAction::next_scene, "PageDown", "", "rightshoulder", "next scene"},
    Binding{KeyAction::previous_scene, "PageUp", "", "leftshoulder", "previous scene"},
    Binding{KeyAction::help, "F1", "H", "start", "this help"},
    Binding{KeyAction::knobs, "F2", "K", "guide", "knobs: every approximation, live"},
    Binding{KeyAction::vram, "F3", "", "", "VRAM, live"},
    Binding{KeyAction::inspect, "F4", "I", "", "inspect: who drew a pixel, the first K draws alone"},
    Binding{KeyAction::next_map, "E", "", "",
            "inspect: next map of errors, overdraw, who drew it, truth, depth"},
    Binding{KeyAction::cost, "C", "", "", "cost: ms with each knob set otherwise, live"},
    Binding{KeyAction::table, "F5", "T", "",
            "ordering table or draw list: every command; click a pixel for its own"},
    Binding{KeyAction::next_command, ".", "", "", "one command forward: only those before are drawn"},
    Binding{KeyAction::previous_command, ",", "", "", "one command back"},
    Binding{KeyAction::next_group, "]", "", "", "one bucket, or change of state, forward"},
    Binding{KeyAction::previous_group, "[", "", "", "one bucket, or change of state, back"},
    Binding{KeyAction::next_wrong, "X", "", "", "to the next command that is seen where it should not be"},
    Binding{KeyAction::all_commands, "End", "", "", "all commands again, as they were sent"},
    Binding{KeyAction::hide, "Delete", "", "", "hide the command selected, or show it again"},
    Binding{KeyAction::solo, "O", "", "", "draw the command selected alone, or all again"},
    Binding{KeyAction::larger_text, "Ctrl +", "", "", "larger letters"},
    Binding{KeyAction::smaller_text, "Ctrl -", "", "", "smaller letters"},
    Binding{KeyAction::usual_text, "Ctrl 0", "", "", "letters as large as the display asks for"},
    Binding{KeyAction::close, "Escape", "", "back",
            "close the menu, the help, the panel opened last, or leave full screen"},
    Binding{KeyAction::fullscreen, "F11", "", "", "full screen"},
    Binding{KeyAction::save_picture, "F12", "", "",
            "save the picture, pixel for pixel, into the current folder"},
    Binding{KeyAction::save_window, "Shift F12", "", "", "save the whole window, likewise"},
    Binding{KeyAction::record, "F8", "", "", "program: record what it sends as a dump; again: stop"},
    Binding{KeyAction::quit, "Q", "", "", "quit"},
};

constexpr double text_step = 0.25;

constexpr std::array held{
    Gesture{"1 .. 9", "that scene"},
    Gesture{"Ctrl with F1 .. F12, Escape", "live program: the key is the emulator's"},
    Gesture{"arrows, left drag, left stick", "orbit round the scene"},
    Gesture{"W A S D R F (hold), triggers", "fly: forward, left, back, right, up, down"},
    Gesture{"right drag, right stick", "look round"},
    Gesture{"mouse wheel", "nearer, farther"},
    Gesture{"program: arrows, W A S D", "its pad: directions; triangle, square, cross, circle"},
    Gesture{"program: R F, U J", "its pad: L1 and L2, R1 and R2"},
    Gesture{"program: Return, Backspace", "its pad: start, select"},
};

template <class E>
void step(E& value, int count) {
  value = static_cast<E>((static_cast<int>(value) + 1) % count);
}

void toggle(bool& flag) { flag = !flag; }

void show_scene(WindowState& state, int scene) {
  if (scene < 0 || scene >= state.scenes || scene == state.scene) return;
  state.scene = scene;
  state.frame = 0;
  state.late = 0;
  state.camera = {};
  state.lens = {};
  state.recorded = {};
}

template <class Set>
void toggle_in(Set& set, std::size_t item) {
  if (!set.erase(item)) set.insert(item);
}

void go(WindowState& state, int frames) {
  state.live.go = state.paused ? frames : 0;
  state.paused = true;
}

// From here, to here, no loop.
void loop(WindowState& state) {
  auto& recorded = state.recorded;
  if (recorded.last == 0 || state.live.is_live) return;
  if (!recorded.from) {
    recorded.from = state.frame;
  } else if (!recorded.to && state.frame >= *recorded.from) {
    recorded.to = state.frame;
  } else {
    recorded.from = recorded.to = std::nullopt;
  }
}

void close_one(WindowState& state) {
  if (state.menu) {
    state.close_menu = true;
  } else if (state.help) {
    state.help = false;
  } else if (!state.dock.open.empty()) {
    state.dock.close(state.dock.open.back());
  } else {
    state.fullscreen = false;
  }
}

// Only powers of two, whatever the command line began with.
int next_power(int buckets, bool up) {
  int power = 1;
  while (power * 2 <= buckets) power *= 2;
  if (up) return std::min(power * 2, 65536);
  return std::max(power == buckets ? power / 2 : power, 1);
}

}  // namespace

std::span<const Binding> bindings() { return key_bindings; }
std::span<const Gesture> gestures() { return held; }

std::optional<Asked> asked_by_key(std::string_view key) {
  if (key.size() == 1 && key[0] >= '1' && key[0] <= '9') return Asked{KeyAction::select_scene, key[0] - '1'};
  for (const auto& row : key_bindings) {
    if (!key.empty() && (row.key == key || row.other_key == key)) return Asked{row.action};
  }
  return std::nullopt;
}

std::optional<Asked> asked_by_button(std::string_view button) {
  for (const auto& row : key_bindings) {
    if (!button.empty() && row.button == button) return Asked{row.action};
  }
  return std::nullopt;
}

std::string key_help() {
  std::string text = "Keys:\n";
  const auto line = [&text](std::string keys, std::string_view does) {
    keys.resize(std::max<std::size_t>(keys.size() + 1, 32), ' ');
    text.append("  ").append(keys).append(does).append("\n");
  };
  for (const auto& row : key_bindings) {
    std::string keys(row.key);
    if (!row.other_key.empty()) keys.append(", ").append(row.other_key);
    line(keys, row.does);
  }
  for (const auto& gesture : held) line(std::string(gesture.how), gesture.does);
  return text;
}

scene::Knobs WindowState::other_knobs() const {
  auto changed = knobs;
  changed.visibility = other;
  return changed;
}

void set_visibility(WindowState& state, scene::Visibility visibility) {
  state.knobs.visibility = visibility;
  if (state.other != visibility) return;
  state.other = visibility == scene::Visibility::zbuffer ? scene::Visibility::ot : scene::Visibility::zbuffer;
}

void handle(WindowState& state, Asked asked) {
  switch (asked.action) {
    case KeyAction::switch_visibility:
      std::swap(state.knobs.visibility, state.other);
      break;
    case KeyAction::next_visibility: {
      auto next = state.knobs.visibility;
      step(next, 4);
      set_visibility(state, next);
      break;
    }
    case KeyAction::split:
      toggle(state.split);
      break;
    case KeyAction::differences:
      toggle(state.differences);
      break;
    case KeyAction::fewer_buckets:
      state.knobs.buckets = next_power(state.knobs.buckets, false);
      break;
    case KeyAction::more_buckets:
      state.knobs.buckets = next_power(state.knobs.buckets, true);
      break;
    case KeyAction::next_key:
      step(state.knobs.key, 3);
      break;
    case KeyAction::next_depth:
      step(state.knobs.depth, 4);
      break;
    case KeyAction::pause:
      toggle(state.paused);
      break;
    case KeyAction::next_frame:
      if (state.live.is_live) return go(state, 1);
      pause_at(state, state.frame + 1);
      break;
    case KeyAction::previous_frame:
      if (state.live.is_live) return go(state, -1);
      pause_at(state, state.frame - 1);
      break;
    case KeyAction::next_pace:
      step(state.pace, static_cast<int>(pace_words.size()));
      break;
    case KeyAction::camera_home:
      state.camera = {};
      break;
    case KeyAction::select_scene:
      show_scene(state, asked.argument);
      break;
    case KeyAction::next_scene:
      show_scene(state, (state.scene + 1) % state.scenes);
      break;
    case KeyAction::previous_scene:
      show_scene(state, (state.scene + state.scenes - 1) % state.scenes);
      break;
    case KeyAction::help:
      toggle(state.help);
      break;
    case KeyAction::knobs:
      state.dock.toggle(Panel::knobs);
      break;
    case KeyAction::vram:
      state.dock.toggle(Panel::vram);
      break;
    case KeyAction::inspect:
      state.dock.toggle(Panel::inspect);
      state.map = Map::none;
      state.first_draws = -1;
      break;
    case KeyAction::next_map:
      if (!state.shows(Panel::inspect)) state.dock.raise(Panel::inspect);
      step(state.map, static_cast<int>(map_names.size()));
      break;
    case KeyAction::cost:
      state.dock.toggle(Panel::cost);
      break;
    case KeyAction::table:
      state.dock.toggle(Panel::table);
      break;
    case KeyAction::next_command:
      state.lens.step = Step{StepBy::command, true};
      break;
    case KeyAction::previous_command:
      state.lens.step = Step{StepBy::command, false};
      break;
    case KeyAction::next_group:
      state.lens.step = Step{StepBy::group, true};
      break;
    case KeyAction::previous_group:
      state.lens.step = Step{StepBy::group, false};
      break;
    case KeyAction::next_wrong:
      state.lens.step = Step{StepBy::wrong, true};
      break;
    case KeyAction::all_commands:
      state.lens.shown.reset();
      state.lens.edits = {};
      break;
    case KeyAction::hide:
      if (state.lens.selected) toggle_in(state.lens.edits.hidden, *state.lens.selected);
      break;
    case KeyAction::solo:
      if (state.lens.selected) toggle_in(state.lens.edits.solo, *state.lens.selected);
      break;
    case KeyAction::loop:
      loop(state);
      break;
    case KeyAction::fast:
      toggle(state.live.fast);
      break;
    case KeyAction::program_keys:
      toggle(state.live.program_keys);
      break;
    case KeyAction::larger_text:
      state.text_size = std::min(state.text_size + text_step, largest_text);
      break;
    case KeyAction::smaller_text:
      state.text_size = std::max(state.text_size - text_step, smallest_text);
      break;
    case KeyAction::usual_text:
      state.text_size = 1;
      break;
    case KeyAction::close:
      close_one(state);
      break;
    case KeyAction::fullscreen:
      toggle(state.fullscreen);
      break;
    case KeyAction::save_picture:
      state.save_picture = true;
      break;
    case KeyAction::save_window:
      state.save_window = true;
      break;
    case KeyAction::record:
      state.record = true;
      break;
    case KeyAction::quit:
      state.quit = true;
      break;
  }
}

void pause_at(WindowState& state, std::int64_t frame) {
  state.paused = true;
  state.late = 0;
  const bool is_recorded = state.recorded.last > 0;
  state.frame = std::max<std::int64_t>(frame, is_recorded ? state.recorded.first : 0);
  if (is_recorded) state.frame = std::min(state.frame, state.recorded.furthest());
}

void let_pass(WindowState& state, double seconds) {
  if (state.paused || state.live.is_live) return;
  constexpr double frames_per_second = 60;
  const bool is_recorded = state.recorded.last > 0;
  double frames = 0;
  switch (state.pace) {
    case Pace::vsync:
      frames = std::clamp(seconds, 0.0, 0.1) * frames_per_second;
      break;
    case Pace::hz60:
      frames = 1;
      break;
    case Pace::hz50:
      frames = is_recorded ? 1 : 1.2;
      break;
    case Pace::slow:
      frames = 0.1;
      break;
  }
  const double due = state.late * frames_per_second + frames;
  const double whole = std::floor(due + 1e-9);
  state.frame += static_cast<std::int64_t>(whole);
  state.late = std::max(due - whole, 0.0) / frames_per_second;
  if (!is_recorded) return;
  const auto& recorded = state.recorded;
  if (recorded.is_growing && !recorded.to) {
    state.frame = std::min(state.frame, recorded.last + (recorded.has_ended ? 0 : 1));
    if (recorded.has_ended && state.frame == recorded.last) state.paused = true;
    return;
  }
  const bool is_outside = state.frame < recorded.first_played() || state.frame > recorded.last_played();
  if (is_outside) state.frame = recorded.first_played();
}

}  // namespace app
