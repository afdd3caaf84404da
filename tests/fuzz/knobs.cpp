// Any words as options: "name value" lines, set one after the other, then checked and printed.

#include "scene/knobs.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  scene::Knobs knobs;
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const auto line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const auto space = std::min(line.find(' '), line.size());
    (void)scene::set_knob(knobs, line.substr(0, space), line.substr(std::min(space + 1, line.size())));
  }
  (void)scene::check_knobs(knobs);
  scene::Knobs again;
  for (const auto& knob : scene::knob_table()) {
    if (!knob.set(again, knob.get(knobs)))
      __builtin_trap();  // what a knob says of itself, it must understand
  }
  if (!(again == knobs)) __builtin_trap();
  return 0;
}
