#pragma once
// Which of the program's knobs a stream of words can honour.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/knobs.h"

namespace door {

struct Knob {
  const scene::KnobInfo* info;
  std::string values;  ///< "ot|zbuffer": of what the knob takes, what a stream can honour
};

std::span<const Knob> knobs();
/// nullptr: no such knob, or one that only a scene can honour.
const Knob* find_knob(std::string_view name);
/// Whether a stream can honour the value, if the knob takes it.
bool takes(const Knob& knob, std::string_view value);

}  // namespace door
