#pragma once
// The instruction set that the whole program computes with.

#include <string_view>

#include "base/result.h"

namespace app {

/// As the environment variable OTTER_TARGET says: scalar, sse4, avx2 or avx512, for the batch door of the GTE
/// and the kernels of the GPU alike; without it the best that this processor has. Error: another word, or one
/// that this processor or build has not got. Before any thread that computes.
base::Result<void> choose_target();

/// The word for what is chosen.
std::string_view target();

}  // namespace app
