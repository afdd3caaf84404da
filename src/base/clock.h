#pragma once
// Time that only ever goes on.

#include <time.h>

#include <chrono>

namespace base {

/// Milliseconds since some moment that stays the same while the program runs.
inline double now_ms() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(since).count();
}

/// Processor time of this process in milliseconds: stands still while others run.
inline double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

}  // namespace base
