#pragma once
// Finds the commands in a stream of GP0 words, which packets and nodes may cut anywhere. It draws nothing:
// lists, dumps and checks that want to know where commands begin and end use it; the GPU has its own decoder,
// and a test holds the two together.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ot/gp0.h"

namespace ot {

class CommandStream {
 public:
  static constexpr std::size_t kept_words = 256;

  /// Takes one word. True: it was the last one of a command, which command(), words() and length() tell of
  /// until the next take.
  bool take(std::uint32_t word);

  /// Takes up to `available` pixel words of an open upload at once and returns how many; 0 when the next word
  /// is not one, or is the last one of the upload (take() it, to learn that the upload is whole).
  std::size_t skip_pixels(std::size_t available);

  [[nodiscard]] gp0::Command command() const { return command_; }
  /// The words of the command. An upload comes without its pixels, a polyline is cut after kept_words.
  [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
  /// All words so far, pixels included.
  [[nodiscard]] std::uint64_t length() const { return length_; }
  /// Words of the command as far as is known: more once an upload has told its size; of
  /// a polyline the first segment.
  [[nodiscard]] std::uint64_t needed() const { return needed_; }
  /// A command has begun and not ended.
  [[nodiscard]] bool is_open() const { return open_; }
  /// What GP1(00h) and GP1(01h) do: the open command is forgotten.
  void abort() { open_ = false; }

 private:
  gp0::Command command_ = gp0::Command::nop;
  std::vector<std::uint32_t> words_;
  std::uint64_t length_ = 0, needed_ = 0;
  bool open_ = false;
};

}  // namespace ot
