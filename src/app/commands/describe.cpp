#include "app/commands/describe.h"

namespace app {
namespace {

std::string dropped_in_words(const scene::FrameStats& stats) {
  std::string text;
  for (std::size_t reason = 0; reason < scene::drop_reasons; ++reason) {
    if (stats.dropped[reason] == 0) continue;
    text.append(text.empty() ? "" : "; ").append(with_commas(stats.dropped[reason])).append(" ");
    text.append(scene::drop_names[reason]).append(": ").append(scene::drop_reasons_in_words[reason]);
  }
  return text;
}

}  // namespace

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

std::string why_empty(const scene::FrameStats& stats) {
  if (stats.primitives != 0) return {};
  if (stats.faces == 0) return "nothing to draw: the scene has neither faces nor lines";
  return "nothing to draw: of " + with_commas(stats.faces) + " faces and lines " + dropped_in_words(stats);
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
