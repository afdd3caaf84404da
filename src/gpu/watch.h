#pragma once
// How a write reaches a Trace. Only bodies that are watched know this header's function.

#include "gpu/trace.h"

namespace gpu {

/// Where the watched body notes its writes.
struct Watch {
  Trace* trace = nullptr;
  std::uint32_t draw = 0;
  std::uint8_t half = 0;  ///< 1 while the second triangle of a quad is drawn

  /// `draw` and `half` of the event are filled in here.
  void note(Event event) const {
    if (!event.rejected) trace->last_writer[event.pixel] = draw + 1;
    if (!trace->keep_history) return;
    event.draw = draw;
    event.half = half;
    trace->history.push_back(event);
  }
};

}  // namespace gpu
