#pragma once
// One frame, watched while it is drawn: who wrote each pixel, and the picture after any number of draws.
// Lives only while the window inspects, on a machine of its own, so that the frames shown pay nothing.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/window/window_state.h"
#include "base/picture.h"
#include "display/scanout.h"
#include "gpu/trace.h"
#include "inspect/report.h"

namespace app {

class Inspection {
 public:
  /// `like`: the machine whose scene is watched.
  explicit Inspection(const Subject& like, const scene::Knobs& knobs);

  /// Draws the frame of `state` again if it is another one. False: it is the same.
  base::Result<bool> update(const WindowState& state);

  /// The knobs that make the frame one of more samples than VRAM has pixels, where nothing is noted: without
  /// them there is something to tell. Empty: the frame was watched.
  [[nodiscard]] const std::vector<const scene::KnobInfo*>& unwatched() const { return unwatched_; }

  /// Draws that wrote a pixel, in the order made; a z-buffer's second pass counts again.
  [[nodiscard]] int draws() const { return static_cast<int>(begins_.size()); }
  /// The picture when the first `count` of them were made.
  [[nodiscard]] base::Picture after(int count) const;
  /// The draw number `at`, 0 .. draws() - 1, in words.
  [[nodiscard]] std::string draw_text(int at) const;
  /// Which pixels are wrong and why. Judged when first asked for after update().
  [[nodiscard]] const inspect::Report& report() const;
  /// What happened at a pixel of the picture, a line an event, and what it should show.
  [[nodiscard]] std::vector<std::string> history(int x, int y) const;
  /// The frame seen as `map`; Map::none is its picture.
  [[nodiscard]] base::Picture map(Map map) const;

 private:
  std::unique_ptr<Subject> machine_;
  gpu::Trace trace_;
  std::vector<std::size_t> begins_;  // where in the history each draw begins
  std::vector<const scene::KnobInfo*> unwatched_;
  std::int64_t frame_ = -1;
  scene::Knobs knobs_;
  CameraOffset camera_;
  mutable std::optional<inspect::Report> report_;
};

/// "draw 12: textured quad, semi-transparent, bucket 512": a drawing command for people.
std::string describe_draw(std::size_t number, const gpu::Primitive& primitive);

}  // namespace app
