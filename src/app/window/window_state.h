#pragma once
// What the window is showing, and what each key does to it. Pure: knows neither SDL nor drawing, so that
// every key can be tested without a screen.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/window/camera.h"
#include "app/window/dock.h"
#include "debug/edits.h"
#include "debug/frame_view.h"
#include "display/vram_picture.h"
#include "scene/knobs.h"

namespace app {

/// What a key can ask for.
enum class KeyAction : std::uint8_t {
  switch_visibility,  ///< the ordering table and the other mode (the z-buffer) change places
  next_visibility,    ///< ot, sorted, bsp, zbuffer, ot ...
  split,
  differences,
  fewer_buckets,
  more_buckets,
  next_key,
  next_depth,
  pause,
  next_frame,
  previous_frame,
  next_pace,
  camera_home,
  select_scene,  ///< the argument is its index
  next_scene,
  previous_scene,
  help,
  knobs,
  vram,
  inspect,
  next_map,
  cost,
  table,
  next_command,
  previous_command,
  next_group,  ///< of commands: a bucket, or what is drawn between two changes of the state
  previous_group,
  next_wrong,
  all_commands,
  hide,
  solo,
  loop,
  fast,          ///< live program: as fast as it can, or at its pace
  program_keys,  ///< live program: it gets all keys but the function keys, or those that mean nothing here
  larger_text,
  smaller_text,
  usual_text,
  close,  ///< the menu, the help, the panel opened last, or full screen, whichever comes first
  fullscreen,
  save_picture,
  save_window,
  record,  ///< of a program: begins or ends a recording
  quit,
};

/// How fast frames come: with the screen, at the console's NTSC or PAL rate, or a tenth of the former.
enum class Pace : std::uint8_t { vsync, hz60, hz50, slow };
inline constexpr std::array<std::string_view, 4> pace_words{"vsync", "60", "50", "slow"};  ///< of --pace

/// How large letters are, times what the display asks for.
inline constexpr double smallest_text = 0.5, largest_text = 4;

/// What an inspected frame shows in place of its picture.
enum class Map : std::uint8_t {
  none,
  errors,    ///< wrong pixels in the colours of their causes
  overdraw,  ///< how often each pixel was drawn
  owners,    ///< a colour for each draw
  truth,     ///< the picture as it should be
  depth,     ///< 1/z of what should be seen
};
inline constexpr std::array map_names{"picture",     "errors by cause", "overdraw",
                                      "who drew it", "truth",           "true depth"};

/// One row of the key table: the keyboard, the game controller, the help overlay and `otter run --help` all
/// read it. Key names are SDL's (SDL_GetKeyName), "Ctrl " or "Shift " before them where these are held;
/// button names are SDL's controller strings; "" means none.
struct Binding {
  KeyAction action;
  std::string_view key, other_key;
  std::string_view button;
  std::string_view does;
};
std::span<const Binding> bindings();

/// What is held or dragged rather than pressed: only shown in the help.
struct Gesture {
  std::string_view how, does;
};
std::span<const Gesture> gestures();

struct Asked {
  KeyAction action;
  int argument = 0;
};
/// What a key or button asks for, if anything. "1" .. "9" select a scene.
std::optional<Asked> asked_by_key(std::string_view key);
std::optional<Asked> asked_by_button(std::string_view button);

/// The help as text, one line a key, as --help prints it.
std::string key_help();

/// Which way and how far commands are stepped over.
enum class StepBy : std::uint8_t { command, group, wrong };
struct Step {
  StepBy by = StepBy::command;
  bool is_forward = true;
};

/// What is looked at in a frame, command by command. Items are indices into debug::Clip::items.
struct LensState {
  debug::Filter filter;
  std::optional<std::size_t> selected;       ///< item
  std::optional<std::uint32_t> pinned;       ///< VRAM pixel y * 1024 + x, whose history stays on the screen
  std::optional<std::uint32_t> open_bucket;  ///< or group, of a list without buckets
  std::optional<std::size_t> shown;          ///< only so many rows are drawn; nothing: all
  debug::Edits edits;
  std::optional<Step> step;  ///< asked for; the window takes it
};

/// How VRAM is shown.
struct VramState {
  display::VramFormat format = display::VramFormat::bits15;
  display::Palette palette;
  double zoom = 1, x = 0, y = 0;  ///< 1: all of it; VRAM pixel at the top left corner
  bool grid = true;               ///< of texture pages
};

/// A program that runs elsewhere.
struct LiveState {
  bool is_live = false;
  bool fast = false, program_keys = false;
  bool is_recording = false;  ///< told by the program
  int go = 0;                 ///< frames to go while it waits, asked for; the window does it and clears this
  struct Key {
    std::uint32_t keysym = 0;  ///< X11's
    bool is_down = false;
  };
  std::vector<Key> keys;  ///< for the program; the window hands them on and clears this
};

/// Frames of a recording; of a scene there are none.
struct Recorded {
  std::int64_t first = 1;                ///< that there still is: of a live program not the first it had
  std::int64_t last = 0;                 ///< 0: it is a scene
  std::optional<std::int64_t> from, to;  ///< the loop, ends included
  bool is_growing = false;               ///< frames are made behind the last
  bool has_ended = false;                ///< no more of them
  bool wants_pad = false;                ///< the keys of app::pad_keys are the program's
  /// The last frame that can be asked for.
  [[nodiscard]] std::int64_t furthest() const {
    constexpr std::int64_t anywhere = 1'000'000'000;
    return is_growing && !has_ended ? anywhere : last;
  }
  [[nodiscard]] std::int64_t first_played() const { return from.value_or(first); }
  [[nodiscard]] std::int64_t last_played() const { return to.value_or(last); }
};

struct Point {
  int x = 0, y = 0;
};

struct WindowState {
  int scene = 0, scenes = 1;
  scene::Knobs knobs;                                    ///< what is shown (on the left, when split)
  scene::Visibility other = scene::Visibility::zbuffer;  ///< what Tab switches to; shown on the right
  std::int64_t frame = 0;                                ///< the state at frame / 60 s; of a recording from 1
  double late = 0;                                       ///< seconds passed since `frame` began, below 1/60
  Pace pace = Pace::vsync;
  bool paused = false;
  bool split = false;
  double divider = 0.5;  ///< where the right picture begins, 0..1 of the width
  bool differences = false;
  bool help = false;
  Dock dock;             ///< the panels
  double text_size = 1;  ///< times what the display asks for
  Map map = Map::none;   ///< with the inspector
  int first_draws = -1;  ///< with the inspector: only so many draws are shown; below 0: all
  LensState lens;
  VramState vram;
  Recorded recorded;
  LiveState live;
  std::optional<Point> clicked;  ///< a place in the window that was clicked; the window takes it
  bool fullscreen = false;
  bool menu = false;          ///< a menu of a panel is open; told by the window
  bool close_menu = false;    ///< asked for; the window does it and clears this
  bool save_picture = false;  ///< asked for, likewise
  bool save_window = false;   ///< asked for, likewise
  bool record = false;        ///< asked for, likewise
  bool quit = false;
  CameraOffset camera;

  /// The knobs of the other picture: the same but for the visibility mode.
  [[nodiscard]] scene::Knobs other_knobs() const;
  /// Both pictures are needed.
  [[nodiscard]] bool compares() const { return split || differences; }
  [[nodiscard]] bool shows(Panel panel) const { return dock.is_open(panel); }
};

/// Shows a mode; the other one moves out of its way, for two equal modes are nothing to compare.
void set_visibility(WindowState& state, scene::Visibility visibility);

/// Does what is asked.
void handle(WindowState& state, Asked asked);

/// Goes to a frame, at rest.
void pause_at(WindowState& state, std::int64_t frame);

/// Lets `seconds` of real time pass, unless paused or in a live program, which has its own: vsync counts 60
/// frames a second, a fixed pace one per call, or of a scene at 50 Hz 1.2. A recording begins again behind
/// its last frame, or behind that of the loop; a program that is run again and again goes on by one frame a
/// call at most, and rests when it has ended. A stall (a moved or minimised window) counts as a tenth of a
/// second.
void let_pass(WindowState& state, double seconds);

}  // namespace app
