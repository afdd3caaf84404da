#pragma once
// Hardware vectors are other people's captures and are not part of this project.
// OTTER_VECTORS names their folder.

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace tests {

/// The path of a vector file or folder below OTTER_VECTORS; nothing, with a line that
/// says so, where it is not there.
inline std::optional<std::filesystem::path> vector_path(const char* below) {
  const char* root = std::getenv("OTTER_VECTORS");
  if (root != nullptr && *root != '\0') {
    auto path = std::filesystem::path(root) / below;
    if (std::filesystem::exists(path)) return path;
  }
  MESSAGE("skipped: ", below, " (OTTER_VECTORS does not hold it)");
  return std::nullopt;
}

}  // namespace tests
