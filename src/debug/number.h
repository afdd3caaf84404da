#pragma once
// The number of a command (gpu/number.h) by the names of this room.

#include "gpu/number.h"

namespace debug {

using gpu::going_on, gpu::Number, gpu::number_of, gpu::parse_number, gpu::to_text;

}  // namespace debug
