#pragma once
// A whole input into memory, be it a file or a pipe (`otter replay <(fetch dump)`). What scene files may name
// is stricter: scene::read_file takes regular files alone.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/error.h"

namespace app {

/// At most `most` bytes: an endless input (a device, a pipe) ends there.
/// Error (exit 2): "PATH: cannot be read: REASON", "PATH: more than `most` bytes".
scene::Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t most);

}  // namespace app
