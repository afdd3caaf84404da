#pragma once
// A program that runs in a process of its own, frame by frame, with what its controllers did: any frame can
// be gone back to, for the same program with the same controllers comes to it again.

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "debug/clip.h"
#include "sdk/remote.h"
#include "sdk/settings.h"

namespace sdk {

/// A frame taken out of the program, ready to be drawn.
struct RunFrame {
  std::uint32_t number = 0;
  debug::Clip clip;
  std::uint64_t drawing = 0;  ///< drawing commands in it
};

class ProgramRun {
 public:
  /// Nothing runs yet. `name`: of the program, for messages.
  ProgramRun(Settings settings, std::string name);
  ~ProgramRun();
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  /// Makes frame `number`, from 1, the one at hand: goes on to it, or runs the program again from its
  /// beginning. False: not in so many milliseconds; asked for again it goes on. Error: the program's process
  /// cannot be made.
  base::Result<bool> go_to(std::uint32_t number, int milliseconds);

  /// The frame, or the last one before it that draws anything; nullptr: neither is held.
  [[nodiscard]] const RunFrame* frame(std::uint32_t number) const;
  [[nodiscard]] const RunFrame* frame_drawn(std::uint32_t number) const;

  /// What the controllers hold at the blanks of frames to come. Of frames that have been: what was held then,
  /// until a button is pressed that was not: from there on it is the user's, and later frames are forgotten.
  void hold(const PadState& pad) { held_ = pad; }

  /// The furthest frame so far; 0: none.
  [[nodiscard]] std::uint32_t last() const { return last_; }
  /// 0..1, of the way that go_to() has begun.
  [[nodiscard]] double progress() const;
  [[nodiscard]] bool has_ended() const { return ending_.has_value(); }
  /// "faults.c:9: SIGSEGV in frame 12", "ended in frame 90", or empty while it goes on.
  [[nodiscard]] std::string ending() const;
  /// What the controllers did, as --pad takes it.
  [[nodiscard]] std::string pad_log() const;

  /// Keeps what is sent from the next frame on; again: writes it to `path` of the first call. What was done.
  base::Result<std::string> record(const std::string& path);

 private:
  base::Result<void> start();
  void stop();
  void order(std::uint32_t until);
  void take(TakenFrame& taken);
  void read_on(int milliseconds);
  [[nodiscard]] std::array<PadState, 2> pads_at(std::uint32_t number);
  void take_over(std::uint32_t number);
  [[nodiscard]] std::string place_of(CallSite site);
  void name_origins(debug::Clip& clip, const std::vector<SentWords>& sent);
  [[nodiscard]] std::vector<std::string> notes_of(const TakenFrame& taken) const;
  void add_to_recording(const RunFrame& frame);
  base::Result<std::string> write_recording();

  Settings settings_;
  std::string name_;
  pid_t process_ = 0;
  std::unique_ptr<Line> line_;
  std::uint32_t reached_ = 0;  // by the process, as far as is known here
  std::uint32_t ordered_ = 0;  // until there
  std::uint32_t began_ = 0;    // the order
  std::uint32_t last_ = 0;
  std::uint32_t shown_ = 0;  // asked for last
  std::deque<RunFrame> held_frames_;
  PadState held_;
  std::vector<std::array<PadState, 2>> log_;  // at the blank of frame n: log_[n - 1]
  struct End {
    std::uint32_t frame = 0;
    Ending how;
  };
  std::optional<End> ending_;
  std::vector<std::pair<CallSite, std::string>> places_;
  struct Recording {
    std::string path;
    dump::Dump dump;
    std::uint32_t first = 0, next = 0;
  };
  std::optional<Recording> recording_;
};

}  // namespace sdk
