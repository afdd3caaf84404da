#pragma once
// A program as the window shows it: frames as they come, and any before them again.

#include <memory>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/tape.h"
#include "sdk/program_run.h"

namespace sdk {

class ProgramSubject final : public app::Subject {
 public:
  /// All that another() makes share the run.
  ProgramSubject(std::shared_ptr<ProgramRun> run, app::Shown shown) : run_(std::move(run)), shown_(shown) {}

  /// A frame that draws nothing shows the one before it that does. In z-buffer mode, or on a canvas, the
  /// frame alone is drawn so, over what the console left of the frames before it.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const app::CameraOffset& camera) override;
  void watch(gpu::Trace* trace) override { trace_ = trace; }
  [[nodiscard]] const base::Picture& picture() const override { return picture_; }
  [[nodiscard]] std::vector<std::uint16_t> vram() const override { return app::vram_of(gpu_); }
  [[nodiscard]] const gpu::Gpu& gpu() const override { return gpu_; }
  [[nodiscard]] display::Area area() const override { return app::shown_area(gpu_, shown_); }
  base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                 const app::CameraOffset& camera) override;
  [[nodiscard]] std::unique_ptr<app::Subject> another(const scene::Knobs& knobs) const override;
  [[nodiscard]] std::unique_ptr<app::Subject> apart(std::int64_t frame, const scene::Knobs& knobs) override;
  [[nodiscard]] bool is_recording() const override { return true; }
  [[nodiscard]] std::optional<std::int64_t> last_frame() const override;
  [[nodiscard]] bool is_growing() const override { return true; }
  [[nodiscard]] bool has_ended() const override { return run_->has_ended(); }
  [[nodiscard]] bool is_behind() const override { return is_behind_; }
  [[nodiscard]] double progress() const override { return run_->progress(); }
  [[nodiscard]] bool wants_pad() const override { return true; }
  void hold(const app::PadHeld& pad) override;
  base::Result<std::string> record(const std::string& path) override { return run_->record(path); }
  [[nodiscard]] std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& knobs) override {
    return app::unwatched_of_clips(knobs);
  }
  [[nodiscard]] std::string why_idle(const scene::KnobInfo& knob) const override;
  [[nodiscard]] std::string why_empty() const override { return why_empty_; }

 private:
  std::shared_ptr<ProgramRun> run_;
  app::Shown shown_;
  gpu::Trace* trace_ = nullptr;
  gpu::Gpu gpu_;  // as the frame left it
  base::Picture picture_{320, 240};
  scene::FrameStats stats_;
  std::string why_empty_;
  bool is_behind_ = false;
};

}  // namespace sdk
