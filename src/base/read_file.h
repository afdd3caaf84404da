#pragma once
// Whole files into memory, never more of them than the caller can use.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace base {

/// A file or a pipe (`otter replay <(fetch dump)`). At most `most` bytes: an endless input (a device, a pipe)
/// ends there. Error (exit 2): "PATH: cannot be read: REASON", "PATH: more than `most` bytes".
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t most);

/// What a scene file may name: a regular file alone. Error (bad_input): not a regular file, unreadable, more
/// than `most` bytes.
Result<std::string> read_regular_file(const std::filesystem::path& path, std::size_t most);

}  // namespace base
