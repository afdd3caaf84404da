#pragma once
// The window's state and a program that runs in an emulator, kept in step.

#include <string>

#include "app/live.h"
#include "app/window/window_state.h"

namespace app {

class LiveFollower {
 public:
  /// Takes what the program has sent; at rest its last frames are gone through. Tells the program what was
  /// asked for in `state`, which is left when it ends. What is wrong with what it sends; empty: nothing.
  std::string follow(Live& live, WindowState& state);

 private:
  std::string tell(LiveLink& link, WindowState& state);

  struct {
    bool paused = false, fast = false;
    Pace pace = Pace::vsync;
  } told_;
  bool is_stepping_ = false;  // it was asked for one more frame
};

}  // namespace app
