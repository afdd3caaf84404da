#pragma once
// Runs a program: its main() on a thread of its own, vertical blanks, and at the end the files asked for.

#include "sdk/memory.h"
#include "sdk/settings.h"

namespace sdk {

/// Runs the program as `settings` say and returns the exit status: 0 done, 1 the program crashed or a file
/// cannot be written, 2 the program cannot run here. `program_main` is called once, with `name` as its only
/// argument.
int run(const Settings& settings, int (*program_main)(int, char**), const char* name,
        const ProgramMemory& memory);

/// What main() of a program's executable does: reads the command line, runs, ends the process.
[[noreturn]] void run_executable(int argc, char** argv, int (*program_main)(int, char**),
                                 const ProgramMemory& memory);

}  // namespace sdk
