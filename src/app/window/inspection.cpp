#include "app/window/inspection.h"

#include <algorithm>

#include "app/order_of.h"
#include "inspect/history.h"
#include "inspect/maps.h"

namespace app {
namespace {

const char* kind_word(const gpu::Primitive& p) {
  switch (p.kind) {
    case gpu::Kind::polygon:
      return p.is_quad() ? "quad" : "triangle";
    case gpu::Kind::rectangle:
      return "rectangle";
    case gpu::Kind::line:
      return "line";
    case gpu::Kind::fill:
      return "fill";
    case gpu::Kind::copy:
      return "copy";
    case gpu::Kind::upload:
      return "upload";
  }
  return "";
}

// The top of `image`: what stands below the picture is a legend, which the panel shows instead.
base::Picture picture_of(base::Picture image, int height) {
  image.height = std::min(image.height, height);
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  return image;
}

}  // namespace

std::string describe_draw(std::size_t number, const gpu::Primitive& primitive) {
  std::string text = "draw " + std::to_string(number) + ": ";
  if (primitive.is_textured()) text += "textured ";
  if (primitive.kind <= gpu::Kind::line && primitive.is_gouraud()) text += "shaded ";
  text += kind_word(primitive);
  if (primitive.is_semi_transparent()) text += ", semi-transparent";
  if (primitive.bucket != gpu::no_bucket) text += ", bucket " + std::to_string(primitive.bucket);
  if (primitive.has_depth) {
    const auto last = primitive.vertices.begin() + primitive.vertex_count;
    const auto [near, far] = std::minmax_element(primitive.vertices.begin(), last,
                                                 [](const auto& a, const auto& b) { return a.z < b.z; });
    text += ", z " + std::to_string(near->z >> 12) + ".." + std::to_string(far->z >> 12);
  }
  return text;
}

Inspection::Inspection(const Subject& like, const scene::Knobs& knobs) : machine_(like.another(knobs)) {
  trace_.keep_history = true;
}

base::Result<bool> Inspection::update(const WindowState& state) {
  if (frame_ == state.frame && knobs_ == state.knobs && camera_ == state.camera) return false;
  frame_ = state.frame;
  knobs_ = state.knobs;
  camera_ = state.camera;
  trace_.clear();
  report_.reset();
  machine_->watch(&trace_);
  const auto drawn = machine_->draw(frame_, knobs_, camera_);
  machine_->watch(nullptr);
  begins_.clear();
  for (std::size_t i = 0; i < trace_.history.size(); ++i) {
    if (i == 0 || trace_.history[i].draw != trace_.history[i - 1].draw) begins_.push_back(i);
  }
  unwatched_.clear();
  if (!drawn) return tl::make_unexpected(drawn.error());
  unwatched_ = machine_->unwatched_knobs(knobs_);
  return true;
}

base::Picture Inspection::after(int count) const {
  if (count < 0 || count >= draws()) return machine_->picture();
  auto vram = machine_->vram();
  const auto first_undone = begins_[static_cast<std::size_t>(count)];
  for (std::size_t i = trace_.history.size(); i > first_undone; --i) {
    const auto& event = trace_.history[i - 1];
    vram[event.pixel] = event.before;  // of a rejected one that is what it was
  }
  return display::scan_out(vram, machine_->area());
}

std::string Inspection::draw_text(int at) const {
  if (at < 0 || at >= draws()) return "nothing";
  const auto draw = trace_.history[begins_[static_cast<std::size_t>(at)]].draw;
  return describe_draw(draw, trace_.draws[draw]);
}

const inspect::Report& Inspection::report() const {
  if (!report_) {
    const auto area = machine_->area();
    report_ = inspect::inspect(trace_, {.order = order_of(knobs_.visibility),
                                        .frame = static_cast<std::uint32_t>(frame_),
                                        .picture = {area.x, area.y, area.width, area.height}});
  }
  return *report_;
}

std::vector<std::string> Inspection::history(int x, int y) const {
  return inspect::pixel_history(report(), trace_, x, y);
}

base::Picture Inspection::map(Map map) const {
  const auto vram = machine_->vram();
  const int height = machine_->picture().height;
  switch (map) {
    case Map::none:
      break;
    case Map::errors:
      return picture_of(inspect::heatmap(report(), vram), height);
    case Map::overdraw:
      return picture_of(inspect::overdraw(report(), trace_), height);
    case Map::owners:
      return picture_of(inspect::ids(report(), trace_), height);
    case Map::truth:
      return picture_of(inspect::truth_image(report(), trace_, vram), height);
    case Map::depth:
      return picture_of(inspect::depth_image(report(), trace_), height);
  }
  return machine_->picture();
}

}  // namespace app
