#pragma once
// Time that only ever goes on.

#include <chrono>

namespace base {

/// Milliseconds since some moment that stays the same while the program runs.
inline double now_ms() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(since).count();
}

}  // namespace base
