#pragma once
// The words on the window: status line, captions, help, messages. Drawn with ImGui between begin() and end()
// of the ImGuiLayer.

#include <cstdint>
#include <optional>
#include <string>

#include "app/window/layout.h"
#include "app/window/window_state.h"
#include "scene/frame.h"

namespace app {

/// What the status line tells of the last frame. Times are smoothed.
struct Status {
  std::string scene;
  scene::FrameStats stats;
  double frames_per_second = 0;
  std::optional<std::uint64_t> different;  ///< pixels on which the two pictures differ, when both are drawn
};

/// Height of the status line in pixels; `scale` as in ImGuiLayer::begin.
int status_height(float scale);

void draw_status(const WindowState& state, const Status& status, Rect bar, float scale);
/// The mode of each half over a split picture, or over one that shows differences.
void draw_captions(const WindowState& state, Rect picture, float scale);
/// The bar between the halves, with a handle.
void draw_divider(const WindowState& state, Rect picture);
void draw_help(WindowState& state, Rect area, float scale);
/// A line over the picture; `is_error`: in the warning colour.
void draw_message(const std::string& text, bool is_error, Rect area, float scale);

}  // namespace app
