#pragma once
// What a frame reads and writes of VRAM, command by command, as rectangles.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "debug/frame_view.h"
#include "inspect/report.h"

namespace debug {

enum class AccessKind : std::uint8_t {
  write,
  texels,   ///< read through the texture page
  palette,  ///< read as a CLUT
  source,   ///< of a copy
};
inline constexpr std::array<std::string_view, 4> access_names{"writes", "texels", "palette", "copied"};

/// The smallest rectangle that holds the pixels; those that wrap at VRAM's edge stretch it.
struct Access {
  AccessKind kind = AccessKind::write;
  std::size_t row = 0;       ///< the first command that does it, index into FrameView::rows()
  std::size_t commands = 1;  ///< how many do
  inspect::Rectangle place;
  [[nodiscard]] bool has(int x, int y) const {
    return x >= place.x && y >= place.y && x < place.x + place.width && y < place.y + place.height;
  }
};

/// In the order of their first commands; commands that do the same with the same rectangle count as one.
std::vector<Access> accesses_of(const FrameView& view);

}  // namespace debug
