#pragma once
// What the window says in words.

#include <string>

#include "scene/frame.h"
#include "scene/knobs.h"

namespace app {

/// "ordering table, 1024 buckets, average z" or "z-buffer, 24 bits, hyperbolic": the
/// mode and what it depends on.
std::string describe(const scene::Knobs& knobs);

/// A knob's value in the words of the command line.
std::string knob_value(const scene::Knobs& knobs, std::string_view name);

/// Why a frame of a scene shows nothing; empty: something was drawn.
std::string why_empty(const scene::FrameStats& stats);

/// "12,345".
std::string with_commas(std::uint64_t number);

}  // namespace app
