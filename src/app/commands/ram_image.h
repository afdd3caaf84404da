#pragma once
// A saved RAM image and what the command line says of it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "debug/recording.h"

namespace app {

/// Reads 2 or 8 MiB of main RAM. `head` is an address, `table` ADDR,N or empty. Error (exit 2): another size,
/// an option that is no address, a table outside RAM.
base::Result<debug::RamImage> read_ram_image(const std::string& path, const std::string& head,
                                             const std::string& table);

/// 1 MiB of VRAM for the list to draw into; empty without a path. Error (exit 2): another size.
base::Result<std::vector<std::uint16_t>> read_vram(const std::string& path);

}  // namespace app
