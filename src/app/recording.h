#pragma once
// A scene as a GPU dump: the words that would draw it.

#include <cstdint>
#include <functional>

#include "gpu/dump.h"
#include "scene/frame.h"

namespace app {

/// Frames 0 .. frames-1 with these knobs: textures and display first, then for each frame its list(s), the
/// GP1 word that shows it, and a VSync packet. Replayed on zeroed VRAM it gives what drawing the same frames
/// gives. `frame_done` is called after each. Error: a frame that does not fit into RAM.
scene::Result<gpu::Dump> record(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs,
                                scene::Annotate annotate, const std::function<void()>& frame_done = {});

}  // namespace app
