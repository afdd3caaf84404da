#pragma once
// Which accurate target the knobs ask for.

#include <optional>

#include "gpu/canvas/options.h"
#include "scene/frame.h"

namespace scene {

/// The depth stage that the knobs ask for; nothing unless visibility is zbuffer.
[[nodiscard]] std::optional<gpu::DepthOptions> depth_options(const Knobs& knobs);

/// The canvas that the knobs ask for; nothing where the console's own frame buffer shows the same. FXAA alone
/// needs none: it filters the finished picture.
[[nodiscard]] std::optional<gpu::canvas::Options> canvas_options(const Knobs& knobs, const World& world,
                                                                 double units_per_world);

/// The most that the frame of one canvas may take.
inline constexpr std::uint64_t canvas_limit_bytes = std::uint64_t{2} << 30;

/// Sets depth stage and canvas of `gpu` as the knobs ask. Error: the canvas would be larger than the limit.
[[nodiscard]] base::Result<void> use_targets(const FrameBuilder& builder, const Knobs& knobs, gpu::Gpu& gpu);

}  // namespace scene
