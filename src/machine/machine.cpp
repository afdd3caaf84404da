#include "machine/machine.h"

#include "scene/pipeline.h"

namespace machine {

scene::FrameBuilder& Machine::builder(const scene::Knobs& knobs) {
  auto& made = builders_[{knobs.width, knobs.height, knobs.subdivide.pieces()}];
  if (!made) made = std::make_unique<scene::FrameBuilder>(scene_, knobs);
  if (uploaded_ != made.get()) {
    made->upload(gpu_);
    uploaded_ = made.get();
  }
  return *made;
}

base::Result<scene::FrameStats> Machine::draw(double seconds, const scene::Knobs& knobs) {
  auto stats = scene::render_frame(builder(knobs), seconds, knobs, ram_, gpu_);
  if (stats) show(knobs);
  return stats;
}

}  // namespace machine
