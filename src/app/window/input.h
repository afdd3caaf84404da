#pragma once
// From SDL's events to what they ask of the window's state.

#include <cstdint>
#include <vector>

#include "app/window/held_keys.h"
#include "app/window/layout.h"
#include "app/window/sdl.h"
#include "app/window/window_state.h"

namespace app {

class Subject;

class Input {
 public:
  /// Keys, buttons, closing, and the mouse where ImGui does not want it. `picture`: where the picture is.
  void take(const SDL_Event& event, double now, Rect picture, WindowState& state);

  /// Moves the camera by what was held for `passed` seconds up to `now`. `machine`
  /// may be null: no flying then.
  void move_camera(double now, double passed, const Subject* machine, WindowState& state) const;

  /// A key or a stick is held: the next frame will be another one without any event.
  [[nodiscard]] bool is_moving() const;

 private:
  void take_key(const SDL_KeyboardEvent& key, double now, WindowState& state);
  bool take_program_key(const SDL_KeyboardEvent& key, WindowState& state);
  void release_program_keys(WindowState& state);
  void take_drag(const SDL_MouseMotionEvent& motion, Rect picture, WindowState& state);
  static void take_wheel(const SDL_MouseWheelEvent& wheel, Rect picture, WindowState& state);
  void take_press(const SDL_MouseButtonEvent& button, Rect picture, const WindowState& state);
  [[nodiscard]] Motion controller_motion() const;

  enum class Drag { none, divider, orbit, look };
  Drag drag_ = Drag::none;
  Point pressed_;
  bool has_moved_ = false;  // since then: it is no click
  HeldKeys held_;
  std::vector<std::uint32_t> program_held_;  // keysyms that a live program was told to be down
  std::vector<Owned<SDL_GameController>> controllers_;
};

}  // namespace app
