#include "sdk/memory.h"

#include <cassert>
#include <string>

// Of the linker: where initialised data begins, and where the zeroed data behind it ends.
extern "C" char __data_start[], _end[];  // NOLINT(bugprone-reserved-identifier)

namespace sdk {
namespace {

alignas(4096) std::byte stack[stack_bytes];

}  // namespace

base::Result<void> check_layout() {
  const auto end = reinterpret_cast<std::uintptr_t>(_end);
  if (is_linkable(__data_start) && end <= memory_end) return {};
  return base::fail("the program's static data ends at " + std::to_string(end) +
                    ", expected an end within the " + std::to_string(memory_end) +
                    " bytes that 24-bit links reach (built by otter_add_program?)");
}

std::size_t copy_memory(ot::MainRam& ram) {
  assert(check_layout());
  const std::uint32_t begin = address_of(__data_start) / 4, end = address_of(_end) / 4;
  // Word by word and not by memcpy: AddressSanitizer forbids memcpy the gaps between variables.
  const auto* from = reinterpret_cast<const volatile std::uint32_t*>(std::uintptr_t{begin} * 4);
  const auto to = ram.words().subspan(begin, end - begin);
  for (auto& word : to) word = *from++;
  return to.size_bytes();
}

std::span<std::byte> program_stack() { return stack; }

}  // namespace sdk
