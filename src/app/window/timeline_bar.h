#pragma once
// The bar under the picture of a recording: its frames, the loop, where pictures first differ, and the
// commands of the frame. The mouse scrubs on both.

#include <cstdint>
#include <optional>

#include "app/window/layout.h"
#include "app/window/window_state.h"

namespace app {

/// What it shows beside the state.
struct TimelineMarks {
  double progress = 1;                            ///< of indexing, 0..1
  std::optional<std::int64_t> first_different{};  ///< frame
  std::size_t commands = 0;                       ///< of the frame; 0: not known
};

/// Frame, 1..last, under a place 0..1 of the bar, and the place of its middle.
std::int64_t frame_at(double place, std::int64_t last);
double place_of_frame(std::int64_t frame, std::int64_t last);
/// Commands shown under a place: none for all of them.
std::optional<std::size_t> commands_at(double place, std::size_t commands);

/// In pixels; 0 for scenes.
int timeline_height(const WindowState& state, float scale);
void draw_timeline(WindowState& state, const TimelineMarks& marks, Rect bar, float scale);

}  // namespace app
