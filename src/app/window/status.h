#pragma once
// The status line: what is said, and in how many rows. Pure.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/window/window_state.h"
#include "scene/frame.h"

namespace app {

/// What it tells of the last frame. Times are smoothed.
struct Status {
  std::string scene;
  scene::FrameStats stats;
  double frames_per_second = 0;
  std::optional<std::uint64_t> different;  ///< pixels on which the two pictures differ, when both are drawn
};

enum class Tone : std::uint8_t { plain, dim, accent, mark };
struct StatusPiece {
  std::string text;
  Tone tone = Tone::plain;
  bool must_show = true;  ///< false: where it would need another row, it is left out
};

/// In order: whether time passes, the scene, the mode, every knob that is not the console's, then figures.
std::vector<StatusPiece> status_pieces(const WindowState& state, const Status& status);

/// The same in rows of `columns` letters, two between pieces. What must show does: a piece longer than a row
/// goes on in the next one.
std::vector<std::vector<StatusPiece>> status_rows(const std::vector<StatusPiece>& pieces, int columns);

/// "Otter: crates, split, paused at frame 12": what lists of windows show.
std::string window_title(const WindowState& state, const std::string& scene);

}  // namespace app
