#pragma once
// The whole state of the coprocessor: 32 data and 32 control registers, as plain fields of true width.
//
// Not modelled: the pipeline. A command happens at once; the one-instruction load delay of MFC2,
// the stall of a read while a command runs and the few cycles LZCR and ORGB need after a write
// belong to the CPU that uses this.

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "gte/fixed.h"

namespace gte {

/// A model-space vertex or a normal, as VXYn and VZn hold it. `pad` is ignored: it makes an array of vertices
/// 8 bytes a step, so that SIMD loads need no gather.
struct Vertex {
  std::int16_t x = 0, y = 0, z = 0, pad = 0;
  friend constexpr bool operator==(const Vertex&, const Vertex&) = default;
};
static_assert(sizeof(Vertex) == 8);

/// A screen position: whole pixels, Y down, -400h..3FFh when the coprocessor made it.
struct ScreenXy {
  std::int16_t x = 0, y = 0;
  friend constexpr bool operator==(const ScreenXy&, const ScreenXy&) = default;
};
static_assert(sizeof(ScreenXy) == 4);

/// A colour and the GP0 command byte that travels with it.
struct Colour {
  std::uint8_t r = 0, g = 0, b = 0, code = 0;
  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};
static_assert(sizeof(Colour) == 4);

using Matrix = std::array<std::array<S3_12, 3>, 3>;  ///< [row][column]; row r makes component r

/// FLAG, cop2r63: one bit for each thing that went wrong in the last command. [docs/hardware.md#flag]
namespace flag {
inline constexpr std::uint32_t mac1_positive = 1u << 30;  ///< MAC2, MAC3: the next two lower bits
inline constexpr std::uint32_t mac1_negative = 1u << 27;  ///< MAC2, MAC3: the next two lower bits
inline constexpr std::uint32_t ir1_saturated = 1u << 24;  ///< IR2, IR3: the next two lower bits
inline constexpr std::uint32_t red_saturated = 1u << 21;  ///< green, blue: the next two lower bits
inline constexpr std::uint32_t sz3_or_otz_saturated = 1u << 18;
inline constexpr std::uint32_t divide_overflow = 1u << 17;
inline constexpr std::uint32_t mac0_positive = 1u << 16;
inline constexpr std::uint32_t mac0_negative = 1u << 15;
inline constexpr std::uint32_t sx2_saturated = 1u << 14;
inline constexpr std::uint32_t sy2_saturated = 1u << 13;
inline constexpr std::uint32_t ir0_saturated = 1u << 12;
inline constexpr std::uint32_t error = 1u << 31;            ///< the OR of the bits below
inline constexpr std::uint32_t error_causes = 0x7f87e000u;  ///< IR3, colours and IR0 are no error
inline constexpr std::uint32_t writable = 0x7ffff000u;

/// FLAG with bit 31 made from the others.
constexpr std::uint32_t with_error(std::uint32_t bits) {
  return bits | ((bits & error_causes) != 0 ? error : 0);
}
}  // namespace flag

/// Every register. Copy it, compare it, keep as many as you like; all zero to begin with [ours:
/// power-up contents are not known]. SXYP, IRGB, ORGB and LZCR are not stored: read() and
/// write() make them from the others.
struct Registers {
  // Data registers, cop2r0-31.
  std::array<Vertex, 3> v{};          ///< 0-5    VXY0 VZ0 VXY1 VZ1 VXY2 VZ2  model space; pad unused
  Colour rgbc{};                      ///< 6      RGBC         colour and GP0 code of the primitive
  std::array<ScreenXy, 3> sxy{};      ///< 12-14  SXY0..2      screen FIFO, newest last; 15 SXYP pushes
  std::array<std::uint16_t, 4> sz{};  ///< 16-19  SZ0..3       depth FIFO, eye units, newest last
  std::array<Colour, 3> rgb{};        ///< 20-22  RGB0..2      colour FIFO, newest last
  std::array<std::int16_t, 4> ir{};   ///< 8-11   IR0..3       IR0 1.3.12; IR1..3 the saturated MAC1..3
  std::array<std::int32_t, 4> mac{};  ///< 24-27  MAC0..3      sums, low 32 bits
  std::uint16_t otz = 0;              ///< 7      OTZ          average depth, an ordering table index
  std::uint32_t res1 = 0;             ///< 23     RES1         stored, without function
  std::uint32_t lzcs = 0;             ///< 30     LZCS         31 LZCR counts its leading equal bits
  // Control registers, cop2r32-63.
  Matrix rt{};                       ///< 32-36  RT           rotation, 1.3.12
  std::array<std::int32_t, 3> tr{};  ///< 37-39  TRX TRY TRZ  translation, model units
  Matrix llm{};                      ///< 40-44  LLM          light directions, 1.3.12
  std::array<S19_12, 3> bk{};        ///< 45-47  RBK GBK BBK  background (ambient) colour
  Matrix lcm{};                      ///< 48-52  LCM          light colours, rows R G B
  std::array<S27_4, 3> fc{};         ///< 53-55  RFC GFC BFC  far (fog) colour
  S15_16 ofx{}, ofy{};               ///< 56-57  OFX OFY      screen offset, pixels
  std::uint16_t h = 0;               ///< 58     H            projection plane distance; *reads* sign-extended
  S7_8 dqa{};                        ///< 59     DQA          depth cue slope
  S7_24 dqb{};                       ///< 60     DQB          depth cue offset
  S3_12 zsf3{}, zsf4{};              ///< 61-62  ZSF3 ZSF4    scales for AVSZ3, AVSZ4
  std::uint32_t flag = 0;            ///< 63     FLAG         see namespace flag; bits 0-11 are always 0

  friend constexpr bool operator==(const Registers&, const Registers&) = default;
};

/// Number of equal bits from bit 31 down, 1..32: what LZCR reads for LZCS = `value`.
constexpr std::uint32_t leading_equal_bits(std::uint32_t value) {
  return static_cast<std::uint32_t>((value & 0x80000000u) != 0 ? std::countl_one(value)
                                                               : std::countl_zero(value));
}

/// Reads register `number`, 0..31 data (MFC2, SWC2), 32..63 control (CFC2), with the hardware's sign
/// extension. [docs/hardware.md#gte-registers]
constexpr std::uint32_t read(const Registers& r, unsigned number);

/// Writes register `number` (MTC2, LWC2, CTC2) with its side effects: SXYP pushes the screen FIFO, IRGB sets
/// IR1..3, FLAG makes bit 31 again, ORGB and LZCR ignore the write. Nothing saturates; 16-bit registers keep
/// the low half.
constexpr void write(Registers& r, unsigned number, std::uint32_t value);

// ---- how a 32-bit word is cut into fields

namespace detail {

constexpr std::int16_t low(std::uint32_t word) { return static_cast<std::int16_t>(word & 0xffffu); }
constexpr std::int16_t high(std::uint32_t word) { return static_cast<std::int16_t>(word >> 16); }
constexpr std::uint32_t extend(std::int16_t value) { return static_cast<std::uint32_t>(std::int32_t{value}); }
constexpr std::uint32_t join(std::int16_t lo, std::int16_t hi) {
  return (static_cast<std::uint32_t>(static_cast<std::uint16_t>(hi)) << 16) | static_cast<std::uint16_t>(lo);
}
constexpr Colour colour(std::uint32_t word) {
  return {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
          static_cast<std::uint8_t>(word >> 16), static_cast<std::uint8_t>(word >> 24)};
}
constexpr std::uint32_t word(Colour c) {
  return std::uint32_t{c.r} | (std::uint32_t{c.g} << 8) | (std::uint32_t{c.b} << 16) |
         (std::uint32_t{c.code} << 24);
}

/// A matrix is nine elements in row order, two in a word; the ninth is alone and reads sign-extended.
constexpr std::uint32_t read_matrix(const Matrix& m, unsigned pair) {
  const auto at = [&](unsigned i) { return m[i / 3][i % 3].raw; };
  return pair == 4 ? extend(at(8)) : join(at(pair * 2), at(pair * 2 + 1));
}
constexpr void write_matrix(Matrix& m, unsigned pair, std::uint32_t value) {
  const auto at = [&](unsigned i) -> std::int16_t& { return m[i / 3][i % 3].raw; };
  at(pair * 2) = low(value);
  if (pair != 4) at(pair * 2 + 1) = high(value);
}

/// A channel of IRGB as IR keeps it.
constexpr std::int16_t five_bits(std::uint32_t value) {
  return static_cast<std::int16_t>((value & 0x1fu) << 7);
}

/// IR1..3 as a 15-bit colour: IRi >> 7 limited to 0..1Fh, without touching FLAG.
constexpr std::uint32_t orgb(const Registers& r) {
  std::uint32_t out = 0;
  for (unsigned i = 0; i < 3; ++i) {
    out |= static_cast<std::uint32_t>(std::clamp(r.ir[i + 1] >> 7, 0, 0x1f)) << (5 * i);
  }
  return out;
}

}  // namespace detail

constexpr std::uint32_t read(const Registers& r, unsigned number) {
  using namespace detail;
  assert(number < 64);
  const auto word32 = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
  // clang-format off
  switch (number) {
    case 0: case 2: case 4: return join(r.v[number / 2].x, r.v[number / 2].y);
    case 1: case 3: case 5: return extend(r.v[number / 2].z);
    case 6: return word(r.rgbc);
    case 7: return r.otz;
    case 8: case 9: case 10: case 11: return extend(r.ir[number - 8]);
    case 12: case 13: case 14: return join(r.sxy[number - 12].x, r.sxy[number - 12].y);
    case 15: return join(r.sxy[2].x, r.sxy[2].y);
    case 16: case 17: case 18: case 19: return r.sz[number - 16];
    case 20: case 21: case 22: return word(r.rgb[number - 20]);
    case 23: return r.res1;
    case 24: case 25: case 26: case 27: return word32(r.mac[number - 24]);
    case 28: case 29: return orgb(r);
    case 30: return r.lzcs;
    case 31: return leading_equal_bits(r.lzcs);
    case 32: case 33: case 34: case 35: case 36: return read_matrix(r.rt, number - 32);
    case 37: case 38: case 39: return word32(r.tr[number - 37]);
    case 40: case 41: case 42: case 43: case 44: return read_matrix(r.llm, number - 40);
    case 45: case 46: case 47: return word32(r.bk[number - 45].raw);
    case 48: case 49: case 50: case 51: case 52: return read_matrix(r.lcm, number - 48);
    case 53: case 54: case 55: return word32(r.fc[number - 53].raw);
    case 56: return word32(r.ofx.raw);
    case 57: return word32(r.ofy.raw);
    case 58: return extend(static_cast<std::int16_t>(r.h));  // a hardware bug: arithmetic uses H as unsigned
    case 59: return extend(r.dqa.raw);
    case 60: return word32(r.dqb.raw);
    case 61: return extend(r.zsf3.raw);
    case 62: return extend(r.zsf4.raw);
    case 63: return r.flag;
    default: return 0;
  }
  // clang-format on
}

constexpr void write(Registers& r, unsigned number, std::uint32_t value) {
  using namespace detail;
  assert(number < 64);
  const auto s32 = static_cast<std::int32_t>(value);
  const auto u16 = static_cast<std::uint16_t>(value);
  const ScreenXy xy{low(value), high(value)};
  // clang-format off
  switch (number) {
    case 0: case 2: case 4: r.v[number / 2].x = xy.x; r.v[number / 2].y = xy.y; break;
    case 1: case 3: case 5: r.v[number / 2].z = low(value); break;
    case 6: r.rgbc = colour(value); break;
    case 7: r.otz = u16; break;
    case 8: case 9: case 10: case 11: r.ir[number - 8] = low(value); break;
    case 12: case 13: case 14: r.sxy[number - 12] = xy; break;
    case 15: r.sxy = {r.sxy[1], r.sxy[2], xy}; break;
    case 16: case 17: case 18: case 19: r.sz[number - 16] = u16; break;
    case 20: case 21: case 22: r.rgb[number - 20] = colour(value); break;
    case 23: r.res1 = value; break;
    case 24: case 25: case 26: case 27: r.mac[number - 24] = s32; break;
    case 28: r.ir = {r.ir[0], five_bits(value), five_bits(value >> 5), five_bits(value >> 10)}; break;
    case 30: r.lzcs = value; break;
    case 32: case 33: case 34: case 35: case 36: write_matrix(r.rt, number - 32, value); break;
    case 37: case 38: case 39: r.tr[number - 37] = s32; break;
    case 40: case 41: case 42: case 43: case 44: write_matrix(r.llm, number - 40, value); break;
    case 45: case 46: case 47: r.bk[number - 45].raw = s32; break;
    case 48: case 49: case 50: case 51: case 52: write_matrix(r.lcm, number - 48, value); break;
    case 53: case 54: case 55: r.fc[number - 53].raw = s32; break;
    case 56: r.ofx.raw = s32; break;
    case 57: r.ofy.raw = s32; break;
    case 58: r.h = u16; break;
    case 59: r.dqa.raw = low(value); break;
    case 60: r.dqb.raw = s32; break;
    case 61: r.zsf3.raw = low(value); break;
    case 62: r.zsf4.raw = low(value); break;
    case 63: r.flag = flag::with_error(value & flag::writable); break;
    default: break;  // 29 ORGB and 31 LZCR cannot be written
  }
  // clang-format on
}

}  // namespace gte
