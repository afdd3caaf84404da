#pragma once
// What happens to a program that crashes: the signal and the call site are kept, its thread stops for ever,
// and the host goes on.

#include <string>

namespace sdk {

/// From now on the fatal signals of the calling thread, and stack overflow, end in Handover::stop(crashed).
void catch_crashes();

struct Crash {
  std::string signal;  ///< "SIGSEGV"
  std::string place;   ///< "main.c:42"
};
/// Of a program that crashed.
Crash describe_crash();

}  // namespace sdk
