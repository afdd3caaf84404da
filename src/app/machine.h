#pragma once
// A scene and the console that draws it: main RAM, GPU and the builder of its frames. The one place where the
// program turns "scene, frame number, knobs" into a picture.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/window/camera.h"
#include "base/picture.h"
#include "gpu/gpu.h"
#include "machine/present.h"
#include "ot/main_ram.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace app {

class Machine {
 public:
  /// Packs the scene's textures; what does not fit as it is stands in report().
  Machine(scene::Scene scene, const scene::Knobs& knobs);
  Machine(const Machine&) = delete;  // the builder refers to the scene
  Machine& operator=(const Machine&) = delete;

  /// Draws the state at frame / 60 s, seen from the scene's camera moved by `camera`.
  /// A frame that temporal accumulation cannot continue from the last one draws the frames before it first.
  /// Error: knobs that cannot be met, a frame that does not fit into RAM, a polygon without depth.
  base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera = {});

  /// From the next draw() on every pixel written is noted in `trace`, until nullptr ends it.
  void watch(gpu::Trace* trace) { gpu_.set_trace(trace); }

  /// What the display shows after draw().
  [[nodiscard]] const base::Picture& picture() const { return picture_; }

  /// Moves `camera` by `step` in the axes of the picture last drawn (see app::fly).
  void fly(CameraOffset& camera, glm::vec3 step) const;

  /// The rows of scene::knob_table() whose settings draw the frame with more samples than VRAM has pixels:
  /// then nothing is noted.
  [[nodiscard]] std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& knobs) const;
  /// VRAM after draw(), 1024 x 512. A frame drawn on a canvas that can be watched is in it, in 16 bits.
  [[nodiscard]] std::vector<std::uint16_t> vram() const;
  /// The scene with its own animation: a second machine may be made from it.
  [[nodiscard]] scene::Scene scene_as_given() const;
  [[nodiscard]] const std::vector<std::string>& report() const { return builder_->report(); }
  [[nodiscard]] const gpu::Gpu& gpu() const { return gpu_; }

 private:
  scene::Scene scene_;
  std::function<void(scene::World&, double)> animate_;  // the scene's own
  CameraOffset offset_;
  scene::Camera base_;  // the scene's own camera at the frame last drawn
  // Of the first frame: a pivot that moved with every frame would make the camera swim.
  float pivot_distance_ = 1;
  ot::MainRam ram_{ot::RamSize::mib8};
  gpu::Gpu gpu_;
  machine::Presenter presenter_;
  base::Picture picture_;
  std::int64_t last_frame_ = -1;  // drawn with last_knobs_
  scene::Knobs last_knobs_;
  std::unique_ptr<scene::FrameBuilder> builder_;
};

}  // namespace app
