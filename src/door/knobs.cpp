#include "door/knobs.h"

#include <algorithm>
#include <array>

namespace door {

namespace {

struct KnobRow {
  std::string_view name, values;
};

/// Empty values: all that the knob takes.
constexpr std::array rows{KnobRow{"visibility", "ot|zbuffer"},
                          KnobRow{"depth", ""},
                          KnobRow{"depth-mapping", ""},
                          KnobRow{"depth-test", ""},
                          KnobRow{"depth-reversed", ""},
                          KnobRow{"near", ""},
                          KnobRow{"far", ""},
                          KnobRow{"position", ""},
                          KnobRow{"texture", ""},
                          KnobRow{"filter", ""},
                          KnobRow{"colour", ""},
                          KnobRow{"antialias", ""},
                          KnobRow{"aa-filter", ""},
                          KnobRow{"aa-space", ""},
                          KnobRow{"resolution", ""}};

const scene::KnobInfo* info_of(std::string_view name) {
  const auto table = scene::knob_table();
  const auto at = std::ranges::find(table, name, &scene::KnobInfo::name);
  return at == table.end() ? nullptr : &*at;
}

bool is_among(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find('|'), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

}  // namespace

std::span<const Knob> knobs() {
  static const auto table = [] {
    std::vector<Knob> made;
    for (const KnobRow& row : rows) {
      if (const auto* info = info_of(row.name); info != nullptr)
        made.push_back({info, std::string(row.values.empty() ? info->values : row.values)});
    }
    return made;
  }();
  return table;
}

const Knob* find_knob(std::string_view name) {
  const auto table = knobs();
  const auto at = std::ranges::find(table, name, [](const Knob& knob) { return knob.info->name; });
  return at == table.end() ? nullptr : &*at;
}

bool takes(const Knob& knob, std::string_view value) {
  return knob.values == knob.info->values || is_among(knob.values, value);
}

}  // namespace door
