#include "app/window/live_follower.h"

#include <algorithm>
#include <utility>

namespace app {

std::string LiveFollower::follow(Live& live, WindowState& state) {
  const auto before = live.reel().last();
  live.take_frames();
  auto& reel = live.reel();
  state.live.is_live = true;
  state.live.is_recording = live.is_recording_program();
  state.recorded.first = reel.first();
  state.recorded.last = reel.last();
  const int go = std::exchange(state.live.go, 0);
  auto* link = live.link();
  if (!state.paused || (is_stepping_ && reel.last() > before)) {
    state.frame = reel.last();
    is_stepping_ = false;
  } else if (go < 0) {
    state.frame = reel.before(state.frame);
  } else if (go > 0 && state.frame < reel.last()) {
    state.frame = reel.after(state.frame);
  } else if (go > 0 && link != nullptr) {
    is_stepping_ = true;
    link->ask(door::LiveAsk::step);
  }
  state.frame = std::clamp(state.frame, reel.first(), reel.last());
  return link != nullptr ? tell(*link, state) : std::string();
}

std::string LiveFollower::tell(LiveLink& link, WindowState& state) {
  using door::LiveAsk;
  if (std::exchange(told_.paused, state.paused) != state.paused) link.ask(LiveAsk::pause, state.paused);
  if (std::exchange(told_.fast, state.live.fast) != state.live.fast) link.ask(LiveAsk::fast, state.live.fast);
  if (std::exchange(told_.pace, state.pace) != state.pace)
    link.ask(LiveAsk::pace, static_cast<std::uint32_t>(state.pace));
  for (const auto& key : std::exchange(state.live.keys, {}))
    link.ask(key.is_down ? LiveAsk::key_down : LiveAsk::key_up, key.keysym);
  if (!link.has_ended()) {
    if (state.quit) link.ask(LiveAsk::close_program);
    return {};
  }
  auto error = link.error();
  if (error.empty()) state.quit = true;  // with the program
  return error;
}

}  // namespace app
