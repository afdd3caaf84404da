#include "sdk/console.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace sdk {

Console& the_console() {
  // Never destroyed: the program's thread may still run when the process ends.
  static auto& console = *new Console;
  return console;
}

bool is_usable(const void* p, const char* call, CallSite site) {
  constexpr std::uintptr_t first_page = 0x1000;
  const auto address = reinterpret_cast<std::uintptr_t>(p);
  if (address >= first_page) return true;
  the_console().lint.note("bad-pointer", site,
                          std::string(call) + " is given " +
                              (p == nullptr ? "a null pointer" : hex(static_cast<std::uint32_t>(address))));
  return false;
}

void after_blank() {
  auto& console = the_console();
  if (!console.callbacks_allowed) {
    console.blank_missed = true;
    return;
  }
  for (std::size_t i = 0; console.pads_run && i < console.pads.size(); ++i) {
    const auto& buffer = console.pad_buffers[i];
    const bool is_there = i == 0 || console.has_second_pad;
    const auto said = is_there ? answer(console.pads[i]) : no_answer();
    if (buffer.bytes != nullptr)
      std::memcpy(buffer.bytes, said.bytes.data(), std::min(said.count, buffer.length));
  }
  run_timers();
  if (console.on_blank != nullptr) console.on_blank();
}

}  // namespace sdk
