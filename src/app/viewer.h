#pragma once
// A scene seen by a user: frame numbers, and a camera that can be flown. The one place where the program
// turns "scene, frame number, knobs" into a picture.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/window/camera.h"
#include "base/picture.h"
#include "gpu/gpu.h"
#include "machine/machine.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace app {

class Viewer final : public Subject {
 public:
  /// Packs the scene's textures; what does not fit as it is stands in report().
  Viewer(scene::Scene scene, const scene::Knobs& knobs);

  /// Draws the state at frame / 60 s, seen from the scene's camera moved by `camera`.
  /// A frame that temporal accumulation cannot continue from the last one draws the frames before it first.
  /// Error: knobs that cannot be met, a frame that does not fit into RAM, a polygon without depth.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera) override;
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs) {
    return draw(frame, knobs, {});
  }

  /// Asked while visibility bsp seeks an order: see scene::FrameBuilder::set_keep_going.
  void set_keep_going(std::function<bool(double)> keep_going);
  void watch(gpu::Trace* trace) override { machine_.gpu().set_trace(trace); }

  [[nodiscard]] const base::Picture& picture() const override { return machine_.picture(); }
  /// A frame drawn on a canvas that can be watched is in it, in 16 bits.
  [[nodiscard]] std::vector<std::uint16_t> vram() const override;
  [[nodiscard]] const gpu::Gpu& gpu() const override { return machine_.gpu(); }
  /// The list in RAM, of several the first. Origins are "iI/fF", instance and face of it, and "/pP" for the
  /// pieces of a face after its first.
  base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                 const CameraOffset& camera) override;

  [[nodiscard]] std::unique_ptr<Subject> another(const scene::Knobs& knobs) const override;
  [[nodiscard]] std::unique_ptr<Subject> apart(std::int64_t frame, const scene::Knobs& knobs) override;
  void fly(CameraOffset& camera, glm::vec3 step) const override;
  [[nodiscard]] std::optional<CameraPlace> place(const CameraOffset& camera) const override {
    return place_of(base_, camera, pivot_distance_);
  }
  [[nodiscard]] std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& knobs) override;
  /// The scene with its own animation: a second machine may be made from it.
  [[nodiscard]] scene::Scene scene_as_given() const;
  [[nodiscard]] std::vector<std::string> report() const override { return builder_->report(); }
  [[nodiscard]] std::string why_empty() const override;

 private:
  void name_origins(debug::Clip& clip, double seconds, const scene::Knobs& knobs);

  scene::Scene scene_;
  std::function<void(scene::World&, double)> animate_;  // the scene's own
  CameraOffset offset_;
  scene::Camera base_;  // the scene's own camera at the frame last drawn
  // Of the first frame: a pivot that moved with every frame would make the camera swim.
  float pivot_distance_ = 1;
  std::int64_t last_frame_ = -1;  // drawn with last_knobs_
  scene::Knobs last_knobs_;
  scene::FrameStats last_stats_;
  machine::Machine machine_{scene_};
  scene::FrameBuilder* builder_;  // the machine's, last used
  std::function<bool(double)> keep_going_;
};

}  // namespace app
