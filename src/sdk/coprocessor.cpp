// The coprocessor's macros (otter_hooks.h) on one set of registers.

#include <cstring>

#include "gte/commands.h"
#include "sdk/console.h"
#include "sdk/include/otter_hooks.h"

namespace {

constexpr unsigned flag_register = 63, first_position = 12, last_position = 15;

}  // namespace

extern "C" {

std::uint32_t otter_gte_get(unsigned number) {
  auto& console = sdk::the_console();
  if (number == flag_register) console.lint.flag_read();
  return gte::read(console.gte, number);
}

void otter_gte_put(unsigned number, std::uint32_t word) {
  auto& console = sdk::the_console();
  if (number >= first_position && number <= last_position) console.depth.write_position(number);
  gte::write(console.gte, number, word);
}

void otter_gte_do(std::uint32_t command) {
  auto& console = sdk::the_console();
  if (console.depth.is_on()) console.depth.project(console.gte, command);
  gte::execute(console.gte, command);
  // Only of projections: light and colour saturate in every frame.
  constexpr unsigned rtps = 0x01, rtpt = 0x30;
  const auto opcode = gte::Command(command).opcode();
  if (opcode == rtps || opcode == rtpt) console.lint.flag_set((console.gte.flag & gte::flag::error) != 0);
}

void otter_gte_store_xy(void* to, unsigned number) {
  auto& console = sdk::the_console();
  const std::uint32_t word = gte::read(console.gte, first_position + number);
  std::memcpy(to, &word, sizeof word);
  if (!console.depth.is_on()) return;
  const sdk::Busy busy;
  console.depth.store(reinterpret_cast<std::uintptr_t>(to), word, number);
}

}  // extern "C"
