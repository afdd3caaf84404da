#pragma once
// Pictures as PNG files.

#include <filesystem>

#include "display/picture.h"
#include "scene/error.h"

namespace display {

/// Writes `picture` as an 8-bit RGB PNG (alpha is not kept), whole or not at all.
/// Error (exit 1): names the path and the reason.
scene::Result<void> write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace display
