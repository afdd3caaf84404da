#pragma once
// What a panel can offer for each knob: the words of knob_table(), with the open ones
// (antialias, size) spelled out.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/window/camera.h"
#include "scene/knobs.h"

namespace app {

/// The values to choose from, cheap to accurate; empty: the knob is a number.
std::vector<std::string> knob_choices(const scene::KnobInfo& knob);

struct KnobRange {
  double low, high;
  bool is_whole;
};
/// The range of a knob that is a number.
std::optional<KnobRange> knob_range(const scene::KnobInfo& knob);

/// False: with these knobs the setting changes nothing (the bits of a depth that is not there).
bool knob_matters(const scene::KnobInfo& knob, const scene::Knobs& knobs);

/// "otter render crates --frame 120 --buckets 64 -o picture.png": what draws the
/// same picture without the window. `camera`: where it was moved to.
std::string render_command(const std::string& scene, std::int64_t frame, const scene::Knobs& knobs,
                           const std::optional<CameraPlace>& camera = {});

}  // namespace app
