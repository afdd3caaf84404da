#pragma once
// What the program says on stderr: one line each, whatever is in the names it quotes.

#include <string>
#include <string_view>

namespace base {

/// `text` fit for one line on a terminal: control characters as \n, \t, \r, \x1b ..., C1 ones in UTF-8 too.
std::string printable(std::string_view text);

/// "where: text" as a line on stderr.
void complain(std::string_view where, std::string_view text);

inline constexpr int most_warnings = 100;
/// The same for what does not stop the program. After most_warnings of them, of whatever sort, one line says
/// that there are more, and no other follows.
void warn(std::string_view where, std::string_view text);

}  // namespace base
