#include "app/machine.h"

#include <algorithm>
#include <utility>

#include "gpu/canvas/canvas.h"
#include "scene/accurate.h"
#include "scene/pipeline.h"

namespace app {

Machine::Machine(scene::Scene scene, const scene::Knobs& knobs)
    : scene_(std::move(scene)), animate_(scene_.animate), base_(scene_.world.camera) {
  // The scene's own animation first, then the user's hand on the camera; with an offset of nothing the frame
  // is exactly the scene's.
  scene_.animate = [this, still = base_](scene::World& world, double seconds) {
    world.camera = still;
    if (animate_) animate_(world, seconds);
    base_ = world.camera;
    world.camera = moved(base_, offset_, pivot_distance_);
  };
  auto first = scene_.world;
  scene_.animate(first, 0);
  first.camera = base_;
  pivot_distance_ = pivot_distance(first);
  builder_ = std::make_unique<scene::FrameBuilder>(scene_, knobs);
  builder_->upload(gpu_);
}

scene::Scene Machine::scene_as_given() const {
  auto scene = scene_;
  scene.animate = animate_;
  return scene;
}

base::Result<scene::FrameStats> Machine::draw(std::int64_t frame, const scene::Knobs& knobs,
                                              const CameraOffset& camera) {
  if (auto checked = scene::check_knobs(knobs); !checked) return tl::make_unexpected(checked.error());
  offset_ = camera;
  if (builder_->needs_upload(knobs)) {
    builder_ = std::make_unique<scene::FrameBuilder>(scene_, knobs);
    builder_->upload(gpu_);
  }
  const bool continues = frame == last_frame_ + 1 && knobs == last_knobs_;
  if (!continues) presenter_.forget();
  const int before = continues ? 0 : machine::Presenter::frames_before(knobs);
  last_frame_ = frame;
  last_knobs_ = knobs;
  base::Result<scene::FrameStats> stats;
  for (std::int64_t f = frame - before; f <= frame; ++f) {
    const auto seconds = static_cast<double>(std::max<std::int64_t>(f, 0)) / 60.0;
    stats = scene::render_frame(*builder_, seconds, knobs, ram_, gpu_);
    if (!stats) return stats;
    picture_ = presenter_.show(gpu_, knobs);
  }
  return stats;
}

std::vector<const scene::KnobInfo*> Machine::unwatched_knobs(const scene::Knobs& knobs) const {
  std::vector<const scene::KnobInfo*> asking;
  for (const auto& knob : scene::knob_table()) {
    scene::Knobs alone;
    knob.set(alone, knob.get(knobs));
    const auto options = scene::canvas_options(alone, builder_->world(), builder_->units_per_world());
    if (options && !options->can_be_watched()) asking.push_back(&knob);
  }
  return asking;
}

std::vector<std::uint16_t> Machine::vram() const {
  const auto pixels = gpu_.vram().pixels();
  std::vector<std::uint16_t> copy(pixels.begin(), pixels.end());
  const auto* canvas = gpu_.canvas();
  if (canvas != nullptr && canvas->options().can_be_watched()) canvas->put_into(copy);
  return copy;
}

void Machine::fly(CameraOffset& camera, glm::vec3 step) const {
  app::fly(camera, base_, step, pivot_distance_);
}

}  // namespace app
