#include "gpu/setup.h"

#include <algorithm>

#include "gpu/kernels.h"
#include "gpu/texture_page.h"
#include "ot/gp0.h"

namespace gpu {

void put_constants(Job& job, const Surface& surface, const Primitive& primitive) {
  const DrawState& state = primitive.state;
  job.pixels = surface.vram.pixels().data();
  job.clut = surface.clut;
  job.mask_set = state.mask_set();
  job.mask_test = state.mask_test();
  const Vertex& first = primitive.vertices[0];
  job.r = first.r;
  job.g = first.g;
  job.b = first.b;
  job.colour = static_cast<std::uint16_t>(to_pixel(first.r, first.g, first.b) | state.mask_set());
  if (!primitive.is_textured()) return;
  job.page = {.x = static_cast<std::uint32_t>(state.page_x()),
              .y = static_cast<std::uint32_t>(state.page_y()),
              .keep_u = state.window_keep_u(),
              .keep_v = state.window_keep_v(),
              .set_u = state.window_set_u(),
              .set_v = state.window_set_v(),
              .side_by_side = false};
}

/// True already where the drawn box meets the texture page: rarely wrong, never too late.
bool samples_what_it_draws(const DrawState& state, const Box& drawn) {
  const int page_left = state.page_x(), page_right = page_left + page_width(state.texel_format());
  const auto meets_columns = [&](int shift) {
    return drawn.left < page_right - shift && page_left - shift <= drawn.right;
  };
  const auto meets_rows = [&](int shift) {
    return drawn.top < state.page_y() + 256 + shift && state.page_y() + shift <= drawn.bottom;
  };
  return (meets_columns(0) || meets_columns(Vram::width)) && (meets_rows(0) || meets_rows(Vram::height));
}

bool has_adjacent_texels(const Job& job, TexelFormat texture) {
  constexpr std::uint32_t one = 1U << 24;
  if (texture == TexelFormat::none || job.texel.u.dx != one || job.texel.v.dx != 0) return false;
  const TexturePage& page = job.page;
  const bool has_window = page.keep_u != 0xff || page.keep_v != 0xff || page.set_u != 0 || page.set_v != 0;
  return !has_window && static_cast<int>(page.x) + page_width(texture) <= Vram::width;
}

void run(const Surface& surface, const Mode& mode, const Job& job, std::span<const Span> spans,
         bool in_order) {
  if (surface.texels != nullptr) return tell_texels(mode, job, spans, *surface.texels);
  ++surface.counters.kernels[mode.index()];
  if (surface.trace != nullptr) {
    draw_watched(mode, job, spans, {surface.trace, surface.draw, surface.half});
  } else if (in_order) {
    ++surface.counters.drawn_in_order;
    draw_in_order(mode, job, spans);
  } else {
    kernels()[mode.index()](job, spans);
  }
}

}  // namespace gpu
