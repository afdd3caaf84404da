#pragma once
// Where a frame of a dump ends. Whoever numbers, judges or draws the frames of a dump asks here.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "dump/dump.h"

namespace dump {

/// What ends a frame. [ours: a dump only says when the screen was refreshed and what the display showed]
enum class FrameBy : std::uint8_t {
  /// GP1(05h) shows another buffer: a frame that takes several refreshes is one frame. The first such word
  /// after something was drawn counts whatever it shows, since what the display stood at before is what the
  /// recorder restored. In a dump that never shows a second buffer every GP1(05h) after drawing counts.
  /// In one without any, a VSync counts if the first thing drawn after it is a fill, as by programs with one
  /// buffer; otherwise all is one frame.
  display,
  /// Every VSync packet. Without one, all is one frame; what comes after the last belongs to none.
  vsync,
};
inline constexpr std::string_view frame_by_names[] = {"display", "vsync"};
/// Of one of these names; display for any other.
constexpr FrameBy frame_by_named(std::string_view name) {
  return name == frame_by_names[1] ? FrameBy::vsync : FrameBy::display;
}

/// The frames of a dump, numbered from 1; once all of it was taken there is at least one. Between them they
/// hold every packet but, by vsync, those after the last VSync.
///
/// By display a frame keeps the packets that follow its end without a command to port 0, and what is drawn
/// after the last end is a frame of its own. What stands before the trace_begin mark (without one before a
/// second buffer is shown: before the first VSync, polygon, rectangle or line) sets the machine up and ends
/// nothing.
class Frames {
 public:
  explicit Frames(FrameBy by);
  explicit Frames(const Dump& dump, FrameBy by = FrameBy::display);
  ~Frames();
  Frames(Frames&&) noexcept;
  Frames& operator=(Frames&&) noexcept;

  /// What stands behind the packets that there are.
  enum class Rest : std::uint8_t {
    to_come,  ///< others
    nothing,  ///< what they draw after the last end is a frame
    lost,  ///< the dump is damaged: a frame that was not ended is none; where no frame was, a VSync ends one
  };
  /// Takes the packets that were not taken yet. False: a frame taken before ends elsewhere than it was said
  /// to, as when a second buffer is shown for the first time: all have to be asked for again. The last end
  /// may move back with the last packets, which send nothing that draws; that alone counts as true.
  bool extend(const Dump& dump, Rest rest);
  /// Of so many packets it is known whether a frame ends with them.
  [[nodiscard]] std::size_t known() const { return known_; }
  /// extend() will return true from now on.
  [[nodiscard]] bool is_settled() const;

  [[nodiscard]] FrameBy by() const { return by_; }
  [[nodiscard]] std::uint64_t count() const { return ends_.size(); }
  /// Packets of frame n, 1..count(): from begin to before end.
  [[nodiscard]] std::size_t begin(std::uint64_t n) const { return n == 1 ? 0 : end(n - 1); }
  [[nodiscard]] std::size_t end(std::uint64_t n) const { return ends_[n - 1]; }
  /// The frame of a packet, from 1; count() + 1 beyond the last.
  [[nodiscard]] std::uint64_t of_packet(std::size_t packet) const;
  /// Whether a frame ends with this packet.
  [[nodiscard]] bool ends_with(std::size_t packet) const {
    return packet < is_end_.size() && is_end_[packet];
  }

 private:
  class Follower;

  bool extend_by_display(const Dump& dump, Rest rest);
  bool extend_by_vsync(const Dump& dump, Rest rest);
  void end_at(std::size_t end);
  void keep_ends(std::size_t count);

  FrameBy by_;
  std::vector<std::size_t> ends_;
  std::vector<bool> is_end_;  // by packet, up to the last end
  std::unique_ptr<Follower> follower_;
  std::size_t known_ = 0;
  std::size_t counted_ = 0;         // of what was shown
  bool is_single_buffered_ = true;  // as far as counted
  bool is_over_ = false;
};

}  // namespace dump
