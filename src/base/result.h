#pragma once
// What the outside world can do to us: files, options, scenes. A hardware outcome is never an Error (it is a
// FLAG bit), and neither is a caller's mistake (it is an assert).

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace base {

/// The exit statuses of the program (0: done).
enum class Exit : int {
  failed = 1,     ///< tried and failed: output cannot be written, a limit exceeded, polygon without depth
  bad_input = 2,  ///< bad usage, unreadable or malformed input, unknown scene, no display
  interrupted = 130,
};

/// One plain sentence that names the file, the offset or option, and what was expected.
struct Error {
  std::string text;
  Exit exit = Exit::bad_input;
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string text, Exit exit = Exit::bad_input) {
  return tl::make_unexpected(Error{std::move(text), exit});
}

}  // namespace base
