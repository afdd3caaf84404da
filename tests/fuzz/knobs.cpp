// Any words as options: from the first line that begins with "-" on every line is a word of the command line;
// lines before it are "name value", set one after the other. Then the knobs are checked and printed.

#include "scene/knobs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"

namespace {

void read_command_line(std::vector<std::string> words) {
  CLI::App program("fuzz", "otter");
  scene::Knobs knobs;
  app::Arguments(program).knobs(knobs);
  try {
    std::reverse(words.begin(), words.end());  // CLI11 wants them so
    program.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    (void)app::one_line(error);
  }
  (void)scene::check_knobs(knobs);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  scene::Knobs knobs;
  std::vector<std::string> words;
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const auto line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!words.empty() || line.starts_with('-')) {
      words.emplace_back(line);
      continue;
    }
    const auto space = std::min(line.find(' '), line.size());
    (void)scene::set_knob(knobs, line.substr(0, space), line.substr(std::min(space + 1, line.size())));
  }
  if (!words.empty()) read_command_line(std::move(words));
  (void)scene::check_knobs(knobs);
  scene::Knobs again;
  for (const auto& knob : scene::knob_table()) {
    if (!knob.set(again, knob.get(knobs)))
      __builtin_trap();  // what a knob says of itself, it must understand
  }
  if (!(again == knobs)) __builtin_trap();
  return 0;
}
