#pragma once
// Frames of a program that only sends words: where one begins and ends, and which picture is shown, when a
// z-buffer or an accurate target stands in for the console's frame buffer.

#include <array>
#include <cstdint>
#include <optional>

#include "base/picture.h"
#include "base/result.h"
#include "gpu/gpu.h"
#include "machine/present.h"
#include "scene/knobs.h"

namespace door {

/// A canvas lies over the buffer that is being drawn: over the display area of which the drawing area's
/// corner is a part, or at that corner. A frame ends when the program turns to another buffer, or at a
/// vertical blank that shows the one it has drawn; it then waits to be shown. Without a canvas a frame lasts
/// from one vertical blank to the next.
class Frames {
 public:
  [[nodiscard]] const scene::Knobs& knobs() const { return knobs_; }
  /// Error: a frame would need more than scene::canvas_limit_bytes.
  base::Result<void> use(const scene::Knobs& knobs, gpu::Gpu& gpu);

  /// Whether before_words() must be called where the drawing area changes.
  [[nodiscard]] bool has_canvas() const { return has_canvas_; }
  /// Before words are drawn.
  void before_words(gpu::Gpu& gpu);
  void vblank(gpu::Gpu& gpu);
  /// The GPU was given another state: a canvas begins its frame anew.
  void jump(gpu::Gpu& gpu);
  [[nodiscard]] base::Picture picture(gpu::Gpu& gpu);

 private:
  struct Place {
    int x = 0, y = 0;
    bool operator==(const Place&) const = default;
  };
  struct Shown {
    Place place;
    base::Picture picture;
  };

  void set_targets(gpu::Gpu& gpu);
  [[nodiscard]] Place place_of_drawing(const gpu::Gpu& gpu) const;
  void finish(gpu::Gpu& gpu);
  void begin(gpu::Gpu& gpu, Place place);

  scene::Knobs knobs_;
  machine::Presenter presenter_;
  bool has_canvas_ = false;
  int width_ = 0, height_ = 0;
  Place place_;
  bool has_begun_ = false;
  std::array<Place, 2> starts_{};              // the last two display areas, the newest first
  std::array<std::optional<Shown>, 2> shown_;  // finished frames, the newest first
};

}  // namespace door
