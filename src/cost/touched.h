#pragma once
// How many bytes a frame reads and writes: what a faster memory would help, whatever the processor.

#include <cstdint>

#include "cost/subject.h"

namespace cost {

/// Bytes read plus bytes written in one frame, counted from what was drawn, each access by itself, caches
/// ignored. Of the frame's own data: not vertices, code, or the tables of a kernel.
struct Touched {
  std::uint64_t list = 0;  ///< table and packets in main RAM: written, then walked
  std::uint64_t colour =
      0;  ///< samples filled, written, and read back to blend: 2 bytes each in VRAM, 4 on a canvas
  std::uint64_t depth = 0;   ///< keys of 4 bytes: cleared, compared, stored
  std::uint64_t texels = 0;  ///< VRAM, palettes and mip levels, every tap of a filter
  std::uint64_t filter = 0;  ///< after the frame: samples or VRAM read, pictures written and read again

  [[nodiscard]] std::uint64_t total() const { return list + colour + depth + texels + filter; }
};

/// Needs `drawn` = subject.draw(knobs) done just before. Draws the frame once more where it is drawn in VRAM.
base::Result<Touched> touched(Subject& subject, const scene::Knobs& knobs, const Drawn& drawn);

}  // namespace cost
