#pragma once
// A running program's frames on their way to a window in another process, and what the window asks of the
// program. Both ends are of one build: a socket between them carries frames one way, requests the other.
//
//     frame     its length in bytes as 8 bytes, then to_bytes()
//     request   LiveRequest, as it is

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "inspect/lint.h"

namespace door {

/// Words that came from one place.
struct LiveRun {
  bool is_control = false;    ///< one word of port 1
  bool is_list = false;       ///< from a packet of a list in RAM
  std::uint32_t address = 0;  ///< of its tag
  std::uint32_t bucket = 0;   ///< gpu::no_bucket: none
  std::uint32_t words = 0;
};

/// Everything that was sent from one change of the picture shown to the next, with annotation words where the
/// program's vertices are known.
struct LiveFrame {
  std::uint64_t number = 0;      ///< from 1; frames that nobody could take have numbers, too
  bool is_recording = false;     ///< what the program sends goes into a file, too
  std::uint32_t buckets = 0;     ///< of the longest table; 0: none was found
  std::uint64_t doubtful = 0;    ///< polygons of which a vertex shares its pixel with one of another depth
  std::vector<std::byte> state;  ///< of the GPU before, as gpu::Gpu::save() has it
  std::vector<LiveRun> runs;
  std::vector<std::uint32_t> words;  ///< of all runs
  std::vector<inspect::LintItem> lint;
};

/// More than any frame takes; who announces more is not to be listened to.
inline constexpr std::uint64_t most_frame_bytes = std::uint64_t{256} << 20;

std::vector<std::byte> to_bytes(const LiveFrame& frame);
/// Error: cut short, or numbers in it that contradict one another.
base::Result<LiveFrame> live_frame_of(std::span<const std::byte> bytes);

enum class LiveAsk : std::uint32_t {
  pause,         ///< 1: the program waits at its next vertical blank; 0: it goes on
  step,          ///< goes on until it has sent one more frame
  pace,          ///< index into live_paces
  fast,          ///< 1: as fast as it can; 0: at its pace
  record,        ///< begins or ends a recording
  key_down,      ///< X11's keysym
  key_up,        ///< likewise
  close_program  ///< the user has closed the window
};
struct LiveRequest {
  LiveAsk what = LiveAsk::pause;
  std::uint32_t value = 0;
};
static_assert(sizeof(LiveRequest) == 8);

/// Fields a second; 0: the console's, by its video mode.
inline constexpr double live_paces[] = {0, 60, 50, 6};

}  // namespace door
