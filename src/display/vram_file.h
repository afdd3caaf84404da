#pragma once
// All of VRAM as a file.

#include <filesystem>

#include "base/result.h"
#include "gpu/vram.h"

namespace display {

/// VRAM as the name says: .png, all of it as 1024 x 512 RGB8 (bit 15 is not in it); any other, 1 MiB of
/// little-endian halfwords. Whole or not at all. Error (exit 1): names the path and the reason.
base::Result<void> save_vram(const std::filesystem::path& path, const gpu::Vram& vram);

/// 1 MiB as save_vram writes it. Error (exit 2): unreadable, or another size.
base::Result<void> load_vram(const std::filesystem::path& path, gpu::Vram& vram);

}  // namespace display
