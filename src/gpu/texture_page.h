#pragma once
// What the format of its texels says of a texture page and its palette.

#include "gpu/state.h"

namespace gpu {

/// Halfwords of VRAM that hold 256 texels side by side, and how far the column wraps: 64, 128 or 256.
constexpr int page_width(TexelFormat format) {
  return format == TexelFormat::clut4 ? 64 : format == TexelFormat::clut8 ? 128 : 256;
}

/// Entries of the palette; 0 where texels are colours.
constexpr int palette_size(TexelFormat format) {
  return format == TexelFormat::clut4 ? 16 : format == TexelFormat::clut8 ? 256 : 0;
}

}  // namespace gpu
