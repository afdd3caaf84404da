#pragma once
// How a write reaches a Trace. Only bodies that are watched know this header's function.

#include <algorithm>

#include "gpu/trace.h"

namespace gpu {

/// Where the watched body notes its writes.
struct Watch {
  Trace* trace = nullptr;
  std::uint32_t draw = 0;
  std::uint8_t half = 0;  ///< 1 while the second triangle of a quad is drawn

  /// So many pixels side by side, for a trace without a history.
  void note_row(std::uint32_t first, std::uint32_t count) const {
    std::fill_n(trace->last_writer.begin() + first, count, draw + 1);
    trace->written[draw] += count;
  }

  /// `draw` and `half` of the event are filled in here.
  void note(Event event) const {
    if (!event.rejected) {
      trace->last_writer[event.pixel] = draw + 1;
      ++trace->written[draw];
    }
    if (!trace->keep_history) return;
    event.draw = draw;
    event.half = half;
    trace->add(event);
  }
};

}  // namespace gpu
