#pragma once
// A line on stderr while something long runs: only on a terminal, and only after two seconds.

#include <chrono>
#include <cstddef>
#include <string>

namespace app {

class Progress {
 public:
  Progress(std::string what, std::size_t steps);
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

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

}  // namespace app
