#include "app/window/show.h"

#include <cstdio>
#include <utility>

#include "base/message.h"
#include "display/compare.h"

namespace app {
namespace {

constexpr base::Rgba mark{0xff, 0x4c, 0xb0, 0xff};

// Times jump from frame to frame; a tenth of the new one is enough to follow and slow enough to read.
void smooth(double& shown, double measured) { shown += (measured - shown) * 0.1; }

void follow(scene::FrameStats& shown, const scene::FrameStats& measured) {
  const auto before = std::exchange(shown, measured);
  if (before.faces == 0) return;
  shown.gte_ms = before.gte_ms;
  shown.ot_ms = before.ot_ms;
  shown.raster_ms = before.raster_ms;
  smooth(shown.gte_ms, measured.gte_ms);
  smooth(shown.ot_ms, measured.ot_ms);
  smooth(shown.raster_ms, measured.raster_ms);
}

}  // namespace

base::Result<void> Show::change_scene(const WindowState& state) {
  const auto& entry = scenes_[static_cast<std::size_t>(state.scene)];
  scene_ = state.scene;  // also when it fails: it would fail again
  auto subject = entry.make(state.knobs);
  if (!subject) return tl::make_unexpected(subject.error());
  name_ = entry.name;
  other_.reset();
  shown_ = std::move(*subject);
  for (const auto& line : shown_->report()) base::warn("otter: " + name_, line);
  stats_ = {};
  return {};
}

base::Result<bool> Show::update(const WindowState& state) {
  const Asked asked{state.scene,  state.frame,      state.knobs,      state.other_knobs(),
                    state.camera, state.compares(), state.differences};
  if (asked == drawn_ && !(shown_ && shown_->is_behind())) return false;
  drawn_ = asked;
  if (state.scene != scene_) {
    if (auto changed = change_scene(state); !changed) return tl::make_unexpected(changed.error());
  }
  if (!shown_) return false;
  auto stats = shown_->draw(state.frame, asked.knobs, state.camera);
  if (!stats) return tl::make_unexpected(stats.error());
  follow(stats_, *stats);
  left_ = shown_->picture();
  different_.reset();
  if (!asked.compares) {
    other_.reset();
    return true;
  }
  if (!other_) other_ = shown_->another(asked.other);
  if (auto drawn = other_->draw(state.frame, asked.other, state.camera); !drawn) {
    return tl::make_unexpected(drawn.error());
  }
  right_ = other_->picture();
  different_ = display::count_different(left_, right_);
  if (state.differences && left_.width == right_.width && left_.height == right_.height) {
    auto marked = display::mark_different(left_, right_, mark);
    right_ = display::mark_different(right_, left_, mark);
    left_ = std::move(marked);
  }
  return true;
}

}  // namespace app
