#pragma once
// Pictures as PNG files.

#include <filesystem>

#include "base/picture.h"
#include "base/result.h"

namespace display {

/// Writes `picture` as an 8-bit RGB PNG (alpha is not kept), whole or not at all.
/// Error (exit 1): names the path and the reason.
base::Result<void> write_png(const std::filesystem::path& path, const base::Picture& picture);

inline constexpr int most_png_side = 4096;

/// Reads a PNG of any kind as 8-bit RGB. Error (exit 2): unreadable, no PNG, a side over most_png_side.
base::Result<base::Picture> read_png(const std::filesystem::path& path);

}  // namespace display
