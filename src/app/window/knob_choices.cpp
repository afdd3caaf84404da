#include "app/window/knob_choices.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string_view>

namespace app {
namespace {

using std::string_view;

std::vector<std::string> split(string_view text, char at) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(at);
    parts.emplace_back(text.substr(0, end));
    if (end == string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

bool is_one_of(string_view name, std::initializer_list<string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool means_something_to_a_shell(char c) {
  return string_view(" '\"\\$`&;|<>()*?[]#~!{}").find(c) != string_view::npos;
}

std::string quoted(const std::string& word) {
  if (!word.empty() && std::none_of(word.begin(), word.end(), means_something_to_a_shell)) return word;
  std::string out = "'";
  for (const char c : word) c == '\'' ? out.append("'\\''") : out.append(1, c);
  return out + "'";
}

}  // namespace

std::vector<std::string> knob_choices(const scene::KnobInfo& knob) {
  if (knob.name == "antialias") {
    return {"none",      "ssaa-2x2",   "ssaa-3x3",   "ssaa-4x4", "ssaa-8x8",  "rotated-4",
            "rotated-8", "rotated-16", "rotated-64", "random-4", "random-16", "random-64",
            "msaa-2",    "msaa-4",     "msaa-8",     "fxaa",     "taa"};
  }
  if (knob.name == "subdivide") {
    return {"1",       "2",       "3",       "4",       "6",       "8",       "16",
            "size-64", "size-32", "size-16", "error-8", "error-4", "error-2", "error-1"};
  }
  if (knob.name == "size") {
    std::vector<std::string> sizes;
    for (const auto* height : {"x240", "x480"}) {
      for (const auto* width : {"256", "320", "368", "512", "640"})
        sizes.push_back(std::string(width) + height);
    }
    return sizes;
  }
  if (knob.values.find('|') == string_view::npos) return {};
  return split(knob.values, '|');
}

std::optional<KnobRange> knob_range(const scene::KnobInfo& knob) {
  const auto dots = knob.values.find("..");
  if (dots == string_view::npos || knob.values.find('|') != string_view::npos) return std::nullopt;
  KnobRange range{0, 0, knob.values.find('e') == string_view::npos};
  std::from_chars(knob.values.data(), knob.values.data() + dots, range.low);
  std::from_chars(knob.values.data() + dots + 2, knob.values.data() + knob.values.size(), range.high);
  return range;
}

bool knob_matters(const scene::KnobInfo& knob, const scene::Knobs& knobs) {
  using scene::Visibility;
  const auto mode = knobs.visibility;
  if (is_one_of(knob.name, {"buckets", "bias", "bucket-order"}))
    return mode == Visibility::ot || mode == Visibility::zbuffer;
  if (knob.name == "key") return mode != Visibility::bsp;
  if (knob.name.starts_with("depth") || is_one_of(knob.name, {"near", "far", "without-depth"})) {
    return mode == Visibility::zbuffer;
  }
  if (knob.name == "aa-filter") {
    const auto kind = knobs.antialias.kind;
    return kind == scene::AntialiasKind::ssaa || kind == scene::AntialiasKind::rotated ||
           kind == scene::AntialiasKind::random;
  }
  if (knob.name == "aa-space") {
    return knobs.antialias.kind != scene::AntialiasKind::off &&
           knobs.antialias.kind != scene::AntialiasKind::fxaa;
  }
  return true;
}

std::string render_command(const std::string& scene, std::int64_t frame, const scene::Knobs& knobs,
                           const std::optional<CameraPlace>& camera) {
  std::string line = "otter render " + quoted(scene);
  if (frame != 0) line += " --frame " + std::to_string(frame);
  if (camera) line += " --camera=" + to_text(*camera);  // with =, for it may begin with a minus
  const scene::Knobs console;
  for (const auto& knob : scene::knob_table()) {
    const auto value = knob.get(knobs);
    if (value == knob.get(console)) continue;
    line.append(" --").append(knob.name);
    if (knob.values != "off|on") line.append(" ").append(value);
  }
  return line + " -o picture.png";
}

}  // namespace app
