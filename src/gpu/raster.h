#pragma once
// The border between decoding and drawing: a decoded primitive goes in, pixels come out.

#include <array>
#include <cstdint>

#include "gpu/columns.h"
#include "gpu/counters.h"
#include "gpu/depth.h"
#include "gpu/primitive.h"
#include "gpu/texel_reads.h"
#include "gpu/trace.h"
#include "gpu/vram.h"

namespace gpu {

/// What is drawn on. Pointers are borrowed for the call.
struct Surface {
  Vram& vram;
  const std::uint16_t* clut;  ///< ClutCache::entries; read by textures with a palette
  Counters& counters;
  DepthPlane* depth = nullptr;
  Trace* trace = nullptr;  ///< notes every written pixel under `draw`
  std::uint32_t draw = 0;
  const Limits* limits = nullptr;     ///< polygons only; nullptr: none
  std::uint8_t half = 0;              ///< 1 while the second triangle of a quad is drawn
  const TexelSink* texels = nullptr;  ///< is told where texels lie; then nothing is drawn
};

void draw_polygon(const Surface& surface, const Primitive& primitive, Pass pass);
void draw_rectangle(const Surface& surface, const Primitive& primitive);
void draw_line(const Surface& surface, const Primitive& primitive);

/// Pixels that each would visit: covered, inside the drawing area, in rows that are not skipped.
std::uint64_t polygon_pixels(const Primitive& primitive);
std::uint64_t rectangle_pixels(const Primitive& primitive);
std::uint64_t line_pixels(const Primitive& primitive);

/// Whole rectangles of VRAM that wrap at both edges; the drawing area does not matter.
void fill_rectangle(const Surface& surface, const Primitive& primitive);
void copy_rectangle(const Surface& surface, const Primitive& primitive);

/// Up to a row of pixels on their way into VRAM, and room for a vector that begins on the last of them.
using PixelRow = std::array<std::uint16_t, Vram::width + Vram::padding>;

/// `count` pixels from x, y to the right, both wrapping; mask bits apply, the drawing area does not.
void store_row(const Surface& surface, const DrawState& state, int x, int y, const PixelRow& pixels,
               int count);

}  // namespace gpu
