#include "sdk/program_subject.h"

#include <algorithm>

#include "app/source.h"

namespace sdk {
namespace {

// Less than two frames at 60 Hz: then the window draws, and asks again.
constexpr int patience_ms = 30;

std::uint32_t number_of(std::int64_t frame) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(frame, 1, 1'000'000'000));
}

}  // namespace

base::Result<scene::FrameStats> ProgramSubject::draw(std::int64_t frame, const scene::Knobs& knobs,
                                                     const app::CameraOffset& /*camera*/) {
  const auto there = run_->go_to(number_of(frame), patience_ms);
  is_behind_ = there && !*there;
  if (!there) return tl::make_unexpected(there.error());
  if (is_behind_) return stats_;
  const bool is_over = run_->has_ended() && number_of(frame) >= run_->last();
  const auto* shown = run_->frame_drawn(std::min(number_of(frame), std::max(run_->last(), 1U)));
  if (shown == nullptr) {
    why_empty_ = run_->ending();
    return stats_;
  }
  const auto drawn = show(shown->clip, knobs);
  if (!drawn) return drawn;
  stats_ = *drawn;
  if (is_over) why_empty_ = run_->ending();
  return stats_;
}

base::Result<debug::Clip> ProgramSubject::clip(std::int64_t frame, const scene::Knobs& /*knobs*/,
                                               const app::CameraOffset& /*camera*/) {
  const auto* held = run_->frame_drawn(std::min(number_of(frame), std::max(run_->last(), 1U)));
  return held == nullptr ? debug::Clip{} : held->clip;
}

std::unique_ptr<app::Subject> ProgramSubject::another(const scene::Knobs& /*knobs*/) const {
  return std::make_unique<ProgramSubject>(run_, shown_);
}

std::unique_ptr<app::Subject> ProgramSubject::apart(std::int64_t frame, const scene::Knobs& knobs) {
  return std::make_unique<app::ClipSubject>(*clip(frame, knobs, {}));
}

std::optional<std::int64_t> ProgramSubject::last_frame() const {
  return std::max<std::int64_t>(run_->last(), 1);
}

std::string ProgramSubject::why_idle(const scene::KnobInfo& knob) const {
  return app::applies_to_recordings(knob.name)
             ? std::string()
             : "a program sends packets, and keeps the world they come from to itself";
}

}  // namespace sdk
