#pragma once
// One step of a slice: from what is needed at the end of a frame to what is needed at its beginning.

#include <bitset>
#include <cstdint>
#include <map>
#include <vector>

#include "debug/timeline.h"
#include "gpu/trace.h"
#include "gpu/transfer.h"

namespace debug {

/// Pixels of VRAM and entries of the palette cache that have to be right.
struct Needs {
  std::vector<bool> pixels = std::vector<bool>(gpu::Vram::size);
  std::bitset<256> palette;

  void add(std::uint32_t pixel) { pixels[pixel] = true; }
};

/// A command that is kept.
struct Kept {
  std::uint32_t command = 0;  ///< K; 0: it began in the frame before
  gpu::Kind kind = gpu::Kind::polygon;
  bool loads_palette = false;  ///< it found another palette than the one it names in the cache
  std::map<std::uint32_t, std::uint16_t> uploaded;  ///< an upload: the needed pixels and what they get,
  std::map<std::uint32_t, std::uint16_t> around;    ///< and the others in the rectangle that holds them
};

/// What a frame was seen to do.
struct WatchedFrame {
  gpu::Trace trace;                       ///< with its history
  std::vector<bool> loads_palette;        ///< by draw
  std::vector<std::uint16_t> vram_after;  ///< at the end of the frame
};

/// Draws frame `frame` and notes what step_back() wants to know.
void watch_frame(Timeline& timeline, std::uint64_t frame, WatchedFrame& watched);

/// Turns `needs` at the end of the frame into those at its beginning, and `watched.vram_after` into VRAM
/// then. The commands that do it, last first.
std::vector<Kept> step_back(WatchedFrame& watched, Needs& needs);

}  // namespace debug
