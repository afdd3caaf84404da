#pragma once
// Where the accurate target goes when a program decides what is drawn: over its drawing area.

#include <optional>

#include "base/result.h"
#include "gpu/canvas/options.h"
#include "gpu/gpu.h"

namespace machine {

/// A pixel of VRAM.
struct Corner {
  int x = 0, y = 0;
  bool operator==(const Corner&) const = default;
};

/// Puts a canvas over the drawing area and begins the frame there; the size in `options` does not count.
/// Returns the area's corner. Nothing, and the GPU is as it was: the area is much smaller than the screen, a
/// texture that is drawn before the picture. Error (exit 2), likewise: as scene::check_size.
base::Result<std::optional<Corner>> place_canvas(gpu::Gpu& gpu, gpu::canvas::Options options);

/// Whether the drawing area is as large as a picture, and no texture that is drawn before one.
bool draws_picture(const gpu::Gpu& gpu);

}  // namespace machine
