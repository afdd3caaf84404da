#include "sdk/memory.h"

#include <cassert>
#include <cstring>
#include <string>

namespace sdk {

base::Result<void> check_layout(const ProgramMemory& memory) {
  const auto end = reinterpret_cast<std::uintptr_t>(memory.end);
  if (is_linkable(memory.begin) && end <= memory_end) return {};
  return base::fail("the program's static data ends at " + std::to_string(end) +
                    ", expected an end within the " + std::to_string(memory_end) +
                    " bytes that 24-bit links reach (built by otter_add_program?)");
}

std::size_t copy_memory(const ProgramMemory& memory, ot::MainRam& ram) {
  assert(check_layout(memory));
  const std::uint32_t begin = address_of(memory.begin) / 4, end = address_of(memory.end) / 4;
  const auto to = ram.words().subspan(begin, end - begin);
#ifdef OTTER_IS_SANITIZED
  // Word by word: AddressSanitizer forbids memcpy the gaps between variables.
  const auto* from = reinterpret_cast<const volatile std::uint32_t*>(std::uintptr_t{begin} * 4);
  for (auto& word : to) word = *from++;
#else
  std::memcpy(to.data(), reinterpret_cast<const void*>(std::uintptr_t{begin} * 4), to.size_bytes());
#endif
  return to.size_bytes();
}

}  // namespace sdk
