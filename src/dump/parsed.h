#pragma once
// What reading foreign bytes gives: a value, or one clause of text and the offset it is about.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace dump {

template <class T>
struct Parsed {
  std::optional<T> value;
  std::string message;       ///< what was expected and what was there; empty with a value
  std::uint64_t offset = 0;  ///< of the first byte that is wrong

  static Parsed error(std::uint64_t at, std::string text) { return {std::nullopt, std::move(text), at}; }

  explicit operator bool() const { return value.has_value(); }
  T& operator*() { return *value; }
  T* operator->() { return &*value; }
};

}  // namespace dump
