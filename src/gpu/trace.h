#pragma once
// Who wrote which pixel. A Gpu that is given a Trace notes every pixel it writes; one that is not has no
// member for it and pays nothing.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/primitive.h"
#include "gpu/vram.h"

namespace gpu {

/// One write to one pixel, or one that only the depth test prevented: a fragment that the texel, the mask bit
/// or the drawing area stops makes no event.
struct Event {
  std::uint32_t pixel = 0;  ///< y * 1024 + x
  std::uint32_t draw = 0;   ///< index into Trace::draws
  std::uint32_t depth = 0;  ///< the key the depth test compared (depth.h); 0 where nothing was tested
  std::uint16_t before = 0, after = 0;
  std::uint16_t fragment = 0;  ///< the new pixel before blending, its bit 15 included
  std::uint8_t half = 0;       ///< 1: of the second triangle of a quad
  bool blended = false;        ///< `after` was mixed with `before`; rejected: would have been
  bool rejected = false;       ///< lost the depth test: `after` is `before`, the pixel was not touched
};

/// The caller owns it and keeps it alive while a Gpu has it. The Gpu only appends and overwrites; `clear`
/// begins anew, in the middle of a command too: what is still open then goes on as a draw of the new trace.
///
/// What it may grow to is bounded, since three words can fill half a million pixels. Where the allowance ends
/// it `is_full`: later draws and events are missing, and a report of it would be wrong.
class Trace {
 public:
  /// What a draw and an event are reckoned at: their own bytes and those that judging them takes.
  static constexpr std::int64_t draw_cost = 320, event_cost = 48;
  static constexpr std::int64_t usual_allowance = std::int64_t{320} << 20;

  std::vector<std::uint32_t> last_writer = std::vector<std::uint32_t>(Vram::size);  ///< draw + 1; 0: nobody
  bool keep_history = false;
  std::vector<Event> history;          ///< every write in the order made; only with keep_history
  std::vector<Primitive> draws;        ///< decoded commands in list order; the draw number is the index
  std::vector<std::uint32_t> written;  ///< pixels that each of them wrote, repeated ones counted again
  std::uint32_t bucket = no_bucket;  ///< set by the caller before feeding a node; copied into each Primitive
  std::int64_t allowance = usual_allowance;  ///< bytes; takes effect with clear()
  bool is_full = false;

  Trace() = default;

  void clear() {
    last_writer.assign(Vram::size, 0);
    history.clear();
    draws.clear();
    written.clear();
    bucket = no_bucket;
    left_ = allowance;
    is_full = false;
    ++beginnings_;
  }

  /// Adds a draw and returns its number; when full, that of the last one there is.
  std::uint32_t enter(const Primitive& primitive) {
    if (take(draw_cost) || draws.empty()) {
      draws.push_back(primitive);
      written.push_back(0);
    }
    return static_cast<std::uint32_t>(draws.size() - 1);
  }
  void add(const Event& event) {
    if (take(event_cost)) history.push_back(event);
  }
  /// One clause for whoever has to refuse a trace that is full.
  [[nodiscard]] std::string limit_text() const {
    return "the frame has more draws and writes more pixels than the " + std::to_string(allowance >> 20) +
           " MiB of a history can hold (" + std::to_string(allowance / draw_cost) + " draws, or " +
           std::to_string(allowance / event_cost) + " pixel events)";
  }
  /// Tells the trace of one frame from that of the next: draw numbers of another are void.
  [[nodiscard]] std::uint64_t beginnings() const { return beginnings_; }

 private:
  bool take(std::int64_t bytes) {
    left_ -= bytes;
    is_full = is_full || left_ < 0;
    return !is_full;
  }

  std::int64_t left_ = usual_allowance;
  std::uint64_t beginnings_ = 1;
};

}  // namespace gpu
