#pragma once
// Who wrote which pixel. A Gpu that is given a Trace notes every pixel it writes; one that is not has no
// member for it and pays nothing.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/primitive.h"
#include "gpu/vram.h"

namespace gpu {

/// One write to one pixel, or one that only the depth test prevented: a fragment that the texel, the mask bit
/// or the drawing area stops makes no event.
struct Event {
  std::uint32_t pixel = 0;  ///< y * 1024 + x
  std::uint32_t draw = 0;   ///< index into Trace::draws
  std::uint32_t depth = 0;  ///< the key the depth test compared (depth.h); 0 where nothing was tested
  std::uint16_t before = 0, after = 0;
  std::uint16_t fragment = 0;  ///< the new pixel before blending, its bit 15 included
  std::uint8_t half = 0;       ///< 1: of the second triangle of a quad
  bool blended = false;        ///< `after` was mixed with `before`; rejected: would have been
  bool rejected = false;       ///< lost the depth test: `after` is `before`, the pixel was not touched
};

/// The caller owns it and keeps it alive while a Gpu has it. The Gpu only appends and
/// overwrites; `clear` begins anew.
struct Trace {
  std::vector<std::uint32_t> last_writer = std::vector<std::uint32_t>(Vram::size);  ///< draw + 1; 0: nobody
  bool keep_history = false;
  std::vector<Event> history;        ///< every write in the order made; only with keep_history
  std::vector<Primitive> draws;      ///< decoded commands in list order; the draw number is the index
  std::uint32_t bucket = no_bucket;  ///< set by the caller before feeding a node; copied into each Primitive

  void clear() {
    last_writer.assign(Vram::size, 0);
    history.clear();
    draws.clear();
    bucket = no_bucket;
  }
};

}  // namespace gpu
