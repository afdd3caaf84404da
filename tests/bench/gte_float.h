#pragma once
// What a coprocessor without registers to imitate would do: the yardstick of the batch door.

#include <cstdint>
#include <span>
#include <string_view>

#include "gte/registers.h"

namespace bench {

/// Rotation, translation, one division and the projection of each vertex in float32 SIMD, from the same
/// 16-bit input to the same 16-bit output as gte::project without FLAG; no rounding rule, no flags, no table.
using FloatProject = void (*)(const gte::Registers&, std::span<const gte::Vertex>, gte::ScreenXy* sxy,
                              std::uint16_t* sz);

/// That of the instruction set gte::batch_targets names; null if it has none.
FloatProject float_project(std::string_view target);

}  // namespace bench
