#pragma once
// Runs a program: its main() on a thread of its own, vertical blanks, and at the end the files asked for.

#include "sdk/settings.h"

namespace sdk {

/// Runs the program as `settings` say and returns the exit status: 0 done, 1 the program crashed or a file
/// cannot be written, 2 the program cannot run here. `program_main` is called once, with `name` as its only
/// argument.
int run(const Settings& settings, int (*program_main)(int, char**), const char* name);

}  // namespace sdk
