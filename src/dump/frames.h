#pragma once
// Where a frame of a dump ends. Whoever numbers, judges or draws the frames of a dump asks here.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dump/dump.h"

namespace dump {

/// What ends a frame. [ours: a dump only says when the screen was refreshed and what the display showed]
enum class FrameBy : std::uint8_t {
  /// GP1(05h) shows another buffer: a frame that takes several refreshes is one frame. The first such word
  /// after something was drawn counts whatever it shows, since what the display stood at before is what the
  /// recorder restored. In a dump that never shows a second buffer every GP1(05h) after drawing counts; in
  /// one
  /// without any, all is one frame.
  display,
  /// Every VSync packet. Without one, all is one frame; what comes after the last belongs to none.
  vsync,
};
inline constexpr std::string_view frame_by_names[] = {"display", "vsync"};
/// Of one of these names; display for any other.
constexpr FrameBy frame_by_named(std::string_view name) {
  return name == frame_by_names[1] ? FrameBy::vsync : FrameBy::display;
}

/// The frames of a dump, numbered from 1; there is at least one. Between them they hold every packet but, by
/// vsync, those after the last VSync.
///
/// By display a frame keeps the packets that follow its end without a command to port 0, and what is drawn
/// after the last end is a frame of its own. What stands before the trace_begin mark (without one: before the
/// first VSync, polygon, rectangle or line) sets the machine up and ends nothing.
class Frames {
 public:
  explicit Frames(const Dump& dump, FrameBy by = FrameBy::display);

  [[nodiscard]] std::uint64_t count() const { return ends_.size(); }
  /// Packets of frame n, 1..count(): from begin to before end.
  [[nodiscard]] std::size_t begin(std::uint64_t n) const { return n == 1 ? 0 : end(n - 1); }
  [[nodiscard]] std::size_t end(std::uint64_t n) const { return ends_[n - 1]; }
  /// The frame of a packet, from 1; count() + 1 beyond the last.
  [[nodiscard]] std::uint64_t of_packet(std::size_t packet) const;

 private:
  std::vector<std::size_t> ends_;
};

}  // namespace dump
