#include "app/commands/options.h"

#include <algorithm>
#include <string>

namespace app {
namespace {

void set_or_throw(scene::Knobs& knobs, const std::string& name, const std::string& value) {
  if (const auto set = scene::set_knob(knobs, name, value); !set) {
    throw CLI::ValidationError(set.error().text, CLI::ExitCodes::ValidationError);
  }
}

}  // namespace

void add_knobs(CLI::App& sub, scene::Knobs& knobs, std::initializer_list<std::string_view> names) {
  for (const auto& knob : scene::knob_table()) {
    if (names.size() != 0 && std::find(names.begin(), names.end(), knob.name) == names.end()) continue;
    const std::string name(knob.name);
    CLI::Option* option = nullptr;
    if (knob.values == "off|on") {
      option = sub.add_flag_callback(
          "--" + name, [&knobs, name] { set_or_throw(knobs, name, "on"); }, std::string(knob.help));
    } else {
      option = sub.add_option_function<std::string>(
          "--" + name, [&knobs, name](const std::string& value) { set_or_throw(knobs, name, value); },
          std::string(knob.help) + " [" + knob.get(knobs) + "]");
      option->type_name(std::string(knob.values))->take_last();
    }
    option->group("Knobs");
  }
}

std::string one_line(const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace app
