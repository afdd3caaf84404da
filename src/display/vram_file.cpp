#include "display/vram_file.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/file_kind.h"
#include "base/read_file.h"
#include "base/write_file.h"
#include "display/png.h"
#include "display/scanout.h"

namespace display {

base::Result<void> save_vram(const std::filesystem::path& path, const gpu::Vram& vram) {
  if (base::lower_extension(path) == ".png") return write_png(path, scan_out_all(vram.pixels()));
  std::vector<std::byte> bytes;
  bytes.reserve(2 * gpu::Vram::size);
  for (const std::uint16_t pixel : vram.pixels()) {
    bytes.push_back(static_cast<std::byte>(pixel & 0xff));
    bytes.push_back(static_cast<std::byte>(pixel >> 8));
  }
  return base::write_file(path, bytes);
}

base::Result<void> load_vram(const std::filesystem::path& path, gpu::Vram& vram) {
  const auto pixels = vram.pixels();
  const auto file = base::read_file(path, 2 * pixels.size());
  if (!file) return tl::make_unexpected(file.error());
  if (file->size() != 2 * pixels.size()) {
    return base::fail(path.string() + ": expected " + std::to_string(2 * pixels.size()) +
                      " bytes of VRAM, got " + std::to_string(file->size()));
  }
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    pixels[n] = static_cast<std::uint16_t>(std::to_integer<unsigned>((*file)[2 * n]) |
                                           std::to_integer<unsigned>((*file)[2 * n + 1]) << 8);
  }
  return {};
}

}  // namespace display
