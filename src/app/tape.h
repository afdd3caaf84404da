#pragma once
// A recording as the window shows it: any frame of a dump, or the one list of a saved RAM image.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/subject.h"
#include "debug/clip.h"
#include "debug/timeline.h"
#include "display/scanout.h"
#include "machine/canvas_place.h"

namespace app {

/// Which rectangle of VRAM is the picture: what the display shows, or what is drawn to. A program with two
/// buffers shows the one while it draws the other.
enum class Shown : std::uint8_t {
  either,  ///< the display's, unless the frame draws beside it
  drawn,
  display,
};

/// What a recording has of its own: an order, not a rule to make one. Error: another than ot or zbuffer.
base::Result<void> check_visibility(const scene::Knobs& knobs);
/// "drawn", "display"; anything else is either.
Shown shown_named(std::string_view name);

/// Where the picture of `gpu` lies. A drawing area much smaller than the screen is a texture, and no picture.
display::Area shown_area(const gpu::Gpu& gpu, Shown shown);

/// A clip as it was drawn.
struct DrawnClip {
  scene::FrameStats stats;
  gpu::FrameEnd end;                      ///< of a z-buffer
  std::optional<machine::Corner> canvas;  ///< where in VRAM the canvas lies, if the knobs ask for one
};
/// Draws a clip as the knobs say, on a canvas where they ask for one. Error: knobs that a recording cannot
/// meet, a canvas that is too large.
base::Result<DrawnClip> draw_clip(const debug::Clip& clip, const scene::Knobs& knobs, gpu::Gpu& gpu,
                                  gpu::Trace* trace);
/// Whether all of `area` lies on its canvas.
bool is_on_canvas(const DrawnClip& drawn, const gpu::Gpu& gpu, const display::Area& area);
/// What `area` shows of it: the canvas where it lies there, or VRAM. An empty area is a black picture.
base::Picture picture_of_clip(const DrawnClip& drawn, const gpu::Gpu& gpu, const display::Area& area,
                              const scene::Knobs& knobs);
/// Whether the knobs ask for more samples, bits or fractions than VRAM has.
bool asks_for_canvas(const scene::Knobs& knobs);

/// What is drawn from clips: a recording, or a program that runs.
class ClipDrawer : public Subject {
 public:
  void watch(gpu::Trace* trace) override { trace_ = trace; }
  [[nodiscard]] const base::Picture& picture() const override { return picture_; }
  /// With the canvas in 16 bits where it can be watched.
  [[nodiscard]] std::vector<std::uint16_t> vram() const override;
  [[nodiscard]] const gpu::Gpu& gpu() const override { return gpu_; }
  [[nodiscard]] display::Area area() const override { return shown_area(gpu_, shown_); }
  [[nodiscard]] bool is_recording() const override { return true; }
  [[nodiscard]] std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& knobs) override;
  [[nodiscard]] std::string why_idle(const scene::KnobInfo& knob) const override;
  [[nodiscard]] std::string why_empty() const override { return why_empty_; }

 protected:
  explicit ClipDrawer(Shown shown) : shown_(shown) {}
  /// Draws the clip and makes the picture of it.
  base::Result<scene::FrameStats> show(const debug::Clip& clip, const scene::Knobs& knobs);
  /// Makes the picture of what gpu_ has drawn.
  void show(const DrawnClip& drawn, const scene::Knobs& knobs);

  Shown shown_;
  gpu::Trace* trace_ = nullptr;
  gpu::Gpu gpu_;  // as the frame left it
  base::Picture picture_{320, 240};
  std::string why_empty_;
};

class Tape final : public ClipDrawer {
 public:
  /// `timeline` has its first frame; all tapes made by another() share it. `name`: of the file.
  Tape(std::string name, std::shared_ptr<debug::Timeline> timeline, Shown shown = Shown::either);

  /// In z-buffer mode the frame alone is drawn so, over what the console left of the frames before it.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera) override;
  base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                 const CameraOffset& camera) override;
  [[nodiscard]] std::unique_ptr<Subject> another(const scene::Knobs& knobs) const override;
  [[nodiscard]] std::unique_ptr<Subject> apart(std::int64_t frame, const scene::Knobs& knobs) override;
  [[nodiscard]] std::optional<std::int64_t> last_frame() const override;
  bool index_some(double milliseconds) override { return timeline_->index_some(milliseconds); }
  [[nodiscard]] double progress() const override { return timeline_->progress(); }
  [[nodiscard]] const debug::Timeline& timeline() const { return *timeline_; }

 private:
  [[nodiscard]] std::uint64_t within(std::int64_t frame) const;

  std::string name_;
  std::shared_ptr<debug::Timeline> timeline_;
};

/// One frame alone: what a thread of its own can measure.
class ClipSubject final : public ClipDrawer {
 public:
  explicit ClipSubject(debug::Clip clip) : ClipDrawer(Shown::either), clip_(std::move(clip)) {}
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera) override;
  base::Result<debug::Clip> clip(std::int64_t /*frame*/, const scene::Knobs& /*knobs*/,
                                 const CameraOffset& /*camera*/) override {
    return clip_;
  }
  [[nodiscard]] std::unique_ptr<Subject> another(const scene::Knobs& /*knobs*/) const override {
    return std::make_unique<ClipSubject>(clip_);
  }
  [[nodiscard]] std::unique_ptr<Subject> apart(std::int64_t /*frame*/, const scene::Knobs& knobs) override {
    return another(knobs);
  }

 private:
  debug::Clip clip_;
};

}  // namespace app
