#pragma once
// The marks of what is selected, on the picture and on VRAM.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/window/layout.h"
#include "debug/frame_view.h"

namespace app {

/// How strongly a selection pulses: a new one does for a while; then the window may rest.
class Pulse {
 public:
  /// 0..1, at `now` in seconds; 0 from when it has come to rest.
  double of(std::optional<std::size_t> selected, double now);

 private:
  std::optional<std::size_t> selected_;  // since begin_
  double begin_ = -1e9;
};

/// Outlines and fills the row's shapes. `pulse`, 0..1: how strongly they are filled. Nothing is drawn outside
/// `clip`.
void draw_selection(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping,
                    Rect clip, double pulse);
/// The pixel whose history is pinned.
void draw_pin(std::uint32_t pixel, const VramMapping& mapping, Rect clip);

/// The page and the palette that the row reads from, outlined on VRAM.
void draw_sources(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping, Rect clip);

}  // namespace app
