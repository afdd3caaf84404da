#include "gpu/number.h"

#include <charconv>

namespace gpu {
namespace {

template <class T>
bool take(std::string_view& text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_colon(std::string_view& text) {
  if (!text.starts_with(':')) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::string to_text(const Number& number) {
  auto text = std::to_string(number.frame).append(":").append(std::to_string(number.command));
  if (number.bucket != no_bucket) text.append(":").append(std::to_string(number.bucket));
  return text;
}

std::optional<Number> parse_number(std::string_view text) {
  Number number;
  if (!take(text, number.frame) || !take_colon(text) || !take(text, number.command)) return std::nullopt;
  if (!text.empty() && (!take_colon(text) || !take(text, number.bucket))) return std::nullopt;
  return text.empty() ? std::optional(number) : std::nullopt;
}

}  // namespace gpu
