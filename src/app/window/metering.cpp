#include "app/window/metering.h"

namespace app {
namespace {

// Of the 16 that a frame at 60 Hz has.
constexpr double measuring_ms_per_frame = 6;

}  // namespace

void Metering::update(const WindowState& state, Subject* subject) {
  const bool wanted = state.shows(Panel::cost) && subject != nullptr;
  const bool is_recording = wanted && subject->is_recording();
  is_measuring_ = false;
  if (is_recording && !state.paused) return;  // a frame is measured at rest
  const std::pair now(state.scene, is_recording ? state.frame : 0);
  if (meter_ && (!wanted || measured_ != now)) meter_->stop();
  if (meter_ && meter_->has_ended()) meter_.reset();
  if (!wanted) return;
  if (!meter_) {
    meter_ = std::make_unique<CostMeter>(subject->apart(state.frame, state.knobs));
    measured_ = now;
  }
  is_measuring_ = !state.paused || !meter_->table().is_settled();
  meter_->follow(state.frame, state.knobs, state.camera, is_measuring_ ? measuring_ms_per_frame : 0);
}

std::optional<CostTable> Metering::table(int scene) const {
  if (!meter_ || measured_.first != scene) return std::nullopt;
  return meter_->table();
}

}  // namespace app
