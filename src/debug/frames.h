#pragma once
// Where the frames of a recording begin and end, and the commands in them.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "debug/recording.h"
#include "dump/dump.h"
#include "dump/frames.h"
#include "ot/command_stream.h"

namespace debug {

/// Between two words of a recording: the next one is word `word` of packet `packet`.
struct Place {
  std::size_t packet = 0;
  std::uint32_t word = 0;
  auto operator<=>(const Place&) const = default;
};

struct Frame {
  std::size_t first_packet = 0, end_packet = 0;  ///< the packet that ends it is the last of them
  std::uint32_t commands = 0;
  std::uint64_t drawing_before = 0;  ///< drawing commands of all frames before it
};

/// One command, as debug::Number counts them.
struct Command {
  std::uint32_t number = 0;   ///< K, from 1
  bool is_control = false;    ///< a word of port 1
  std::uint64_t drawing = 0;  ///< number among all drawing commands of the recording, from 1; 0: it draws not
  std::uint32_t first = 0;    ///< its first word, index into Dump::words
  Place begin, end;           ///< an end that lies in a later frame is cut to that of this one
};

/// Finds frames and their commands in packets that may still be coming.
class FrameIndex {
 public:
  /// Takes the packets that have come since the last call; `frames` has taken them, too, and ends none of
  /// those before elsewhere. With Rest::nothing what is behind the last end is a frame of its own, if there
  /// are commands in it or if it is the only one.
  void extend(const dump::Dump& dump, const dump::Frames& frames, dump::Frames::Rest rest);

  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  /// The commands of frame `index`, from 0.
  [[nodiscard]] std::vector<Command> commands(const dump::Dump& dump, std::size_t index) const;

 private:
  std::vector<Frame> frames_;
  friend class Scanner;
  /// How far the command is that the words have come to.
  struct Open {
    ot::CommandStream stream;
    Place begin;
    std::uint32_t first = 0;
  };
  std::map<std::size_t, Open> open_;  // by frame: a command that was begun before it
  Open now_;
  Frame next_;  // of which the end has not come
  std::size_t packets_ = 0;
  std::uint64_t drawings_ = 0;
  bool is_all_ = false;
};

/// The words of a command: of an upload without its pixels, of a polyline the first few hundred.
std::vector<std::uint32_t> words_of(const dump::Dump& dump, const Command& command);
/// All words of a command, pixels included.
std::vector<std::uint32_t> all_words_of(const dump::Dump& dump, const Command& command);
/// In words: "triangle, gouraud (0,0) ...".
std::string describe(const dump::Dump& dump, const Command& command);
/// Byte of the unpacked dump where its first word lies; 0 for a list in RAM.
std::uint64_t offset_of(const dump::Dump& dump, const Command& command);

}  // namespace debug
