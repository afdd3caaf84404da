#pragma once
// What GP1 sets: which rectangle of VRAM the console shows, and how.

#include <algorithm>
#include <cstdint>

#include "ot/gp1.h"

namespace gpu {

namespace gp1 = ot::gp1;

struct Display {
  std::uint32_t mode = 0;                                                     ///< GP1(08h)
  std::uint32_t start = 0;                                                    ///< GP1(05h)
  std::uint32_t horizontal_range = gp1::horizontal_range::put(0x200, 0xc00);  ///< GP1(06h)
  std::uint32_t vertical_range = gp1::vertical_range::put(0x10, 0x100);       ///< GP1(07h)
  bool is_off = true;                                                         ///< GP1(03h)
  bool odd_field = false;  ///< the field being output, while interlaced
  bool odd_frame = false;  ///< changes at every vertical blank

  [[nodiscard]] int start_x() const { return static_cast<int>(gp1::display_start::X::get(start)); }
  [[nodiscard]] int start_y() const { return static_cast<int>(gp1::display_start::Y::get(start)); }
  [[nodiscard]] bool is_480_lines() const { return gp1::display_mode::Is480Lines::get(mode) != 0; }
  [[nodiscard]] bool is_pal() const { return gp1::display_mode::IsPal::get(mode) != 0; }
  [[nodiscard]] bool is_24_bit() const { return gp1::display_mode::Is24Bit::get(mode) != 0; }
  [[nodiscard]] bool is_interlaced() const { return gp1::display_mode::IsInterlaced::get(mode) != 0; }

  /// Pixels a row: what the mode says. The horizontal range only crops on a screen and is not applied.
  [[nodiscard]] int width() const { return gp1::display_mode::width(mode); }
  /// Rows: those of the vertical range, twice as many in a 480-line mode; 0 where the range is empty.
  [[nodiscard]] int height() const {
    const int lines = static_cast<int>(gp1::vertical_range::Y2::get(vertical_range)) -
                      static_cast<int>(gp1::vertical_range::Y1::get(vertical_range));
    return std::clamp(is_480_lines() && is_interlaced() ? 2 * lines : lines, 0, 512);
  }
};

}  // namespace gpu
