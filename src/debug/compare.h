#pragma once
// Where two recordings part.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "debug/blame.h"
#include "debug/timeline.h"

namespace debug {

/// One side of a difference.
struct Side {
  Number number;     ///< command 0: the frame has no more commands, or there is no such frame
  std::string text;  ///< in words
};

/// Two recordings, frame against frame and command against command. Each part is the first of its sort.
struct Parting {
  struct OfCommands {
    Side a, b;
  };
  struct OfState {
    std::uint64_t frame = 0;             ///< at whose end
    std::vector<std::string> registers;  ///< "drawing offset: 00000000h, 0001E000h"
  };
  struct OfPixels {
    std::uint64_t frame = 0;  ///< at whose end
    std::uint64_t count = 0;
    std::uint32_t first = 0;  ///< y * 1024 + x
    std::uint16_t a = 0, b = 0;
    std::optional<Writer> writer_a, writer_b;  ///< of the first; nothing: nobody wrote it
  };
  std::optional<OfCommands> commands;
  std::optional<OfState> state;
  std::optional<OfPixels> pixels;
  std::uint64_t frames = 0, commands_compared = 0;
  bool is_complete = true;  ///< false: keep_going ended it

  [[nodiscard]] bool is_none() const { return !commands && !state && !pixels; }
};

/// Goes through all frames that both have, until a difference of each sort is found. `keep_going` is asked at
/// every frame.
Parting compare(Timeline& a, Timeline& b, const std::function<bool(std::uint64_t frame)>& keep_going = {});

}  // namespace debug
