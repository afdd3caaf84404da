#pragma once
// The program's memory as the console's RAM. The program is linked without position independence at 10000h,
// so that its static data, its stack (memory.cpp keeps it in static storage) and its heap (heap.cpp) have
// addresses below 8 MiB: a 24-bit link holds them, bit 23 stays the end mark, and every address means the
// same in MainRam. The runtime is a shared library and lies elsewhere.

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "ot/main_ram.h"

namespace sdk {

inline constexpr std::uint32_t memory_begin = 0x10000, memory_end = 0x800000;
inline constexpr std::size_t stack_bytes = std::size_t{512} * 1024;

/// Whether a link can hold the address.
inline bool is_linkable(const void* p) {
  const auto address = reinterpret_cast<std::uintptr_t>(p);
  return address >= memory_begin && address < memory_end;
}
/// The address in RAM of what is_linkable.
inline std::uint32_t address_of(const void* p) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(p));
}

/// What a program's own part of the runtime tells about it.
struct ProgramMemory {
  const std::byte* begin = nullptr;  ///< static data, the program's stack and heap among it
  const std::byte* end = nullptr;
  std::span<std::byte> stack;  ///< inside of it, where main() runs, on a page of its own
};
/// Of this executable. Linked into every program.
ProgramMemory program_memory();

/// Error (exit 2): the static data does not lie in memory_begin..memory_end; names where it ends.
base::Result<void> check_layout(const ProgramMemory& memory);

/// Copies static data to the same addresses of `ram` (8 MiB). Needs check_layout(). Returns the bytes copied.
std::size_t copy_memory(const ProgramMemory& memory, ot::MainRam& ram);

}  // namespace sdk
