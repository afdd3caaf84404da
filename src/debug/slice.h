#pragma once
// What a few pixels depend on, and nothing else: a dynamic backward slice through VRAM.
//
//     needed at the end of the frame: the pixels
//     from the last command back: one that wrote a needed pixel is kept; what it wrote is needed no more,
//         and what it read for that is: texels, palette entries, what it blended with, what it copied, what
//         the mask test looked at, and the texels that left a needed pixel alone
//     of an upload only the needed pixels are kept, where they were
//     at the beginning of a frame: back to the first moment at which all that is needed was there already
//
// The registers that kept commands were drawn under are set anew before them; a palette is loaded where it
// was loaded. Depth is left out: the slice is of what the console draws.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "debug/number.h"
#include "debug/timeline.h"
#include "dump/dump.h"

namespace debug {

struct Slice {
  dump::Dump dump;  ///< replays to the same pixels, one frame
  std::vector<Number> kept;
  std::uint64_t upload_pixels = 0;     ///< that are sent
  std::uint64_t frames_looked_at = 0;  ///< that were drawn watched
};

/// The slice for `pixels` (y * 1024 + x) as they are at the end of frame `frame`, 1..frames(). The timeline
/// draws as the console does. `keep_going` is asked now and then. Error: exit 130 when it says no; exit 1: a
/// frame is larger than a history can be, or the slice does not replay to the same pixels, which is checked.
base::Result<Slice> slice(Timeline& timeline, std::uint64_t frame, std::span<const std::uint32_t> pixels,
                          const std::function<bool()>& keep_going = {});

}  // namespace debug
