#pragma once
// What a run tells at its end.

#include <cstdint>
#include <string>

#include "sdk/console.h"
#include "sdk/settings.h"

namespace sdk {

/// How the program came to its end.
struct Ending {
  enum class Kind : std::uint8_t { reached, ended, crashed } kind = Kind::reached;
  std::string signal;         ///< crashed: "SIGSEGV"
  std::string place;          ///< crashed: "main.c:42"
  bool never_waited = false;  ///< no VSync: the clock made the blanks
};

/// Lines for people: how the run ended, what was drawn, shares of depth if any were asked for, findings.
std::string to_text(Console& console, const Ending& ending, const std::string& program);

/// {"schema":"otter.play/1", ...}
std::string to_json(Console& console, const Ending& ending, const std::string& program);

}  // namespace sdk
