#include "dump/frames.h"

#include <algorithm>
#include <span>
#include <utility>

#include "ot/command_stream.h"
#include "ot/gp1.h"

namespace dump {

/// Follows the packets of a dump to where the display was told what to show after something had been drawn.
class Frames::Follower {
 public:
  struct Shown {
    std::size_t end;  // one past its packet
    std::uint32_t start;
  };

  /// Takes packets number `next` and those behind it.
  void take(const Dump& dump) {
    for (; next < dump.packets.size(); ++next) {
      const Packet& packet = dump.packets[next];
      if (packet.type == PacketType::port0 && packet.count != 0) port0(dump.payload(packet));
      if (packet.type == PacketType::port1)
        for (const auto word : dump.payload(packet)) port1(word);
      if (packet.type == PacketType::trace_begin) mark();
      if (packet.type == PacketType::vsync) vsync();
    }
  }

  std::vector<Shown> shown;
  std::size_t next = 0;  // packet
  std::vector<std::size_t>
      erased;  // ends at a VSync behind which a fill begins anew, while nothing was shown
  std::size_t last_vsync_end = 0;
  bool has_two_buffers = false;  // from now on a mark comes too late
  bool was_marked = false;       // what was taken for frames before was set-up
  [[nodiscard]] bool has_drawn() const { return has_drawn_; }
  /// Of the last one shown the start may still change.
  [[nodiscard]] bool is_ended() const { return is_ended_; }
  /// Of so many packets it is known whether they end a frame.
  [[nodiscard]] std::size_t known() const {
    if (is_ended_) return shown.back().end - 1;
    return vsync_end_ != 0 ? vsync_end_ - 1 : next;
  }

 private:
  /// The recorder says where set-up ends.
  void mark() {
    if (has_mark_ || has_two_buffers) return;
    has_mark_ = is_set_up_ = was_marked = true;
    has_drawn_ = is_ended_ = false;
    vsync_end_ = 0;
    shown.clear();
    erased.clear();
  }
  void vsync() {
    is_set_up_ = true;
    last_vsync_end = next + 1;
    if (has_drawn_ && shown.empty()) vsync_end_ = next + 1;
  }
  void port0(std::span<const std::uint32_t> words) {
    // What follows a frame's end without a command is still the frame's.
    if (is_ended_) shown.back().end = next;
    if (is_ended_ && shown.back().start != shown.front().start) has_two_buffers = true;
    is_ended_ = false;
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
    is_set_up_ = is_set_up_ || is_primitive;
    if (!ot::gp0::is_drawing(command)) return;
    has_drawn_ = has_drawn_ || is_set_up_;
    const auto end = std::exchange(vsync_end_, 0);
    if (end != 0 && command == Command::fill) erased.push_back(end);
  }
  void port1(std::uint32_t word) {
    if (ot::gp1::aborts_command(word)) stream_.abort();
    if (ot::gp1::command_of(word) != ot::gp1::Command::display_start) return;
    const auto start = ot::gp1::display_start::All::get(word);
    if (is_ended_) {  // the last word before the next frame's drawing is what is shown
      shown.back().start = start;
    } else if (has_drawn_) {
      shown.push_back({next + 1, start});
      vsync_end_ = 0;
      has_drawn_ = false;
      is_ended_ = true;
    }
  }

  ot::CommandStream stream_;
  bool has_mark_ = false;
  bool is_set_up_ = false;     // frames have begun
  bool has_drawn_ = false;     // since the last word that showed something
  bool is_ended_ = false;      // shown.back() had nothing sent to port 0 after it
  std::size_t vsync_end_ = 0;  // one past a VSync behind which nothing was drawn yet; 0: none that matters
};

Frames::Frames(FrameBy by) : by_(by), follower_(std::make_unique<Follower>()) {}
Frames::Frames(const Dump& dump, FrameBy by) : Frames(by) { extend(dump, Rest::nothing); }
Frames::~Frames() = default;
Frames::Frames(Frames&&) noexcept = default;
Frames& Frames::operator=(Frames&&) noexcept = default;

bool Frames::extend(const Dump& dump, Rest rest) {
  if (is_over_) return true;
  is_over_ = rest != Rest::to_come;
  return by_ == FrameBy::vsync ? extend_by_vsync(dump, rest) : extend_by_display(dump, rest);
}

bool Frames::is_settled() const { return is_over_ || by_ == FrameBy::vsync || follower_->has_two_buffers; }

bool Frames::extend_by_vsync(const Dump& dump, Rest rest) {
  for (std::size_t& next = follower_->next; next < dump.packets.size(); ++next)
    if (dump.packets[next].type == PacketType::vsync) end_at(next + 1);
  known_ = dump.packets.size();
  if (rest == Rest::nothing && ends_.empty()) end_at(known_);
  return true;
}

bool Frames::extend_by_display(const Dump& dump, Rest rest) {
  Follower& follower = *follower_;
  const std::size_t told = ends_.size();
  bool holds = true;
  follower.take(dump);
  if (std::exchange(follower.was_marked, false)) {
    keep_ends(0);
    counted_ = 0;
    holds = told == 0;
  }
  const auto& shown = follower.shown;
  if (shown.empty()) {
    for (std::size_t n = ends_.size(); n < follower.erased.size(); ++n) end_at(follower.erased[n]);
  } else if (counted_ == 0 && !ends_.empty()) {
    keep_ends(0);
    holds = told == 0;
  }
  const bool is_open = rest == Rest::to_come && follower.is_ended();
  const std::size_t whole = shown.size() - (is_open ? 1 : 0);
  known_ = rest == Rest::to_come ? follower.known() : follower.next;
  for (; counted_ < whole; ++counted_) {
    const bool is_other = counted_ == 0 || shown[counted_].start != shown[counted_ - 1].start;
    if (is_single_buffered_ && is_other && counted_ != 0) {
      is_single_buffered_ = false;
      keep_ends(1);
      holds = holds && told <= 1;
    }
    if (is_single_buffered_ || is_other) end_at(shown[counted_].end);
  }
  const bool has_lost = shown.empty() && follower.last_vsync_end > (ends_.empty() ? 0 : ends_.back());
  if (rest == Rest::lost && has_lost) {
    end_at(follower.last_vsync_end);
    holds = false;
  }
  if (rest != Rest::nothing) return holds;
  // What is left: drawn into a frame that was not shown, or nothing.
  const bool has_rest = follower.has_drawn() || (!shown.empty() && ends_.back() < shown.back().end);
  if (!has_rest && !ends_.empty()) keep_ends(ends_.size() - 1);
  end_at(dump.packets.size());
  return holds;
}

void Frames::end_at(std::size_t end) {
  ends_.push_back(end);
  is_end_.resize(std::max(end, is_end_.size()));
  if (end != 0) is_end_[end - 1] = true;
}

void Frames::keep_ends(std::size_t count) {
  ends_.resize(count);
  is_end_.clear();
  for (const auto end : std::exchange(ends_, {})) end_at(end);
}

std::uint64_t Frames::of_packet(std::size_t packet) const {
  return static_cast<std::uint64_t>(std::ranges::upper_bound(ends_, packet) - ends_.begin()) + 1;
}

}  // namespace dump
