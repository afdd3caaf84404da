#pragma once
// The demo scenes: small, readable, each about one idea.

#include <span>
#include <string_view>

#include "scene/world.h"

namespace demos {

struct Entry {
  std::string_view name;   ///< "crates"
  std::string_view title;  ///< "Textured crates, spinning"
  std::string_view shows;  ///< one sentence: what to look for
  scene::Scene (*make)();
};

/// All demos, in the order in which they are best seen.
std::span<const Entry> all();
/// By name; nullptr: no such demo.
const Entry* find(std::string_view name);
/// The scene of an entry, its names filled in.
scene::Scene make(const Entry& entry);

}  // namespace demos
