#pragma once
// The picture that a recording shows.

#include <string>

#include "base/picture.h"
#include "base/result.h"
#include "gpu/gpu.h"

namespace app {

/// The display area of VRAM, for the file `output`. Error (exit 1): it is empty.
base::Result<base::Picture> shown_picture(const gpu::Gpu& gpu, const std::string& output);

}  // namespace app
