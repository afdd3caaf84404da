#pragma once
// A whole file into memory.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/error.h"

namespace app {

/// Error (exit 2): "PATH: cannot be read: REASON".
scene::Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

}  // namespace app
