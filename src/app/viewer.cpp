#include "app/viewer.h"

#include <algorithm>
#include <utility>

#include "gpu/canvas/canvas.h"
#include "scene/plan.h"

namespace app {

Viewer::Viewer(scene::Scene scene, const scene::Knobs& knobs)
    : scene_(std::move(scene)), animate_(scene_.animate), base_(scene_.world.camera) {
  // The scene's own animation first, then the user's hand on the camera; with an offset of nothing the frame
  // is exactly the scene's.
  scene_.animate = [this, still = base_](scene::World& world, double seconds) {
    world.camera = still;
    if (animate_) animate_(world, seconds);
    base_ = world.camera;
    world.camera = moved(base_, offset_, pivot_distance_);
  };
  {
    auto first = scene_.world;
    scene_.animate(first, 0);
    first.camera = base_;
    pivot_distance_ = pivot_distance(first);
  }
  builder_ = &machine_.builder(knobs);
}

scene::Scene Viewer::scene_as_given() const {
  auto scene = scene_;
  scene.animate = animate_;
  return scene;
}

base::Result<scene::FrameStats> Viewer::draw(std::int64_t frame, const scene::Knobs& knobs,
                                             const CameraOffset& camera) {
  if (auto checked = scene::check_knobs(knobs); !checked) return tl::make_unexpected(checked.error());
  offset_ = camera;
  builder_ = &machine_.builder(knobs);
  builder_->set_keep_going(keep_going_);
  const bool continues = frame == last_frame_ + 1 && knobs == last_knobs_;
  if (!continues) machine_.presenter().forget();
  const int before = continues ? 0 : machine::Presenter::frames_before(knobs);
  last_frame_ = frame;
  last_knobs_ = knobs;
  base::Result<scene::FrameStats> stats;
  for (std::int64_t f = frame - before; f <= frame; ++f) {
    const auto seconds = static_cast<double>(std::max<std::int64_t>(f, 0)) / 60.0;
    stats = machine_.draw(seconds, knobs);
    if (!stats) return stats;
  }
  return stats;
}

void Viewer::set_keep_going(std::function<bool(double)> keep_going) { keep_going_ = std::move(keep_going); }

std::vector<const scene::KnobInfo*> Viewer::unwatched_knobs(const scene::Knobs& knobs) {
  const auto& builder = machine_.builder(knobs);
  std::vector<const scene::KnobInfo*> asking;
  for (const auto& knob : scene::knob_table()) {
    scene::Knobs alone;
    knob.set(alone, knob.get(knobs));
    const auto options = builder.plan_of(alone).canvas;
    if (options && !options->can_be_watched()) asking.push_back(&knob);
  }
  return asking;
}

std::vector<std::uint16_t> Viewer::vram() const {
  const auto pixels = gpu().vram().pixels();
  std::vector<std::uint16_t> copy(pixels.begin(), pixels.end());
  const auto* canvas = gpu().canvas();
  if (canvas != nullptr && canvas->options().can_be_watched()) canvas->put_into(copy);
  return copy;
}

void Viewer::fly(CameraOffset& camera, glm::vec3 step) const {
  app::fly(camera, base_, step, pivot_distance_);
}

}  // namespace app
