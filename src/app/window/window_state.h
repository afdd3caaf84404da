#pragma once
// What the window is showing, and what each key does to it. Pure: knows neither SDL nor drawing, so that
// every key can be tested without a screen.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/window/camera.h"
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
  fullscreen,
  screenshot,
  quit,
};

/// How fast frames come: with the screen, or at the console's NTSC or PAL rate.
enum class Pace : std::uint8_t { vsync, hz60, hz50 };

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
/// read it. Key names are SDL's (SDL_GetKeyName), button names SDL's controller strings; "" means none.
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

struct WindowState {
  int scene = 0, scenes = 1;
  scene::Knobs knobs;                                    ///< what is shown (on the left, when split)
  scene::Visibility other = scene::Visibility::zbuffer;  ///< what Tab switches to; shown on the right
  std::int64_t frame = 0;                                ///< the state at frame / 60 s
  double late = 0;                                       ///< seconds passed since `frame` began, below 1/60
  Pace pace = Pace::vsync;
  bool paused = false;
  bool split = false;
  double divider = 0.5;  ///< where the right picture begins, 0..1 of the width
  bool differences = false;
  bool help = false, panel = false, vram = false;
  bool cost = false;     ///< every other setting of the knobs is measured
  bool inspect = false;  ///< a frame is watched: history under the mouse, the first draws alone
  Map map = Map::none;   ///< with inspect
  int first_draws = -1;  ///< with inspect: only so many draws are shown; below 0: all
  bool fullscreen = false;
  bool screenshot = false;  ///< asked for; the window takes it and clears this
  bool quit = false;
  CameraOffset camera;

  /// The knobs of the other picture: the same but for the visibility mode.
  [[nodiscard]] scene::Knobs other_knobs() const;
  /// Both pictures are needed.
  [[nodiscard]] bool compares() const { return split || differences; }
};

/// Shows a mode; the other one moves out of its way, for two equal modes are nothing to compare.
void set_visibility(WindowState& state, scene::Visibility visibility);

/// Does what is asked.
void handle(WindowState& state, Asked asked);

/// Lets `seconds` of real time pass, unless paused: vsync counts 60 frames of animation a second, a fixed
/// pace one of 60 or 1.2 per call. A stall (a moved or minimised window) counts as a tenth of a second.
void let_pass(WindowState& state, double seconds);

}  // namespace app
