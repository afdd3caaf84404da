#pragma once
// What is shown: the display area of VRAM, or the canvas that was drawn beside it, and the filters that work
// on finished pictures.

#include "base/picture.h"
#include "gpu/canvas/resolve.h"
#include "gpu/gpu.h"
#include "scene/knobs.h"

namespace machine {

/// Keeps what temporal accumulation needs from frame to frame; with other knobs it holds nothing.
class Presenter {
 public:
  /// The picture of the frame just drawn with `knobs`. The display area of VRAM where the knobs ask for no
  /// canvas; otherwise the canvas, `resolution` times as wide and high.
  [[nodiscard]] base::Picture show(const gpu::Gpu& gpu, const scene::Knobs& knobs);
  /// A picture that is scanned out already, with the filters for pictures without a canvas.
  [[nodiscard]] static base::Picture show(base::Picture scanned, const scene::Knobs& knobs);
  /// Frames to draw and show before one that stands alone: temporal accumulation needs its history.
  [[nodiscard]] static int frames_before(const scene::Knobs& knobs);
  void forget() { accumulator_.forget(); }
  [[nodiscard]] std::uint64_t bytes() const { return accumulator_.bytes(); }

 private:
  gpu::canvas::Accumulator accumulator_;
};

}  // namespace machine
