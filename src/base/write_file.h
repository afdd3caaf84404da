#pragma once
// The one way in which this program makes a file: whole, or not at all.

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "base/result.h"

namespace base {

/// Writes `bytes` under a temporary name beside `path` and renames it, so that nobody ever reads half a file
/// and an old one survives a failure. A file that was there keeps its mode; one that is read-only, or has a
/// second name (a hard link), is not replaced. A device or pipe (/dev/stdout) is written directly. Error
/// (exit 1): "PATH: cannot be written: REASON"; the temporary file is gone.
Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> write_file(const std::filesystem::path& path, std::string_view text);
/// The same for what is too large to be held: `write` puts it into the open file, and may give up with an
/// error of its own: then there is no file.
Result<void> write_file(const std::filesystem::path& path,
                        const std::function<Result<void>(std::FILE*)>& write);

}  // namespace base
