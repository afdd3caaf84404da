#pragma once
// How much of a long test is done where every memory access is checked and takes ten times as long.

namespace tests {

#ifdef OTTER_IS_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

/// `whole`, or `part` of it under the sanitizers.
constexpr int amount(int whole, int part) { return is_sanitized ? part : whole; }

}  // namespace tests
