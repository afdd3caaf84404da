#pragma once
// The accurate targets that a plan asks for.

#include "base/result.h"
#include "scene/plan.h"

namespace gpu {
class Gpu;
}

namespace scene {

/// The most that the frame of one canvas may take.
inline constexpr std::uint64_t canvas_limit_bytes = std::uint64_t{2} << 30;

/// Error (exit 2): a canvas of that size and those samples takes more.
[[nodiscard]] base::Result<void> check_size(const gpu::canvas::Options& options);

/// Sets depth stage and canvas of `gpu` as planned. Error: the canvas would be larger than the limit, or has
/// samples that an order by splitting is not made for.
[[nodiscard]] base::Result<void> use_targets(const Plan& plan, gpu::Gpu& gpu);

}  // namespace scene
