#pragma once
// What GP1 sets: which rectangle of VRAM the console shows, and how.

#include <cstdint>

namespace gpu {

struct Display {
  std::uint32_t mode = 0;                     ///< GP1(08h) bits 0-7
  std::uint32_t start = 0;                    ///< GP1(05h): bits 0-9 x, 10-18 y
  std::uint32_t horizontal_range = 0xc00200;  ///< GP1(06h): bits 0-11 X1, 12-23 X2, video clocks
  std::uint32_t vertical_range = 0x040010;    ///< GP1(07h): bits 0-9 Y1, 10-19 Y2, scan lines
  bool is_off = true;                         ///< GP1(03h)
  bool odd_field = false;                     ///< the field being output, while interlaced

  [[nodiscard]] int start_x() const { return static_cast<int>(start & 0x3ff); }
  [[nodiscard]] int start_y() const { return static_cast<int>(start >> 10 & 0x1ff); }
  [[nodiscard]] bool is_480_lines() const { return (mode >> 2 & 1) != 0; }
  [[nodiscard]] bool is_pal() const { return (mode >> 3 & 1) != 0; }
  [[nodiscard]] bool is_24_bit() const { return (mode >> 4 & 1) != 0; }
  [[nodiscard]] bool is_interlaced() const { return (mode >> 5 & 1) != 0; }

  /// Pixels a row: what the mode says. The horizontal range only crops on a screen and is not applied.
  [[nodiscard]] int width() const {
    constexpr int widths[] = {256, 320, 512, 640};
    return (mode >> 6 & 1) != 0 ? 368 : widths[mode & 3];
  }
  /// Rows: those of the vertical range, twice as many in a 480-line mode; 0 where the range is empty.
  [[nodiscard]] int height() const {
    const int lines =
        static_cast<int>(vertical_range >> 10 & 0x3ff) - static_cast<int>(vertical_range & 0x3ff);
    const int rows = is_480_lines() && is_interlaced() ? 2 * lines : lines;
    return rows < 0 ? 0 : rows > 512 ? 512 : rows;
  }
};

}  // namespace gpu
