#pragma once
// A program that runs in a process of its own, and the window that shows it: what they tell each other over a
// socket. Both ends are the same executable, so numbers travel as they lie in memory.
//
//     window ── Orders: so many frames, with these controllers ──▶ program
//     window ◀── TakenFrame: what it sent to the GPU, and the state before ── program

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "sdk/depth_notes.h"
#include "sdk/feed.h"
#include "sdk/pads.h"
#include "sdk/program_lint.h"
#include "sdk/report.h"

namespace sdk {

/// A frame as the program's process tells it: what was sent between two vertical blanks.
struct TakenFrame {
  std::uint32_t number = 0;       ///< of the blank that ends it, from 1
  bool is_last = false;           ///< the program has ended or crashed in it
  Ending ending{};                ///< what became of the program so far
  DepthShares shares{};           ///< so far
  std::vector<Finding> findings;  ///< so far
  std::vector<std::byte> state;   ///< of the GPU before it, as gpu::Gpu::save() has it
  std::vector<SentWords> sent;
};

struct Orders {
  std::uint32_t frames = 0;                     ///< to run
  std::uint32_t kept = 0;                       ///< the last so many are told
  bool is_silent = false;                       ///< what the program prints has been printed before
  std::vector<std::array<PadState, 2>> pads{};  ///< at each of their blanks
};

/// One end of the socket.
class Line {
 public:
  /// Owns the descriptor.
  explicit Line(int socket) : socket_(socket) {}
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// False: the other end is gone.
  bool send(Orders orders);
  bool send(TakenFrame frame);
  /// So many frames have run, and are not told.
  bool send_progress(std::uint32_t frame);

  /// Waits. Nothing: the other end is gone.
  std::optional<Orders> receive_orders();

  enum class Came : std::uint8_t { nothing, progress, frame, end };
  /// What comes within `milliseconds`; a frame into `frame`, progress into its number alone.
  Came receive(TakenFrame& frame, int milliseconds);

 private:
  bool send_message(std::uint8_t kind, const std::vector<std::byte>& bytes);
  bool receive_message(std::uint8_t& kind, std::vector<std::byte>& bytes);

  int socket_;
};

}  // namespace sdk
