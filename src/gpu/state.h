#pragma once
// What the attribute commands E1h-E6h set and every drawing command reads: registers kept as they were
// written, with one function per meaning. A snapshot is a copy of 28 bytes.

#include <cstdint>

#include "ot/gp0.h"

namespace gpu {

namespace gp0 = ot::gp0;
using ot::Blend, ot::TexelFormat;

/// Low 11 bits, sign-extended: -1024..1023. Every coordinate on the bus has this form.
constexpr int sign_extend_11(std::uint32_t bits) { return ot::Field<0, 11>::get_signed(bits); }

/// While an interlaced 480-line picture is shown, the rows of the field on screen may be left alone.
enum class SkippedRows : std::uint8_t { none, even, odd };

struct DrawState {
  std::uint32_t draw_mode = 0;          ///< E1h; textured polygons replace draw_mode::page_bits
  std::uint32_t texture_window = 0;     ///< E2h
  std::uint32_t area_top_left = 0;      ///< E3h
  std::uint32_t area_bottom_right = 0;  ///< E4h
  std::uint32_t offset = 0;             ///< E5h
  std::uint32_t mask = 0;               ///< E6h
  SkippedRows skipped_rows = SkippedRows::none;

  [[nodiscard]] int page_x() const { return 64 * number<gp0::draw_mode::PageX64>(draw_mode); }
  [[nodiscard]] int page_y() const { return 256 * number<gp0::draw_mode::PageY256>(draw_mode); }
  [[nodiscard]] Blend blend() const { return gp0::draw_mode::blend_of(draw_mode); }  ///< never opaque
  [[nodiscard]] TexelFormat texel_format() const { return gp0::draw_mode::format_of(draw_mode); }
  [[nodiscard]] bool dithers() const { return gp0::draw_mode::Dither::get(draw_mode) != 0; }
  [[nodiscard]] bool draws_to_display() const { return gp0::draw_mode::DrawToDisplay::get(draw_mode) != 0; }
  [[nodiscard]] bool flips_x() const {
    return gp0::draw_mode::FlipX::get(draw_mode) != 0;
  }  ///< rectangles only
  [[nodiscard]] bool flips_y() const {
    return gp0::draw_mode::FlipY::get(draw_mode) != 0;
  }  ///< rectangles only

  // Texture window: u' = (u & keep) | set, both 8-bit. [docs/hardware.md#texture-window]
  [[nodiscard]] std::uint8_t window_keep_u() const { return static_cast<std::uint8_t>(~(mask_u() * 8)); }
  [[nodiscard]] std::uint8_t window_keep_v() const { return static_cast<std::uint8_t>(~(mask_v() * 8)); }
  [[nodiscard]] std::uint8_t window_set_u() const {
    return static_cast<std::uint8_t>((gp0::texture_window::OffsetX::get(texture_window) & mask_u()) * 8);
  }
  [[nodiscard]] std::uint8_t window_set_v() const {
    return static_cast<std::uint8_t>((gp0::texture_window::OffsetY::get(texture_window) & mask_v()) * 8);
  }

  // The drawing area, all four edges inside it.
  [[nodiscard]] int left() const { return number<gp0::draw_area::X>(area_top_left); }
  [[nodiscard]] int top() const { return number<gp0::draw_area::Y>(area_top_left); }
  [[nodiscard]] int right() const { return number<gp0::draw_area::X>(area_bottom_right); }
  [[nodiscard]] int bottom() const { return number<gp0::draw_area::Y>(area_bottom_right); }

  [[nodiscard]] int offset_x() const { return gp0::draw_offset::X::get_signed(offset); }
  [[nodiscard]] int offset_y() const { return gp0::draw_offset::Y::get_signed(offset); }

  /// Bit 15 where written pixels get it, and where pixels that have it are not written; else 0.
  [[nodiscard]] std::uint16_t mask_set() const { return bit_15(gp0::mask_bits::Set::get(mask)); }
  [[nodiscard]] std::uint16_t mask_test() const { return bit_15(gp0::mask_bits::Test::get(mask)); }

  [[nodiscard]] bool skips(int row) const {
    return skipped_rows != SkippedRows::none && ((row & 1) != 0) == (skipped_rows == SkippedRows::odd);
  }

 private:
  [[nodiscard]] std::uint32_t mask_u() const { return gp0::texture_window::MaskX::get(texture_window); }
  [[nodiscard]] std::uint32_t mask_v() const { return gp0::texture_window::MaskY::get(texture_window); }
  template <class Field>
  [[nodiscard]] static int number(std::uint32_t word) {
    return static_cast<int>(Field::get(word));
  }
  [[nodiscard]] static std::uint16_t bit_15(std::uint32_t flag) {
    return static_cast<std::uint16_t>(flag << 15);
  }
};

}  // namespace gpu
