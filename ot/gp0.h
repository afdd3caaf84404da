#pragma once
// Every word of GPU port 0: which command it opens, how long the command is, and its fields. The packet
// builders and the decoder of the GPU share these names.   [docs/hardware.md#gp0-commands]
//
// Not here: GP1 (gp1.h), and what a command does (src/gpu).

#include <cstddef>
#include <cstdint>

#include "ot/field.h"

namespace ot {

/// How a pixel is mixed with what is there. Per 5-bit channel, B = what is there, F = new.
enum class Blend : std::uint8_t {
  opaque,       ///< F
  average,      ///< (B + F) >> 1
  add,          ///< min(31, B + F)
  subtract,     ///< max(0, B - F)
  add_quarter,  ///< min(31, B + (F >> 2))
};

/// How texels lie in VRAM: 4 or 8 bits that choose a colour of a palette (CLUT), or 15-bit colours.
enum class TexelFormat : std::uint8_t { none, clut4, clut8, direct15 };

}  // namespace ot

namespace ot::gp0 {

using Opcode = Field<24, 8>;  ///< of the first word of a command

enum class Command : std::uint8_t {
  nop,                ///< 00h, 03h, 04h-1Eh, E0h, F0h-FFh
  clear_cache,        ///< 01h
  fill,               ///< 02h
  irq,                ///< 1Fh
  polygon,            ///< 20h-3Fh
  line,               ///< 40h-47h, 50h-57h: two vertices
  polyline,           ///< 48h-4Fh, 58h-5Fh: vertices up to a terminator
  rectangle,          ///< 60h-7Fh
  copy,               ///< 80h-9Fh, VRAM to VRAM
  upload,             ///< A0h-BFh, CPU to VRAM: 3 words, then the pixels
  download,           ///< C0h-DFh, VRAM to CPU: 3 words, then GPUREAD
  draw_mode,          ///< E1h
  texture_window,     ///< E2h
  area_top_left,      ///< E3h
  area_bottom_right,  ///< E4h
  draw_offset,        ///< E5h
  mask_bits,          ///< E6h
  annotation,         ///< E7h-EFh: nothing on the console; depth of the next polygon to us (annotation::)
};

constexpr Command command_of(std::uint32_t first_word) {
  const auto opcode = Opcode::get(first_word);
  switch (opcode >> 5) {
    case 0:
      if (opcode == 0x01) return Command::clear_cache;
      if (opcode == 0x02) return Command::fill;
      return opcode == 0x1f ? Command::irq : Command::nop;
    case 1:
      return Command::polygon;
    case 2:
      return (opcode & 0x08) != 0 ? Command::polyline : Command::line;
    case 3:
      return Command::rectangle;
    case 4:
      return Command::copy;
    case 5:
      return Command::upload;
    case 6:
      return Command::download;
    default:
      break;
  }
  if (opcode >= 0xe1 && opcode <= 0xe6) {
    return static_cast<Command>(static_cast<unsigned>(Command::draw_mode) + (opcode - 0xe1));
  }
  return opcode >= 0xe7 && opcode <= 0xef ? Command::annotation : Command::nop;
}

/// A drawing command changes VRAM: what `--until K` counts.
constexpr bool is_drawing(Command c) {
  return c == Command::fill || c == Command::polygon || c == Command::line || c == Command::polyline ||
         c == Command::rectangle || c == Command::copy || c == Command::upload;
}

inline constexpr std::uint32_t clear_cache = Opcode::put(0x01);  ///< the whole command

/// Colour words, and the low 24 bits of the words that open a primitive or a fill.
namespace colour {
using R = Field<0, 8>;
using G = Field<8, 8>;
using B = Field<16, 8>;
}  // namespace colour

/// A vertex. 11-bit two's complement, the other bits are ignored.
namespace vertex {
using X = Field<0, 11>;
using Y = Field<16, 11>;
}  // namespace vertex

/// A texture coordinate. The high half is the CLUT (vertex 0, rectangles), the texture page (vertex 1 of a
/// polygon) or ignored.
namespace texcoord {
using U = Field<0, 8>;
using V = Field<8, 8>;
using Clut = Field<16, 16>;
using Texpage = Field<16, 16>;
}  // namespace texcoord

/// CLUT halfword; bit 15 is ignored.
namespace clut {
using X16 = Field<0, 6>;  ///< VRAM x / 16
using Y = Field<6, 9>;
using All = Field<0, 15>;
}  // namespace clut

/// The flags of lines and rectangles lie where those of polygons do, as far as they have them.
///
/// First word of 20h-3Fh.
namespace polygon {
using IsGouraud = Field<28, 1>;
using IsQuad = Field<27, 1>;
using IsTextured = Field<26, 1>;
using IsSemiTransparent = Field<25, 1>;
using IsRaw = Field<24, 1>;  ///< the texel is used unchanged; means nothing when untextured

constexpr std::size_t vertices(std::uint32_t first_word) { return IsQuad::get(first_word) != 0 ? 4 : 3; }

/// F3 4, FT3 7, G3 6, GT3 9, F4 5, FT4 9, G4 8, GT4 12.
constexpr std::size_t words(std::uint32_t first_word) {
  const std::size_t n = vertices(first_word);
  return n * (1 + IsTextured::get(first_word)) + (IsGouraud::get(first_word) != 0 ? n : 1);
}
}  // namespace polygon

/// First word of 40h-5Fh.
namespace line {
using IsGouraud = Field<28, 1>;
using IsPolyline = Field<27, 1>;
using IsSemiTransparent = Field<25, 1>;

/// Words of the first segment: what a line is long, and what a polyline always takes.
constexpr std::size_t words(std::uint32_t first_word) { return IsGouraud::get(first_word) != 0 ? 4 : 3; }

/// Tested on the first word of each vertex from the third vertex on; nothing else ends a polyline.
constexpr bool is_terminator(std::uint32_t word) { return (word & 0xf000f000) == 0x50005000; }
inline constexpr std::uint32_t terminator = 0x55555555;
}  // namespace line

/// First word of 60h-7Fh, and the size word.
namespace rectangle {
using Size = Field<27, 2>;  ///< RectangleSize
using IsTextured = Field<26, 1>;
using IsSemiTransparent = Field<25, 1>;
using IsRaw = Field<24, 1>;
using Width = Field<0, 10>;
using Height = Field<16, 9>;

constexpr std::size_t words(std::uint32_t first_word) {
  return 2 + IsTextured::get(first_word) + (Size::get(first_word) == 0 ? 1 : 0);
}
}  // namespace rectangle

/// Position and size words of fill, copy, upload and download as they are sent.
namespace area {
using X = Field<0, 16>;
using Y = Field<16, 16>;
using Width = Field<0, 16>;
using Height = Field<16, 16>;
}  // namespace area

/// What counts of them. A fill is cut to blocks of 16 pixels: x down, the width up; a size that is a multiple
/// of 1024 or 512 is empty.
namespace fill {
using X16 = Field<4, 6>;  ///< VRAM x / 16
using Width = Field<0, 10>;
using Height = Field<16, 9>;
constexpr std::uint32_t x(std::uint32_t corner_word) { return X16::get(corner_word) * 16; }
constexpr std::uint32_t width(std::uint32_t size_word) { return (Width::get(size_word) + 15) / 16 * 16; }
}  // namespace fill

/// Copies, uploads and downloads: w = ((W-1) & 3FFh) + 1, h = ((H-1) & 1FFh) + 1, so 0 is 1024 or 512.
namespace transfer {
using X = Field<0, 10>;
using Y = Field<16, 9>;
using Width = Field<0, 10>;
using Height = Field<16, 9>;
constexpr std::uint32_t width(std::uint32_t size_word) {
  return ((Width::get(size_word) - 1) & Width::max) + 1;
}
constexpr std::uint32_t height(std::uint32_t size_word) {
  return ((Height::get(size_word) - 1) & Height::max) + 1;
}
/// Two pixels a word; an odd total leaves the last high half unused.
constexpr std::uint32_t data_words(std::uint32_t size_word) {
  return (width(size_word) * height(size_word) + 1) / 2;
}
}  // namespace transfer

/// E1h, and (bits 0-8 and 11) the texture page halfword of polygons.
namespace draw_mode {
using PageX64 = Field<0, 4>;  ///< VRAM x / 64
using PageY256 = Field<4, 1>;
using Blend = Field<5, 2>;   ///< of what is semi-transparent: blend_of
using Format = Field<7, 2>;  ///< of texels: format_of
using Dither = Field<9, 1>;
using DrawToDisplay = Field<10, 1>;
using TextureDisable = Field<11, 1>;
using FlipX = Field<12, 1>;  ///< rectangles only
using FlipY = Field<13, 1>;
using All = Field<0, 14>;  ///< what the register keeps

/// What a page halfword replaces; TextureDisable only while GP1(09h) allows it.
inline constexpr std::uint32_t page_bits =
    PageX64::mask | PageY256::mask | Blend::mask | Format::mask | TextureDisable::mask;

/// 0..3 are the four ways to mix.
constexpr ot::Blend blend_of(std::uint32_t word) { return static_cast<ot::Blend>(1 + Blend::get(word)); }
/// Of opaque, which no bits say: 0.
constexpr std::uint32_t put(ot::Blend blend) {
  return blend == ot::Blend::opaque ? 0 : Blend::put(static_cast<std::uint32_t>(blend) - 1);
}

/// 3 is 2.
constexpr TexelFormat format_of(std::uint32_t word) {
  const std::uint32_t format = Format::get(word);
  return static_cast<TexelFormat>(format == 3 ? 3 : 1 + format);
}
/// Of none, which no bits say: 0.
constexpr std::uint32_t put(TexelFormat format) {
  return format == TexelFormat::none ? 0 : Format::put(static_cast<std::uint32_t>(format) - 1);
}

constexpr std::uint32_t make(std::uint32_t fields) { return Opcode::put(0xe1) | All::put(fields); }
}  // namespace draw_mode

/// E2h, in units of 8 texels.
namespace texture_window {
using MaskX = Field<0, 5>;
using MaskY = Field<5, 5>;
using OffsetX = Field<10, 5>;
using OffsetY = Field<15, 5>;
using All = Field<0, 20>;
inline constexpr std::uint32_t masks = MaskX::mask | MaskY::mask;  ///< none set: there is no window

constexpr std::uint32_t make(std::uint32_t fields) { return Opcode::put(0xe2) | All::put(fields); }
}  // namespace texture_window

/// E3h and E4h, both corners inclusive.
namespace draw_area {
using X = Field<0, 10>;
using Y = Field<10, 10>;
using All = Field<0, 20>;
}  // namespace draw_area

/// E5h, two's complement.
namespace draw_offset {
using X = Field<0, 11>;
using Y = Field<11, 11>;
using All = Field<0, 22>;
}  // namespace draw_offset

/// E6h.
namespace mask_bits {
using Set = Field<0, 1>;   ///< written pixels get bit 15
using Test = Field<1, 1>;  ///< pixels with bit 15 are not written
using All = Field<0, 2>;
}  // namespace mask_bits

/// E7h-EFh: the view-space depth (unsigned 20.12) and the fractions of the screen coordinates of the vertices
/// of the next polygon. The console ignores these codes.   [docs/hardware.md#depth-annotation]
namespace annotation {
inline constexpr std::uint32_t depth_high = 0xe7;  ///< first: high bytes of v0, v1, v2; a second one: of v3
inline constexpr std::uint32_t depth_low = 0xe8;   ///< + v: the low 24 bits of v's depth
/// + v: the 8 bits below the integer x and y, and what the whole u and v of v leave over, eighths of a texel
inline constexpr std::uint32_t fraction = 0xec;
using DepthLow = Field<0, 24>;
using High0 = Field<0, 8>;
using High1 = Field<8, 8>;
using High2 = Field<16, 8>;
using FractionX = Field<0, 8>;
using FractionY = Field<8, 8>;
using TexelRestU = Field<16, 4>;              ///< signed
using TexelRestV = Field<20, 4>;              ///< signed
inline constexpr std::size_t max_words = 16;  ///< of one annotation node
}  // namespace annotation

/// Words of the command that `first_word` opens, itself included: for an upload without its pixels, for a
/// polyline its first segment. Never 0.
constexpr std::size_t command_words(std::uint32_t first_word) {
  switch (command_of(first_word)) {
    case Command::fill:
    case Command::upload:
    case Command::download:
      return 3;
    case Command::copy:
      return 4;
    case Command::polygon:
      return polygon::words(first_word);
    case Command::line:
    case Command::polyline:
      return line::words(first_word);
    case Command::rectangle:
      return rectangle::words(first_word);
    default:
      return 1;
  }
}

}  // namespace ot::gp0
