#include "app/commands/describe.h"

namespace app {

std::string knob_value(const scene::Knobs& knobs, std::string_view name) {
  for (const auto& knob : scene::knob_table()) {
    if (knob.name == name) return knob.get(knobs);
  }
  return {};
}

std::string describe(const scene::Knobs& knobs) {
  const auto key = knob_value(knobs, "key") + " z";
  switch (knobs.visibility) {
    case scene::Visibility::ot:
      return "ordering table, " + with_commas(static_cast<std::uint64_t>(knobs.buckets)) + " buckets, " + key;
    case scene::Visibility::sorted:
      return "sorted list, " + key;
    case scene::Visibility::bsp:
      return "BSP splits";
    case scene::Visibility::zbuffer:
      break;
  }
  const auto depth = knob_value(knobs, "depth");
  return "z-buffer, " + depth + (depth == "float" ? ", " : " bits, ") + knob_value(knobs, "depth-mapping");
}

std::string with_commas(std::uint64_t number) {
  const auto digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i != 0 && (digits.size() - i) % 3 == 0) text.push_back(',');
    text.push_back(digits[i]);
  }
  return text;
}

}  // namespace app
