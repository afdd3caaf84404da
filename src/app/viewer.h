#pragma once
// A scene seen by a user: frame numbers, and a camera that can be flown. The one place where the program
// turns "scene, frame number, knobs" into a picture.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/window/camera.h"
#include "base/picture.h"
#include "gpu/gpu.h"
#include "machine/machine.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace app {

class Viewer {
 public:
  /// Packs the scene's textures; what does not fit as it is stands in report().
  Viewer(scene::Scene scene, const scene::Knobs& knobs);
  Viewer(const Viewer&) = delete;  // the machine refers to the scene
  Viewer& operator=(const Viewer&) = delete;

  /// Draws the state at frame / 60 s, seen from the scene's camera moved by `camera`.
  /// A frame that temporal accumulation cannot continue from the last one draws the frames before it first.
  /// Error: knobs that cannot be met, a frame that does not fit into RAM, a polygon without depth.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera = {});

  /// Asked while visibility bsp seeks an order: see scene::FrameBuilder::set_keep_going.
  void set_keep_going(std::function<bool(double)> keep_going);
  /// From the next draw() on every pixel written is noted in `trace`, until nullptr ends it.
  void watch(gpu::Trace* trace) { machine_.gpu().set_trace(trace); }

  /// What the display shows after draw().
  [[nodiscard]] const base::Picture& picture() const { return machine_.picture(); }

  /// Moves `camera` by `step` in the axes of the picture last drawn (see app::fly).
  void fly(CameraOffset& camera, glm::vec3 step) const;

  /// The rows of scene::knob_table() whose settings draw the frame with more samples than VRAM has pixels:
  /// then nothing is noted.
  [[nodiscard]] std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& knobs);
  /// VRAM after draw(), 1024 x 512. A frame drawn on a canvas that can be watched is in it, in 16 bits.
  [[nodiscard]] std::vector<std::uint16_t> vram() const;
  /// The scene with its own animation: a second machine may be made from it.
  [[nodiscard]] scene::Scene scene_as_given() const;
  [[nodiscard]] const std::vector<std::string>& report() const { return builder_->report(); }
  [[nodiscard]] const gpu::Gpu& gpu() const { return machine_.gpu(); }

 private:
  scene::Scene scene_;
  std::function<void(scene::World&, double)> animate_;  // the scene's own
  CameraOffset offset_;
  scene::Camera base_;  // the scene's own camera at the frame last drawn
  // Of the first frame: a pivot that moved with every frame would make the camera swim.
  float pivot_distance_ = 1;
  std::int64_t last_frame_ = -1;  // drawn with last_knobs_
  scene::Knobs last_knobs_;
  machine::Machine machine_{scene_};
  scene::FrameBuilder* builder_;  // the machine's, last used
  std::function<bool(double)> keep_going_;
};

}  // namespace app
