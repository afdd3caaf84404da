#pragma once
// A program as the window shows it: frames as they come, and any before them again.

#include <memory>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/tape.h"
#include "sdk/program_run.h"

namespace sdk {

class ProgramSubject final : public app::ClipDrawer {
 public:
  /// All that another() makes share the run.
  ProgramSubject(std::shared_ptr<ProgramRun> run, app::Shown shown)
      : ClipDrawer(shown), run_(std::move(run)) {}

  /// A frame that draws nothing shows the one before it that does. In z-buffer mode, or on a canvas, the
  /// frame alone is drawn so, over what the console left of the frames before it.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const app::CameraOffset& camera) override;
  base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                 const app::CameraOffset& camera) override;
  [[nodiscard]] std::unique_ptr<app::Subject> another(const scene::Knobs& knobs) const override;
  [[nodiscard]] std::unique_ptr<app::Subject> apart(std::int64_t frame, const scene::Knobs& knobs) override;
  [[nodiscard]] std::optional<std::int64_t> last_frame() const override;
  [[nodiscard]] bool is_growing() const override { return true; }
  [[nodiscard]] bool has_ended() const override { return run_->has_ended(); }
  [[nodiscard]] bool is_behind() const override { return is_behind_; }
  [[nodiscard]] double progress() const override { return run_->progress(); }
  [[nodiscard]] bool wants_pad() const override { return true; }
  void hold(const app::PadHeld& pad) override { run_->hold(pad); }
  base::Result<std::string> record(const std::string& path) override { return run_->record(path); }
  [[nodiscard]] std::string why_idle(const scene::KnobInfo& knob) const override;

 private:
  std::shared_ptr<ProgramRun> run_;
  scene::FrameStats stats_;
  bool is_behind_ = false;
};

}  // namespace sdk
