#pragma once
// The straight line a triangle takes, in one function: scene -> GTE -> ordering table -> walker -> GPU.

#include <cstdint>

#include "scene/frame.h"

namespace scene {

/// Draws the scene at `seconds` into the GPU's VRAM, or into its canvas, and shows it: build, begin_frame,
/// walk the list(s), end_frame, display start. Sets depth stage and canvas as planned (scene/accurate.h).
/// Needs FrameBuilder::upload done on this GPU. Error: the frame does not fit, a list is broken, or a polygon
/// without depth in z-buffer mode.
[[nodiscard]] base::Result<FrameStats> render_frame(FrameBuilder& builder, double seconds, const Knobs& knobs,
                                                    ot::MainRam& ram, gpu::Gpu& gpu);

/// The second half: draws the list of `frame`, and the nearer ones if there are any, and shows the picture.
[[nodiscard]] base::Result<void> draw_frame(FrameBuilder& builder, Frame& frame, ot::MainRam& ram,
                                            gpu::Gpu& gpu);

/// Time of frame N.
[[nodiscard]] constexpr double frame_time(std::uint32_t number) { return number / 60.0; }

}  // namespace scene
