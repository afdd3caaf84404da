#include "dump/frames.h"

#include <algorithm>

#include "ot/command_stream.h"
#include "ot/gp1.h"

namespace dump {
namespace {

/// Where the display was told what to show after something had been drawn.
struct Shown {
  std::size_t end;  // one past its packet
  std::uint32_t start;
};

/// Follows the packets of a dump to where set-up ends and frames are shown.
class Follower {
 public:
  explicit Follower(const Dump& dump) : dump_(dump) {
    is_set_up_ = std::ranges::none_of(
        dump.packets, [](const Packet& packet) { return packet.type == PacketType::trace_begin; });
    has_mark_ = !is_set_up_;
    is_set_up_ = false;
  }

  void take(std::size_t index) {
    const Packet& packet = dump_.packets[index];
    switch (packet.type) {
      case PacketType::port0:
        if (!dump_.payload(packet).empty()) port0(index);
        break;
      case PacketType::port1:
        for (const auto word : dump_.payload(packet)) port1(index, word);
        break;
      case PacketType::trace_begin:
        is_set_up_ = true;
        break;
      case PacketType::vsync:
        is_set_up_ = is_set_up_ || !has_mark_;
        break;
      default:
        break;
    }
  }

  std::vector<Shown> shown;
  [[nodiscard]] bool has_drawn() const { return has_drawn_; }

 private:
  void port0(std::size_t index) {
    // What follows a frame's end without a command is still the frame's.
    if (is_ended_) shown.back().end = index;
    is_ended_ = false;
    const auto words = dump_.payload(dump_.packets[index]);
    for (std::size_t n = 0; n < words.size(); ++n) {
      n += stream_.skip_pixels(words.size() - n);
      if (n == words.size()) return;
      if (stream_.take(words[n])) command(stream_.command());
    }
  }
  void command(ot::gp0::Command command) {
    using ot::gp0::Command;
    const bool is_primitive = command == Command::polygon || command == Command::rectangle ||
                              command == Command::line || command == Command::polyline;
    is_set_up_ = is_set_up_ || (is_primitive && !has_mark_);
    has_drawn_ = has_drawn_ || (is_set_up_ && ot::gp0::is_drawing(command));
  }
  void port1(std::size_t index, std::uint32_t word) {
    if (ot::gp1::aborts_command(word)) stream_.abort();
    if (ot::gp1::command_of(word) != ot::gp1::Command::display_start) return;
    const auto start = ot::gp1::display_start::All::get(word);
    if (is_ended_) {  // the last word before the next frame's drawing is what is shown
      shown.back().start = start;
    } else if (has_drawn_) {
      shown.push_back({index + 1, start});
      has_drawn_ = false;
      is_ended_ = true;
    }
  }

  const Dump& dump_;
  ot::CommandStream stream_;
  bool has_mark_ = false;   // the dump says itself where set-up ends
  bool is_set_up_ = false;  // frames have begun
  bool has_drawn_ = false;  // since the last word that showed something
  bool is_ended_ = false;   // shown.back() had nothing sent to port 0 after it
};

std::vector<std::size_t> ends_by_display(const Dump& dump) {
  Follower follower(dump);
  for (std::size_t index = 0; index < dump.packets.size(); ++index) follower.take(index);
  const auto& shown = follower.shown;
  const bool is_single_buffered =
      std::ranges::all_of(shown, [&](const Shown& s) { return s.start == shown.front().start; });
  std::vector<std::size_t> ends;
  std::uint32_t start = 0;
  for (const Shown& s : shown) {
    if (ends.empty() || is_single_buffered || s.start != start) ends.push_back(s.end);
    start = s.start;
  }
  // What is left: drawn into a frame that was not shown, or nothing.
  const bool has_rest = follower.has_drawn() || (!shown.empty() && ends.back() < shown.back().end);
  if (ends.empty() || has_rest) {
    ends.push_back(dump.packets.size());
  } else {
    ends.back() = dump.packets.size();
  }
  return ends;
}

std::vector<std::size_t> ends_by_vsync(const Dump& dump) {
  std::vector<std::size_t> ends;
  for (std::size_t index = 0; index < dump.packets.size(); ++index) {
    if (dump.packets[index].type == PacketType::vsync) ends.push_back(index + 1);
  }
  if (ends.empty()) ends.push_back(dump.packets.size());
  return ends;
}

}  // namespace

Frames::Frames(const Dump& dump, FrameBy by)
    : ends_(by == FrameBy::display ? ends_by_display(dump) : ends_by_vsync(dump)) {}

std::uint64_t Frames::of_packet(std::size_t packet) const {
  return static_cast<std::uint64_t>(std::ranges::upper_bound(ends_, packet) - ends_.begin()) + 1;
}

}  // namespace dump
