// What a z-buffered frame adds: the depth plane, and a second pass for what lets light through.

#include "gpu/canvas/canvas.h"
#include "gpu/depth_queue.h"
#include "gpu/gpu.h"
#include "gpu/raster.h"

namespace gpu {

Gpu::Gpu() {
  gp1(0);
  next_command_ = 0;
}
Gpu::~Gpu() = default;
Gpu::Gpu(Gpu&&) noexcept = default;
Gpu& Gpu::operator=(Gpu&&) noexcept = default;

void Gpu::set_depth(const std::optional<DepthOptions>& options) {
  depth_ = options ? std::make_unique<DepthPlane>(*options) : nullptr;
  queue_ = nullptr;
}

void Gpu::begin_frame(int x, int y) {
  next_command_ = 0;
  frame_ = {};
  if (canvas_) canvas_->begin_frame(x, y);
  if (depth_) depth_->clear();
  if (queue_) queue_->clear();
}

FrameEnd Gpu::end_frame() {
  draw_queue();
  return frame_;
}

/// Opaque fragments now, the others when everything opaque is there.
void Gpu::draw_with_depth() {
  const Primitive& p = current_;
  if (!p.has_depth) {
    if (frame_.polygons_without_depth++ == 0) frame_.first_without_depth = p.command_number;
    draw_either(surface(), p, Pass::console);
    return;
  }
  if (!p.is_semi_transparent() || p.is_textured()) draw_either(surface(), p, Pass::opaque);
  if (!p.is_semi_transparent()) return;
  if (!queue_) queue_ = std::make_unique<DepthQueue>();
  queue_->add(p, clut_, current_draw_);
  ++frame_.queued;
  if (queue_->is_full()) draw_queue();
}

/// Also before a fill, a copy or an upload: they would change what the queued
/// polygons lie on, or their texture.
void Gpu::draw_queue() {
  if (!queue_ || queue_->is_empty()) return;
  follow_trace();
  queue_->sort();
  for (const DepthQueue::Entry& entry : queue_->entries()) {
    Surface target = surface();
    target.clut = queue_->palette(entry);
    target.draw = entry.draw;
    if (trace_ != nullptr && entry.draw == no_draw) target.draw = trace_->enter(entry.primitive);
    draw_either(target, entry.primitive, Pass::semi_transparent);
  }
  queue_->clear();
}

/// For a GPU whose z-buffer is gone: untested, as polygons without depth are.
void Gpu::draw_queue_in_order() {
  for (const DepthQueue::Entry& entry : queue_->entries()) {
    Surface target = surface();
    target.clut = queue_->palette(entry);
    target.draw = entry.draw;
    draw_either(target, entry.primitive, Pass::console);
  }
  queue_ = nullptr;
}

void Gpu::set_trace(Trace* trace) {
  const bool begins = trace != nullptr && trace != trace_;
  trace_ = trace;
  is_noted_ = trace_ != nullptr || pixel_counts_ != nullptr;
  if (!begins) return;
  trace_beginning_ = trace_->beginnings();
  current_draw_ = upload_.draw = no_draw;
  note_queue();
}

void Gpu::set_pixel_counts(PixelCounts* counts) {
  pixel_counts_ = counts;
  is_noted_ = trace_ != nullptr || pixel_counts_ != nullptr;
}

/// The queue's draw numbers are those of the trace; one that did not see the polygons gets them now.
void Gpu::note_queue() {
  if (!queue_ || trace_ == nullptr) return;
  for (DepthQueue::Entry& entry : queue_->entries()) {
    entry.draw = trace_->enter(entry.primitive);
  }
}

std::uint64_t Gpu::queue_bytes() const { return queue_ ? queue_->bytes() : 0; }

}  // namespace gpu
