#pragma once
// What the attribute commands E1h-E6h set and every drawing command reads: registers kept as they were
// written, with one function per meaning. A snapshot is a copy of 28 bytes.

#include <algorithm>
#include <cstdint>

namespace gpu {

/// Low 11 bits, sign-extended: -1024..1023. Every coordinate on the bus has this form.
constexpr int sign_extend_11(std::uint32_t bits) { return static_cast<int>((bits & 0x7ff) ^ 0x400) - 0x400; }

enum class TexelFormat : std::uint8_t { clut4, clut8, direct15 };

/// Per 5-bit channel, B = VRAM, F = new.
enum class Blend : std::uint8_t {
  average,      ///< (B + F) >> 1
  add,          ///< min(31, B + F)
  subtract,     ///< max(0, B - F)
  add_quarter,  ///< min(31, B + (F >> 2))
};

/// While an interlaced 480-line picture is shown, the rows of the field on screen may be left alone.
enum class SkippedRows : std::uint8_t { none, even, odd };

struct DrawState {
  std::uint32_t draw_mode = 0;          ///< E1h bits 0-13; textured polygons replace 0-8 and 11
  std::uint32_t texture_window = 0;     ///< E2h bits 0-19
  std::uint32_t area_top_left = 0;      ///< E3h bits 0-19
  std::uint32_t area_bottom_right = 0;  ///< E4h bits 0-19
  std::uint32_t offset = 0;             ///< E5h bits 0-21
  std::uint32_t mask = 0;               ///< E6h bits 0-1
  SkippedRows skipped_rows = SkippedRows::none;

  [[nodiscard]] int page_x() const { return static_cast<int>(draw_mode & 15) * 64; }
  [[nodiscard]] int page_y() const { return static_cast<int>(draw_mode >> 4 & 1) * 256; }
  [[nodiscard]] Blend blend() const { return static_cast<Blend>(draw_mode >> 5 & 3); }
  [[nodiscard]] TexelFormat texel_format() const {
    return static_cast<TexelFormat>(std::min(draw_mode >> 7 & 3, 2U));
  }
  [[nodiscard]] bool dithers() const { return (draw_mode >> 9 & 1) != 0; }
  [[nodiscard]] bool flips_x() const { return (draw_mode >> 12 & 1) != 0; }  ///< rectangles only
  [[nodiscard]] bool flips_y() const { return (draw_mode >> 13 & 1) != 0; }  ///< rectangles only

  // Texture window: u' = (u & keep) | set, both 8-bit. [psx-spx, Texture Window]
  [[nodiscard]] std::uint8_t window_keep_u() const { return static_cast<std::uint8_t>(~(mask_u() * 8)); }
  [[nodiscard]] std::uint8_t window_keep_v() const { return static_cast<std::uint8_t>(~(mask_v() * 8)); }
  [[nodiscard]] std::uint8_t window_set_u() const {
    return static_cast<std::uint8_t>((texture_window >> 10 & mask_u()) * 8);
  }
  [[nodiscard]] std::uint8_t window_set_v() const {
    return static_cast<std::uint8_t>((texture_window >> 15 & mask_v()) * 8);
  }

  // The drawing area, all four edges inside it.
  [[nodiscard]] int left() const { return static_cast<int>(area_top_left & 0x3ff); }
  [[nodiscard]] int top() const { return static_cast<int>(area_top_left >> 10 & 0x3ff); }
  [[nodiscard]] int right() const { return static_cast<int>(area_bottom_right & 0x3ff); }
  [[nodiscard]] int bottom() const { return static_cast<int>(area_bottom_right >> 10 & 0x3ff); }

  [[nodiscard]] int offset_x() const { return sign_extend_11(offset); }
  [[nodiscard]] int offset_y() const { return sign_extend_11(offset >> 11); }

  [[nodiscard]] std::uint16_t mask_set() const { return static_cast<std::uint16_t>((mask & 1) << 15); }
  [[nodiscard]] std::uint16_t mask_test() const { return static_cast<std::uint16_t>((mask >> 1 & 1) << 15); }

  [[nodiscard]] bool skips(int row) const {
    return skipped_rows != SkippedRows::none && ((row & 1) != 0) == (skipped_rows == SkippedRows::odd);
  }

 private:
  [[nodiscard]] std::uint32_t mask_u() const { return texture_window & 31; }
  [[nodiscard]] std::uint32_t mask_v() const { return texture_window >> 5 & 31; }
};

}  // namespace gpu
