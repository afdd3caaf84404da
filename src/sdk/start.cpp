// main() of a program built by otter_add_program: the linker gives the program's own the name __real_main.
// Linked into every program.

#include "sdk/memory.h"

namespace sdk {
// Of the shared library (sdk/host.h, whose own headers a program does not need).
[[noreturn]] void run_executable(int argc, char** argv, int (*program_main)(int, char**),
                                 const ProgramMemory& memory);

/// Found in the file by `otter play`.
extern const char program_mark[];
__attribute__((used)) const char program_mark[] = "otter program of the console's SDK";
}  // namespace sdk

extern "C" int __real_main(int argc, char** argv);  // NOLINT(bugprone-reserved-identifier)

extern "C" int __wrap_main(int argc, char** argv) {  // NOLINT(bugprone-reserved-identifier)
  sdk::run_executable(argc, argv, __real_main, sdk::program_memory());
}
