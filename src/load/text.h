#pragma once
// Numbers, tokens and lines of text that nobody has checked yet.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "load/load.h"

namespace load {

/// `text` fit for one line on a terminal: control characters become '?', at most 40 bytes are kept.
inline std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out + (text.size() > 40 ? "...'" : "'");
}

/// One number, the whole token. Correctly rounded on every machine, which std::strtof in some locale is not.
/// Error: what is wrong with it, to be put behind the place.
inline base::Result<float> number(std::string_view token) {
  const std::string_view digits = token.starts_with('+') ? token.substr(1) : token;
  double value = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault == std::errc::result_out_of_range) {
    // Too large or too small to hold: an exponent below zero means the latter, and then it is nothing.
    if (token.find("e-") != token.npos || token.find("E-") != token.npos) return 0.0F;
    return base::fail(in_quotes(token) + " is beyond the limit of 1e9");
  }
  if (fault != std::errc{} || end != digits.data() + digits.size())
    return base::fail(in_quotes(token) + " is not a number");
  if (!std::isfinite(value)) return base::fail(in_quotes(token) + " is not a finite number");
  if (std::abs(value) > limits::coordinate)
    return base::fail(in_quotes(token) + " is beyond the limit of 1e9");
  return static_cast<float>(value);
}

/// One whole number, the whole token; nothing if it is none or does not fit in 32 bits.
inline std::optional<std::int32_t> whole(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  std::int32_t value = 0;
  const auto [end, fault] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (fault != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  return value;
}

/// Takes the next token off `rest`; empty at the end. Tokens stand between characters of `separators`.
inline std::string_view next_token(std::string_view& rest, std::string_view separators) {
  const std::size_t begin = std::min(rest.find_first_not_of(separators), rest.size());
  const std::size_t end = std::min(rest.find_first_of(separators, begin), rest.size());
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

/// 0..1 to 0..full, saturating, halves up.
inline std::uint8_t to_byte(float value, float full = 255) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * full + 0.5F);
}

}  // namespace load
