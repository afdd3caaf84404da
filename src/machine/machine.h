#pragma once
// A scene and the console that draws it, put together once: main RAM, GPU, the builders of its frames and
// what shows them.

#include <array>
#include <map>
#include <memory>

#include "base/picture.h"
#include "gpu/gpu.h"
#include "machine/present.h"
#include "ot/main_ram.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace machine {

class Machine {
 public:
  /// Whoever draws: `scene` must outlive this, and may change its animation, but nothing else.
  explicit Machine(const scene::Scene& scene) : scene_(scene) {}
  Machine(const Machine&) = delete;  // builders refer to the scene
  Machine& operator=(const Machine&) = delete;

  /// The builder for the picture size and the pieces that `knobs` ask for, its textures in VRAM. Made when
  /// first asked for, since packing textures takes long, and kept.
  scene::FrameBuilder& builder(const scene::Knobs& knobs);

  /// Draws the state of the world at `seconds` and shows it. Error: knobs that cannot be met, a frame that
  /// does not fit into RAM, a polygon without depth.
  base::Result<scene::FrameStats> draw(double seconds, const scene::Knobs& knobs);
  /// Filters and scans out what was drawn.
  void show(const scene::Knobs& knobs) { picture_ = presenter_.show(gpu_, knobs); }

  /// What show() and draw() made.
  [[nodiscard]] const base::Picture& picture() const { return picture_; }

  [[nodiscard]] ot::MainRam& ram() { return ram_; }
  [[nodiscard]] gpu::Gpu& gpu() { return gpu_; }
  [[nodiscard]] const gpu::Gpu& gpu() const { return gpu_; }
  [[nodiscard]] Presenter& presenter() { return presenter_; }

 private:
  const scene::Scene& scene_;
  ot::MainRam ram_{ot::RamSize::mib8};
  gpu::Gpu gpu_;
  std::map<std::array<int, 3>, std::unique_ptr<scene::FrameBuilder>> builders_;  // by width, height, pieces
  const scene::FrameBuilder* uploaded_ = nullptr;                                // whose textures VRAM holds
  Presenter presenter_;
  base::Picture picture_;
};

}  // namespace machine
