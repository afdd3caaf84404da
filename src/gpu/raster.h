#pragma once
// The border between decoding and drawing: a decoded primitive goes in, pixels come out.

#include <cstdint>

#include "gpu/counters.h"
#include "gpu/coverage.h"
#include "gpu/primitive.h"
#include "gpu/trace.h"
#include "gpu/vram.h"

namespace gpu {

/// What is drawn on. Pointers are borrowed for the call.
struct Surface {
  Vram& vram;
  const std::uint16_t* clut;  ///< 256 entries; read by textures with a palette
  Trace* trace = nullptr;     ///< notes every written pixel under `draw`
  std::uint32_t draw = 0;
  const Limits* limits = nullptr;  ///< polygons only; nullptr: none
  std::uint8_t half = 0;           ///< 1 while the second triangle of a quad is drawn
};

void draw_polygon(const Surface& surface, const Primitive& primitive, Counters& counters);
void draw_rectangle(const Surface& surface, const Primitive& primitive);
void draw_line(const Surface& surface, const Primitive& primitive, Counters& counters);

/// Fill, copy: whole rectangles of VRAM that wrap at both edges.
void fill_rectangle(const Surface& surface, const Primitive& primitive);
void copy_rectangle(const Surface& surface, const Primitive& primitive);

/// One pixel of an upload: mask bits apply, the drawing area does not.
void store_transferred(const Surface& surface, const DrawState& state, int x, int y, std::uint16_t pixel);

}  // namespace gpu
