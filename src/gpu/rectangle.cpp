// Rectangles and sprites: triangles' span kernels with gradients of one texel a pixel.
// Never dithered, never shaded.

#include <algorithm>

#include "gpu/kernels.h"
#include "gpu/setup.h"

namespace gpu {

namespace {

/// The part inside the drawing area; empty where right < left or bottom < top.
Box drawn_box(const Primitive& primitive) {
  const DrawState& state = primitive.state;
  const Vertex& corner = primitive.vertices[0];
  return {.left = std::max(corner.x, state.left()),
          .top = std::max(corner.y, state.top()),
          .right = std::min(corner.x + primitive.width - 1, state.right()),
          .bottom = std::min(corner.y + primitive.height - 1, state.bottom())};
}

/// No gradients and nothing to read in VRAM: a block of one colour.
bool is_plain_fill(const Surface& surface, const Primitive& primitive, const Mode& mode, const Box& box) {
  return mode.surface.texture == TexelFormat::none && !mode.reads_target() && surface.trace == nullptr &&
         primitive.state.skipped_rows == SkippedRows::none && box.bottom < Vram::height;
}

TextureGradients texel_steps(const Primitive& primitive) {
  const auto fixed = [](int texels) { return static_cast<std::uint32_t>(texels) << 24; };
  const SpriteTexels t = sprite_texels(primitive);
  return {.u = {.start = fixed(t.u), .dx = fixed(t.u_step), .dy = 0},
          .v = {.start = fixed(t.v), .dx = 0, .dy = fixed(t.v_step)}};
}

}  // namespace

std::uint64_t rectangle_pixels(const Primitive& primitive) {
  const Box box = drawn_box(primitive);
  std::uint64_t rows = 0;
  for (int y = box.top; y <= box.bottom; ++y) rows += primitive.state.skips(y) ? 0 : 1;
  return box.right < box.left ? 0 : rows * static_cast<std::uint64_t>(box.right - box.left + 1);
}

void draw_rectangle(const Surface& surface, const Primitive& primitive) {
  const Box box = drawn_box(primitive);
  const int width = box.right - box.left + 1, height = box.bottom - box.top + 1;
  if (width <= 0 || height <= 0) return;
  const Mode mode = mode_of(primitive, false);
  Job job;
  put_constants(job, surface, primitive);
  if (is_plain_fill(surface, primitive, mode, box)) {
    ++surface.counters.kernels[mode.index()];
    operations().fill(&surface.vram.at(box.left, box.top), width, height, job.colour);
    return;
  }
  const Vertex& corner = primitive.vertices[0];
  SpanList list;
  for (int y = box.top; y <= box.bottom; ++y) {
    if (!primitive.state.skips(y)) list.add(box.left, y, width, box.left - corner.x, y - corner.y);
  }
  bool in_order = false;
  if (primitive.is_textured()) {
    job.texel = texel_steps(primitive);
    in_order = samples_what_it_draws(primitive.state, box);
    job.page.side_by_side = !in_order && has_adjacent_texels(job, mode.surface.texture);
  }
  run(surface, mode, job, list.all(), in_order);
}

}  // namespace gpu
