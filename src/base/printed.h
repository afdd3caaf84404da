#pragma once
// What printf prints, as a string.

#include <array>
#include <cstdio>
#include <string>

namespace base {

/// At most 255 characters: of what does not fit the beginning.
template <class... Values>
std::string printed(const char* pattern, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

}  // namespace base
