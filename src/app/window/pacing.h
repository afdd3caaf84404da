#pragma once
// When the next frame of the window is due.

#include <SDL.h>

#include <chrono>

#include "app/window/window_state.h"

namespace app {

class Pacing {
 public:
  /// Turns vsync on and off with the pace.
  void follow(Pace pace, SDL_Renderer* renderer);
  /// Sleeps until the next frame is due. With vsync SDL has waited already, unless the driver does not: then
  /// 250 frames a second are enough.
  void wait();
  /// The next frame is due at once.
  void start_anew() { due_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;

  Pace pace_ = Pace::vsync;
  Clock::time_point due_ = Clock::now();
};

}  // namespace app
