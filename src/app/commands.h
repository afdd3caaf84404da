#pragma once
// The subcommands of `otter`. To add one: write its file with an `add_...` function, name it here, list it in
// CMakeLists.txt.

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "scene/error.h"

namespace app {

/// What a subcommand does once the command line is read. The value is the exit status; an Error is printed as
/// one line on stderr after the program's name, and its exit status used.
using Action = std::function<scene::Result<int>()>;

/// One row of the table. `add` declares the options on `sub` and returns the action that reads them; the
/// options' storage is owned by the action (a shared_ptr it captures). `examples` is printed under the
/// options by --help.
struct Command {
  const char* name;
  const char* help;
  Action (*add)(CLI::App& sub);
  const char* examples;
};

inline const std::vector<Command> commands{};

}  // namespace app
