#pragma once
// The words on the window: status line, captions, help, messages. Drawn with ImGui between begin() and end()
// of the ImGuiLayer.

#include <cstddef>
#include <string>
#include <vector>

#include "app/window/layout.h"
#include "app/window/status.h"
#include "app/window/window_state.h"

namespace app {

/// Height of so many rows of the status line in pixels; `scale` as in ImGuiLayer::set_scale.
int status_height(float scale, std::size_t rows);
void draw_status(const std::vector<std::vector<StatusPiece>>& rows, Rect bar, float scale);
/// The mode of each half over a split picture, or over one that shows differences.
void draw_captions(const WindowState& state, Rect picture, float scale);
/// The bar between the halves, with a handle.
void draw_divider(const WindowState& state, Rect picture);
void draw_help(WindowState& state, Rect area, float scale);
/// Lines in the middle of the picture that say why there is none.
void draw_reason(const std::string& text, Rect picture);
/// A line over the picture; `is_error`: in the warning colour.
void draw_message(const std::string& text, bool is_error, Rect area, float scale);

}  // namespace app
