#pragma once
// Depth for polygons of a program that knows nothing of it: by the values that its GTE has just projected.

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ot/command_stream.h"
#include "ot/packet.h"

namespace door {

/// Projected vertices by their screen word, of this list and the one before: a program builds one list while
/// the other is drawn.
class VertexDepths {
 public:
  struct Value {
    std::uint32_t z;  ///< 20.12
    std::uint8_t fx, fy;
    bool is_doubtful;  ///< another vertex with another depth lies on the same pixel
  };

  void tell(std::uint32_t xy, std::uint32_t z, std::uint8_t fx, std::uint8_t fy);
  /// nullptr: nobody told of it.
  [[nodiscard]] const Value* find(std::uint32_t xy) const;
  void end_list();
  [[nodiscard]] bool is_empty() const { return now_.empty() && before_.empty(); }

 private:
  std::unordered_map<std::uint32_t, Value> now_, before_;
};

struct DepthShares {
  std::uint64_t polygons = 0, with_depth = 0, partly = 0, doubtful = 0;
};

/// Puts annotation words before the polygons of a stream of GP0 words. Until the first vertex is told, words
/// go through untouched and unread. A polygon that is cut between calls is held back until it is whole;
/// release() sends what is held, without depth.
class Annotator {
 public:
  void tell(std::uint32_t xy, std::uint32_t z, std::uint8_t fx, std::uint8_t fy) {
    depths_.tell(xy, z, fx, fy);
  }
  /// A list with polygons has ended.
  void end_list();
  /// From now on commands are followed, whether vertices are told or not; `sink` is called anew where the
  /// drawing area or offset has changed. Takes effect between commands.
  void follow(bool always) { follows_always_ = always; }

  [[nodiscard]] const DepthShares& shares() const { return shares_; }
  [[nodiscard]] bool holds_words() const { return !held_.empty(); }

  /// Calls sink(words) one or more times. `is_between_commands`: of whatever the words go to.
  template <class Sink>
  void feed(std::span<const std::uint32_t> words, bool is_between_commands, Sink&& sink) {
    if (!is_following_) {
      if ((depths_.is_empty() && !follows_always_) || !is_between_commands) return sink(words);
      is_following_ = true;
      stream_ = {};
    }
    Cutter<Sink> out{words, sink};
    while (out.at < words.size()) step(out);
    out.cut();
  }

  template <class Sink>
  void release(Sink&& sink) {
    if (held_.empty()) return;
    const std::vector<std::uint32_t> words = std::exchange(held_, {});
    forget();
    sink(std::span<const std::uint32_t>(words));
  }
  /// What is open was aborted.
  void abort();
  /// The words went elsewhere: following begins anew.
  void forget();

 private:
  /// What was read of the caller's words, and what of that was sent.
  template <class Sink>
  struct Cutter {
    std::span<const std::uint32_t> words;
    Sink& sink;
    std::size_t at = 0, sent = 0;
    void cut() {
      if (at > sent) sink(words.subspan(sent, at - sent));
      sent = at;
    }
  };

  template <class Sink>
  void step(Cutter<Sink>& out) {
    namespace gp0 = ot::gp0;
    const std::span<const std::uint32_t> rest = out.words.subspan(out.at);
    if (!held_.empty()) {
      hold(rest[0]);
      ++out.at;
      out.sent = out.at;
      if (held_.size() < gp0::command_words(held_[0])) return;
      send_annotation(held_, out.sink);
      out.sink(std::span<const std::uint32_t>(held_));
      held_.clear();
    } else if (stream_.is_open()) {
      const std::size_t pixels = stream_.skip_pixels(rest.size());
      if (pixels == 0) stream_.take(rest[0]);
      out.at += pixels == 0 ? 1 : pixels;
    } else {
      begin_command(out, rest);
    }
  }

  template <class Sink>
  void begin_command(Cutter<Sink>& out, std::span<const std::uint32_t> rest) {
    namespace gp0 = ot::gp0;
    const gp0::Command command = gp0::command_of(rest[0]);
    const std::size_t length = gp0::command_words(rest[0]);
    if (command == gp0::Command::polygon) {
      out.cut();
      if (rest.size() < length) {
        hold(rest[0]);
        out.sent = ++out.at;
        return;
      }
      send_annotation(rest.first(length), out.sink);
      out.at += length;
    } else if (length == 1 || (length <= rest.size() && command != gp0::Command::upload &&
                               command != gp0::Command::polyline)) {
      out.at += length;
      brings_depth_ = brings_depth_ || command == gp0::Command::annotation;
      if (command >= gp0::Command::area_top_left && command <= gp0::Command::draw_offset) out.cut();
    } else {
      stream_.take(rest[0]);
      ++out.at;
    }
  }

  template <class Sink>
  void send_annotation(std::span<const std::uint32_t> polygon, Sink&& sink) {
    std::array<std::uint32_t, ot::gp0::annotation::max_words> words;
    if (const std::size_t count = annotation_of(polygon, words); count != 0)
      sink(std::span<const std::uint32_t>(words).first(count));
  }

  void hold(std::uint32_t word) { held_.push_back(word); }
  /// Words of the annotation; 0: none.
  std::size_t annotation_of(std::span<const std::uint32_t> polygon, std::span<std::uint32_t> out);

  VertexDepths depths_;
  DepthShares shares_;
  ot::CommandStream stream_;
  std::vector<std::uint32_t> held_;
  std::uint64_t polygons_before_list_ = 0;
  bool is_following_ = false, follows_always_ = false;
  bool brings_depth_ = false;  // the next polygon has annotation words of its own
};

}  // namespace door
