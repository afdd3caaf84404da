#pragma once
// A scene as a GPU dump: the words that would draw it.

#include <cstdint>
#include <functional>

#include "dump/dump.h"
#include "scene/frame.h"

namespace app {

/// Visibility bsp: packets cannot hold the pieces of split polygons, so triangles with whole corners stand
/// for them (scene/snap.h). What that costs, measured by drawing both.
struct SnapCost {
  std::uint64_t pieces = 0;  ///< that became triangles, all frames
  std::uint64_t pixels = 0;  ///< of all frames shown that differ between the live frame and the recording
  std::uint32_t worst_frame = 0;   ///< the one with the most of them,
  std::uint64_t worst_pixels = 0;  ///< and how many
  std::uint32_t largest = 0;       ///< difference of a channel, of 31
  bool operator==(const SnapCost&) const = default;
};

/// Adds frames 0 .. frames-1 with these knobs to a dump: textures and display first, then for each frame its
/// list(s), the GP1 word that shows it, and a VSync packet. Replayed on zeroed VRAM it gives what drawing the
/// same frames gives, but for what the value says. `frame_done` is called after each; false ends the
/// recording there. Error: a frame that does not fit into RAM.
base::Result<SnapCost> record(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs,
                              scene::Annotate annotate, dump::DumpWriter& dump,
                              const std::function<bool()>& frame_done = {});

}  // namespace app
