#pragma once
// Every word of GPU port 1, which commands the display, and GPUSTAT, which answers: their fields, encode
// beside decode. Whoever sets, shows or executes a control word shares these names.
// [docs/hardware.md#gp1-commands]
//
// Not here: what a command does (src/gpu).

#include <array>
#include <cstdint>

#include "ot/field.h"

namespace ot::gp1 {

using Code = Field<24, 6>;  ///< which command; bits 30 and 31 do not count: 40h-FFh mirror 00h-3Fh

enum class Command : std::uint8_t {
  reset,                  ///< 00h: as after power on; aborts what is open on port 0
  clear_fifo,             ///< 01h: aborts what is open on port 0
  acknowledge_irq,        ///< 02h
  display_off,            ///< 03h
  dma_direction,          ///< 04h
  display_start,          ///< 05h
  horizontal_range,       ///< 06h
  vertical_range,         ///< 07h
  display_mode,           ///< 08h
  allow_texture_disable,  ///< 09h
  read_register,          ///< 10h-1Fh: a register, to be read through GPUREAD
  unknown,                ///< 0Ah-0Fh, 20h-3Fh: nothing
};

constexpr Command command_of(std::uint32_t word) {
  const std::uint32_t code = Code::get(word);
  if (code <= 0x09) return static_cast<Command>(code);
  return code >= 0x10 && code < 0x20 ? Command::read_register : Command::unknown;
}

/// A word of 00h-09h.
constexpr std::uint32_t make(Command command, std::uint32_t parameters = 0) {
  return Code::put(static_cast<std::uint32_t>(command)) | parameters;
}

/// Whether the open command of port 0 is dropped, an upload and a polyline included.
constexpr bool aborts_command(std::uint32_t word) {
  const Command command = command_of(word);
  return command == Command::reset || command == Command::clear_fifo;
}

namespace display_off {
using IsOff = Field<0, 1>;

constexpr std::uint32_t make(bool is_off) { return gp1::make(Command::display_off, IsOff::put(is_off)); }
}  // namespace display_off

/// 0 off, 1 FIFO, 2 CPU to GP0, 3 GPUREAD to CPU.
namespace dma_direction {
using Direction = Field<0, 2>;

constexpr std::uint32_t make(std::uint32_t direction) {
  return gp1::make(Command::dma_direction, Direction::put(direction));
}
}  // namespace dma_direction

/// Top left pixel of what is shown, in VRAM.
namespace display_start {
using X = Field<0, 10>;
using Y = Field<10, 9>;
using All = Field<0, 19>;  ///< what the register keeps

constexpr std::uint32_t make(int x, int y) {
  return gp1::make(Command::display_start, X::put_signed(x) | Y::put_signed(y));
}
}  // namespace display_start

/// Video clocks.
namespace horizontal_range {
using X1 = Field<0, 12>;
using X2 = Field<12, 12>;
using All = Field<0, 24>;

constexpr std::uint32_t put(std::uint32_t x1, std::uint32_t x2) { return X1::put(x1) | X2::put(x2); }
constexpr std::uint32_t make(std::uint32_t x1, std::uint32_t x2) {
  return gp1::make(Command::horizontal_range, put(x1, x2));
}
}  // namespace horizontal_range

/// Scan lines.
namespace vertical_range {
using Y1 = Field<0, 10>;
using Y2 = Field<10, 10>;
using All = Field<0, 20>;

constexpr std::uint32_t put(std::uint32_t y1, std::uint32_t y2) { return Y1::put(y1) | Y2::put(y2); }
constexpr std::uint32_t make(std::uint32_t y1, std::uint32_t y2) {
  return gp1::make(Command::vertical_range, put(y1, y2));
}
}  // namespace vertical_range

namespace display_mode {
using Width = Field<0, 2>;  ///< 256, 320, 512, 640, unless IsWidth368
using Is480Lines = Field<2, 1>;
using IsPal = Field<3, 1>;
using Is24Bit = Field<4, 1>;
using IsInterlaced = Field<5, 1>;
using IsWidth368 = Field<6, 1>;
using IsReversed = Field<7, 1>;
using All = Field<0, 8>;

inline constexpr std::array<int, 4> widths{256, 320, 512, 640};

/// Pixels a row.
constexpr int width(std::uint32_t word) {
  return IsWidth368::get(word) != 0 ? 368 : widths[Width::get(word)];
}

/// The bits of a width: one of the five that there are, any other gives 368.
constexpr std::uint32_t put_width(int width) {
  for (std::uint32_t n = 0; const int known : widths) {
    if (known == width) return Width::put(n);
    ++n;
  }
  return IsWidth368::put(1);
}

constexpr std::uint32_t make(std::uint32_t fields) { return gp1::make(Command::display_mode, fields); }
}  // namespace display_mode

namespace allow_texture_disable {
using IsAllowed = Field<0, 1>;
}

/// Which register: 2-5 as E2h-E5h set them, 7 the version of the GPU, 8 zero; others leave GPUREAD as it is.
namespace read_register {
using Number = Field<0, 4>;
}

}  // namespace ot::gp1

/// GPUSTAT.   [docs/hardware.md#gpustat]
namespace ot::gpu_status {
using DrawMode = Field<0, 11>;  ///< E1h bits 0-10
using Mask = Field<11, 2>;      ///< E6h bits 0-1
using OddField = Field<13, 1>;  ///< the field being output; 1 when not interlaced
using IsReversed = Field<14, 1>;
using TextureDisable = Field<15, 1>;
using IsWidth368 = Field<16, 1>;
using DisplayMode = Field<17, 6>;  ///< GP1(08h) bits 0-5
using IsDisplayOff = Field<23, 1>;
using Irq = Field<24, 1>;
using DmaRequest = Field<25, 1>;
using ReadyForCommand = Field<26, 1>;
using ReadyToSend = Field<27, 1>;  ///< pixels of a download are waiting
using ReadyForDma = Field<28, 1>;
using DmaDirection = Field<29, 2>;
using OddLine = Field<31, 1>;  ///< of the line being displayed
}  // namespace ot::gpu_status
