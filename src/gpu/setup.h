#pragma once
// From a decoded primitive to what a kernel needs: its mode, its constants, and
// whether it may be drawn in blocks.

#include <array>
#include <cstdint>
#include <span>

#include "gpu/job.h"
#include "gpu/raster.h"
#include "gpu/rules.h"

namespace gpu {

/// No primitive has more rows. [docs/hardware.md#size-rule]
inline constexpr std::size_t max_rows = max_distance_y + 1;

/// Room for the spans of one primitive, written from the front.
struct SpanList {
  std::array<Span, max_rows> spans;
  std::size_t count = 0;
  void add(int x, int y, int width, int dx, int dy) {
    spans[count++] = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                      static_cast<std::int16_t>(width), static_cast<std::int16_t>(dx),
                      static_cast<std::int16_t>(dy)};
  }
  [[nodiscard]] std::span<const Span> all() const { return {spans.data(), count}; }
};

/// Mode of a polygon or rectangle; `dither` is what is_dithered says, which is known of rectangles.
/// Inline: returned from a call, its bytes are written one by one and read as one word, and the
/// processor waits for that as long as a small rectangle takes to draw.
inline Mode mode_of(const Primitive& primitive, bool dither) {
  const bool is_textured = primitive.is_textured();
  const bool is_gouraud = primitive.kind == Kind::polygon && primitive.is_gouraud();
  const Shade shade = primitive.is_raw() ? Shade::raw : is_gouraud ? Shade::gouraud : Shade::flat;
  const Blend blend = blend_of(primitive);
  return {
      .surface = {.texture = is_textured ? primitive.state.texel_format() : TexelFormat::none,
                  .shade = shade,
                  .dither = dither},
      .blend = blend,
      .masked = blend == Blend::opaque && primitive.state.mask_test() != 0,
      .depth = false,
  };
}

/// Everything of a job but its gradients and its depth.
void put_constants(Job& job, const Surface& surface, const Primitive& primitive);

/// Pixels from left, top to right, bottom, all inside; within the drawing area.
struct Box {
  int left, top, right, bottom;
};

/// Whether a textured primitive drawn in this box may read a texel that it has written itself.
bool samples_what_it_draws(const DrawState& state, const Box& drawn);

/// Whether a row of pixels reads a row of texels, one by one: sprites, and polygons drawn like sprites.
bool has_adjacent_texels(const Job& job, TexelFormat texture);

/// Where the texels of these spans lie (gpu/texel_reads.h).
void tell_texels(const Mode& mode, const Job& job, std::span<const Span> spans, const TexelSink& sink);

/// Runs the kernel; or, where that is called for, the body that draws one pixel after
/// the other or the watched one.
void run(const Surface& surface, const Mode& mode, const Job& job, std::span<const Span> spans,
         bool in_order);

}  // namespace gpu
