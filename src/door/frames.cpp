#include "door/frames.h"

#include <utility>

#include "display/scanout.h"
#include "gpu/canvas/canvas.h"
#include "scene/accurate.h"
#include "scene/world.h"

namespace door {

namespace {

/// Fog is a scene's: a stream brings none.
std::optional<gpu::canvas::Options> canvas_of(const scene::Knobs& knobs) {
  return scene::canvas_options(knobs, scene::World{}, 1);
}

}  // namespace

base::Result<void> Frames::use(const scene::Knobs& knobs, gpu::Gpu& gpu) {
  scene::Knobs largest = knobs;
  largest.width = 640;
  largest.height = 512;
  if (const auto options = canvas_of(largest)) {
    const std::uint64_t bytes = gpu::canvas::Canvas::frame_bytes(*options);
    if (bytes > scene::canvas_limit_bytes)
      return base::fail("resolution and antialias ask for a frame of up to " + std::to_string(bytes) +
                        " bytes; expected at most " + std::to_string(scene::canvas_limit_bytes));
  }
  knobs_ = knobs;
  has_canvas_ = canvas_of(knobs_).has_value();
  set_targets(gpu);
  return {};
}

/// As large as the display area: the depth plane where VRAM is drawn on, else the canvas.
void Frames::set_targets(gpu::Gpu& gpu) {
  knobs_.width = gpu.display().width();
  knobs_.height = gpu.display().height();
  auto options = knobs_.height > 0 ? canvas_of(knobs_) : std::nullopt;
  const auto depth = options ? std::nullopt : scene::depth_options(knobs_);
  const gpu::DepthPlane* plane = gpu.depth_plane();
  if (depth != (plane != nullptr ? std::optional(plane->options()) : std::nullopt)) gpu.set_depth(depth);
  const bool is_other =
      (gpu.canvas() != nullptr) != options.has_value() || (options && gpu.canvas()->options() != *options);
  if (!is_other) return;
  gpu.set_canvas(options);
  presenter_.forget();
  shown_ = {};
  has_begun_ = false;
}

Frames::Place Frames::place_of_drawing(const gpu::Gpu& gpu) const {
  const Place corner{gpu.state().left(), gpu.state().top()};
  for (const Place start : starts_) {
    if (corner.x >= start.x && corner.x < start.x + knobs_.width && corner.y >= start.y &&
        corner.y < start.y + knobs_.height)
      return start;
  }
  return corner;
}

void Frames::before_words(gpu::Gpu& gpu) {
  if (!has_canvas_) return;
  set_targets(gpu);
  if (gpu.canvas() == nullptr) return;
  const Place start{gpu.display().start_x(), gpu.display().start_y()};
  if (start != starts_[0]) starts_ = {start, starts_[0]};
  const gpu::DrawState& state = gpu.state();
  const Place place = place_of_drawing(gpu);
  // Small areas are textures being drawn, or parts of the picture.
  const int area = (state.right() + 1 - state.left()) * (state.bottom() + 1 - state.top());
  const bool is_a_frame = state.right() >= state.left() && 2 * area > knobs_.width * knobs_.height;
  if (has_begun_ && (place == place_ || !is_a_frame)) return;
  if (has_begun_) finish(gpu);
  begin(gpu, place);
}

void Frames::begin(gpu::Gpu& gpu, Place place) {
  place_ = place;
  has_begun_ = true;
  gpu.begin_frame(place.x, place.y);
}

void Frames::finish(gpu::Gpu& gpu) {
  (void)gpu.end_frame();
  auto picture = presenter_.show(gpu, knobs_);
  if (!shown_[0] || shown_[0]->place != place_) shown_[1] = std::move(shown_[0]);
  shown_[0] = Shown{place_, std::move(picture)};
}

void Frames::jump(gpu::Gpu& gpu) {
  shown_ = {};
  presenter_.forget();
  if (!has_begun_) return;
  (void)gpu.end_frame();
  has_begun_ = false;
}

void Frames::vblank(gpu::Gpu& gpu) {
  if (!has_canvas_ || gpu.canvas() == nullptr) {
    (void)gpu.end_frame();
    gpu.next_field();
    gpu.begin_frame();
    return;
  }
  const bool is_shown = place_ == Place{gpu.display().start_x(), gpu.display().start_y()};
  if (has_begun_ && is_shown) finish(gpu);
  gpu.next_field();
  if (has_begun_ && is_shown) begin(gpu, place_);
}

base::Picture Frames::picture(gpu::Gpu& gpu) {
  if (!has_canvas_) return presenter_.show(gpu, knobs_);
  const auto area = display::area_of(gpu.display());
  for (const auto& shown : shown_) {
    if (shown && shown->place == Place{area.x, area.y} && !area.is_off) return shown->picture;
  }
  return display::scan_out(gpu.vram().pixels(), area);
}

}  // namespace door
