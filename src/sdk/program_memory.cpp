// Linked into every program: what only its own executable knows.

#include "sdk/memory.h"

// Of the linker: where initialised data begins, and where the zeroed data behind it ends.
extern "C" std::byte __data_start[], _end[];  // NOLINT(bugprone-reserved-identifier)

namespace sdk {
namespace {

constexpr std::size_t page = 4096;
alignas(page) std::byte stack[stack_bytes];

}  // namespace

ProgramMemory program_memory() { return {__data_start, _end, stack}; }

}  // namespace sdk
