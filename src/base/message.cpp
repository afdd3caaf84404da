#include "base/message.h"

#include <array>
#include <atomic>
#include <cstdio>

namespace base {
namespace {

void append_escaped(std::string& out, unsigned char c) {
  switch (c) {
    case '\n':
      out += "\\n";
      return;
    case '\t':
      out += "\\t";
      return;
    case '\r':
      out += "\\r";
      return;
    default: {
      std::array<char, 8> text{};
      std::snprintf(text.data(), text.size(), "\\x%02x", c);
      out += text.data();
    }
  }
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (c < 0x20 || c == 0x7f) {
      append_escaped(out, c);
    } else if (c == 0xc2 && next >= 0x80 && next < 0xa0) {  // C1: some terminals obey these as they obey ESC
      append_escaped(out, static_cast<unsigned char>(next));
      ++i;
    } else {
      out += text[i];
    }
  }
  return out;
}

void complain(std::string_view where, std::string_view text) {
  std::fprintf(stderr, "%s: %s\n", printable(where).c_str(), printable(text).c_str());
}

void warn(std::string_view where, std::string_view text) {
  static std::atomic<int> said = 0;
  const int before = said.fetch_add(1);
  if (before < most_warnings) complain(where, text);
  if (before == most_warnings) complain(where, "more warnings follow and are left out");
}

}  // namespace base
