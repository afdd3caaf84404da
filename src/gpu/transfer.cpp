#include "gpu/transfer.h"

namespace gpu {

void ClutCache::use(const Vram& vram, std::uint16_t clut, TexelFormat format) {
  if (format == TexelFormat::direct15) return;
  const std::uint32_t tag = clut & 0x7fffU;
  if (tag == tag_ && loaded_ >= format) return;
  tag_ = tag;
  loaded_ = format;
  const int x = static_cast<int>(clut & 63) * 16, y = clut >> 6 & 0x1ff;
  const int count = format == TexelFormat::clut4 ? 16 : 256;
  for (int i = 0; i < count; ++i) entries_[static_cast<std::size_t>(i)] = vram.at(x + i, y);
}

}  // namespace gpu
