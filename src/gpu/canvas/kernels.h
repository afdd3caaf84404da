#pragma once
// The accurate kernels: one function per Mode, each drawing a run of pixels of one row.

#include <array>
#include <cstdint>

#include "gpu/canvas/brush.h"

namespace gpu::canvas {

inline constexpr int run_length = 64;  ///< pixels a kernel takes at once: what its scratch arrays hold

/// Up to run_length pixels of one row.
struct Run {
  int x = 0, y = 0, count = 0;
  /// Per pixel, bit s = sample s is covered; nullptr: all samples are.
  const std::uint8_t* covered = nullptr;
  /// Per pixel, where attributes are taken, in canvas units from the pixel's origin; nullptr: at the layer's
  /// offset. With one sample a pixel it is the sample.
  const Point* shaded_at = nullptr;
};

/// What the kernels did.
struct Counters {
  std::uint64_t primitives = 0;   ///< triangles, rectangles, line segments with at least one run, per layer
  std::uint64_t covered = 0;      ///< pixels with a covered sample
  std::uint64_t shaded = 0;       ///< pixels whose colour was computed: once, whatever the samples
  std::uint64_t written = 0;      ///< samples written
  std::uint64_t blended = 0;      ///< of these, mixed with what was there
  std::uint64_t tested = 0;       ///< samples whose depth was compared
  std::uint64_t stored = 0;       ///< samples whose depth was kept
  std::uint64_t cleared = 0;      ///< samples set by fills
  std::uint64_t texel_bytes = 0;  ///< read to make texels: of VRAM, of palettes, of mip levels
  std::array<std::uint64_t, Mode::count> runs{};  ///< calls of each kernel, by Mode::index()
};

/// Draws `run`, which lies inside the target.
void draw_run(const Target& target, const Paint& paint, const Planes& planes, const Run& run,
              Counters& counters);

}  // namespace gpu::canvas
