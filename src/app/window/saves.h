#pragma once
// What the window writes into the current folder.

#include <SDL.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"
#include "debug/frame_view.h"

namespace app {

/// "otter-crates-12.png" in the current folder, or the first such name that is not taken.
std::filesystem::path free_name(const std::string& scene, std::int64_t frame, const std::string& what,
                                const std::string& extension = ".png");

/// Everything that is drawn in the window, as a PNG. Error (exit 1): it cannot be read back or written.
base::Result<void> save_window(SDL_Renderer* renderer, const std::filesystem::path& path);

/// The frame with its edits as a dump. Error (exit 1): it cannot be written.
base::Result<void> save_changes(debug::FrameView& view, const std::filesystem::path& path);

}  // namespace app
