#pragma once
// A line on stderr while something long runs: only on a terminal, and only after two seconds.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace app {

class Progress {
 public:
  Progress(std::string what, std::size_t steps);
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` steps are done in all.
  void at(std::size_t done);
  /// One more step is done. Prints at most ten times a second: "what: 3 of 10, 12 s left".
  void step();
  /// `done` steps are done, and `seconds_left` are left by the caller's own reckoning.
  void show(std::size_t done, double seconds_left);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t steps_, done_ = 0;
  Clock::time_point begin_ = Clock::now(), printed_ = begin_;
  bool is_terminal_, shown_ = false;
};

/// The same for what cannot tell how far it is: from its third second on, "what: 12 s", each second. Silent
/// while a Progress lives, which tells more.
class Busy {
 public:
  explicit Busy(std::string what);
  ~Busy();  ///< wipes the line
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  void tell();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread thread_;  // only where stderr is a terminal
};

}  // namespace app
