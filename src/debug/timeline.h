#pragma once
// Time that runs both ways: any command of any frame of a recording. Its frames are found and states are kept
// along it while it is used; what is not known yet is found out when it is asked for.
//
//     debug::Timeline timeline(std::move(*recording));
//     while (timeline.index_some(4.0)) { ... }            // or not: everything works at once
//     const gpu::Gpu& gpu = timeline.seek({.frame = 12, .command = 40});

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "debug/frames.h"
#include "debug/keyframes.h"
#include "debug/number.h"
#include "debug/player.h"
#include "debug/recording.h"
#include "dump/frames.h"
#include "gpu/gpu.h"
#include "gpu/trace.h"

namespace debug {

/// As Number::command: the whole frame, what ends it included.
inline constexpr std::uint64_t whole_frame = ~std::uint64_t{0};

/// What a recording and its timeline may take in memory together; states along the way thin out. A recording
/// that takes nearly as much itself leaves 64 MiB for them.
inline constexpr std::uint64_t most_bytes = std::uint64_t{512} << 20;

/// What became of a frame that was watched.
struct Watched {
  gpu::FrameEnd end;
  std::uint64_t commands = 0;  ///< of the frame, all of them
};

class Timeline {
 public:
  explicit Timeline(Recording recording, const DrawOptions& options = {},
                    std::uint64_t limit_bytes = most_bytes);
  ~Timeline();
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// Draws in another way from now on: states along the way are made anew.
  void set_options(const DrawOptions& options);

  // --- finding out ---

  /// Reads on, finds frames and keeps states, for about so long. False: everything is known.
  bool index_some(double milliseconds);
  /// Reads until a frame is whole or the end is reached. Error (exit 2): what is wrong where no frame is
  /// whole.
  base::Result<void> read_first_frame();
  /// Reads everything. `keep_going` is asked now and then, and told how much is done, 0..1.
  /// Error: as read_first_frame().
  base::Result<void> read_all(const std::function<bool(double)>& keep_going = {});
  /// Frames end so from now on, as they did by the display until then; numbers change with it.
  void end_frames_by(dump::FrameBy by);
  /// Numbers stay as they are while more is read. Else frames by the display may be fewer when a second
  /// buffer is shown for the first time.
  [[nodiscard]] bool is_numbered() const { return frames_.is_settled(); }
  [[nodiscard]] bool is_read() const { return recording_.is_read(); }
  [[nodiscard]] bool is_indexed() const;
  /// 0..1, of reading and of keeping states.
  [[nodiscard]] double progress() const;
  /// What is wrong with the rest of a dump, in one line; empty: nothing so far. Frames before it are there.
  [[nodiscard]] const std::string& fault() const { return recording_.fault(); }

  // --- what there is ---

  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const dump::Dump& dump() const { return recording_.dump(); }
  /// Where its frames end, as far as it was read.
  [[nodiscard]] const dump::Frames& frame_ends() const { return frames_; }
  /// Frames known so far; they have the numbers 1..frames().
  [[nodiscard]] std::uint64_t frames() const { return index_.frames().size(); }
  [[nodiscard]] const Frame& frame(std::uint64_t number) const { return index_.frames()[number - 1]; }
  /// The frame that the words at `place` belong to.
  [[nodiscard]] std::uint64_t frame_at(Place place) const;
  [[nodiscard]] const DrawOptions& options() const { return options_; }
  /// How many commands frame `frame` has, 1..frames().
  [[nodiscard]] std::uint64_t commands_in(std::uint64_t frame) const {
    return index_.frames()[frame - 1].commands;
  }
  /// They stay valid until those of another frame are asked for.
  const std::vector<Command>& commands(std::uint64_t frame);
  /// Where a drawing command is, counted from 1 over all frames known; nothing: there are fewer.
  std::optional<Number> find_drawing(std::uint64_t drawing);
  /// The last command that was whole at VSync packet number `vsync`, 1..dump().vsyncs; whole_frame where a
  /// frame ends there.
  Number at_vsync(std::uint64_t vsync);
  /// With the bucket, where there is one.
  [[nodiscard]] Number number_of(std::uint64_t frame, const Command& command) const;
  /// Where a primitive comes from, stable from frame to frame: the address of its packet ("801230C4h") for a
  /// list in RAM; empty where nothing is known.
  [[nodiscard]] std::string origin_of(const Command& command) const;

  // --- any moment ---

  /// The GPU when command `number.command` of frame `number.frame` (1..frames()) has been obeyed: 0, none of
  /// the frame; whole_frame or more than there are, all. A z-buffered frame is shown with what is queued. The
  /// GPU is the timeline's, and stays as it is until the next call. Within 16 ms where states are kept.
  const gpu::Gpu& seek(const Number& number);
  /// Draws frame `frame` with `trace` set, which is cleared first, up to command `until`. Its draws tell
  /// their commands by number_of(frame, primitive).
  Watched watch(std::uint64_t frame, gpu::Trace& trace, std::uint64_t until = whole_frame);
  /// The GPU of the last seek() or watch().
  [[nodiscard]] const gpu::Gpu& gpu() const { return player_->gpu(); }
  /// What became of the polygons of the z-buffered frame that ended last on the way there.
  [[nodiscard]] const gpu::FrameEnd& frame_end() const { return player_->frame_end(); }

  [[nodiscard]] const Keyframes& keyframes() const { return keyframes_; }
  /// What is held beside the recording itself.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  [[nodiscard]] std::uint64_t allowance() const;
  [[nodiscard]] Place place_of(const Number& number);
  [[nodiscard]] Place end_of_frames() const;
  void find_frames();
  void number_anew();
  void keep_states(Place until, double deadline_ms);
  void keep_state();
  void go_to(Place place);

  Recording recording_;
  dump::Frames frames_{dump::FrameBy::display};
  DrawOptions options_;
  std::uint64_t limit_bytes_;
  FrameIndex index_;
  Keyframes keyframes_;
  double spacing_ms_;                // between two states, of drawing
  double keeping_ms_ = 0;            // of processor time, that keeping the last one took
  double since_state_ms_ = 0;        // drawn since the last one
  std::unique_ptr<Player> indexer_;  // as far as states are kept
  std::unique_ptr<Player> player_;   // where the last seek went
  bool player_can_go_on_ = true;
  std::uint64_t commands_of_ = 0;  // the frame that commands_ has; 0: none
  std::vector<Command> commands_;
};

}  // namespace debug
