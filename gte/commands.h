#pragma once
// The 22 commands, as free functions on Registers, to the bit.
//
// Notation: V0..V2 the vectors, sh = 12 if the command says sf, else 0; lowest = 0 if it says lm, else
// -8000h; A(..) a 44-bit sum (limits.h), every partial sum checked. MACi = low 32 bits of (A >> sh), IRi =
// MACi limited to lowest..7FFFh, i = 1..3, unless a command says otherwise. Every command begins with FLAG =
// 0. All read whole registers and write whole registers; none fails.
// [docs/hardware.md#geometry-the-gte]
//
// Not modelled: time. `cycles` is data for who models it; a command reads all its inputs at once.

#include <array>
#include <cstdint>
#include <string_view>

#include "gte/registers.h"

namespace gte {

/// A command word: the low 25 bits of the CPU's COP2 instruction. Bits 6-9, 11-12 and 20-24 are ignored.
struct Command {
  std::uint32_t word = 0;
  constexpr Command() = default;
  constexpr Command(std::uint32_t command_word)
      : word(command_word) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] constexpr unsigned opcode() const { return word & 0x3fu; }
  [[nodiscard]] constexpr bool lm() const { return ((word >> 10) & 1u) != 0; }  ///< IR1..3 not below 0
  [[nodiscard]] constexpr bool sf() const {
    return ((word >> 19) & 1u) != 0;
  }                                                                          ///< results shifted right by 12
  [[nodiscard]] constexpr unsigned cv() const { return (word >> 13) & 3u; }  ///< MVMVA: TR, BK, FC, none
  [[nodiscard]] constexpr unsigned v() const { return (word >> 15) & 3u; }   ///< MVMVA: V0, V1, V2, IR
  [[nodiscard]] constexpr unsigned mx() const { return (word >> 17) & 3u; }  ///< MVMVA: RT, LLM, LCM, garbage
  [[nodiscard]] constexpr int shift() const { return sf() ? 12 : 0; }
  [[nodiscard]] constexpr std::int32_t lowest_ir() const { return lm() ? 0 : -0x8000; }
};

/// The command words as the console's own library writes them.
namespace sdk {
inline constexpr Command rtps = 0x0180001, nclip = 0x1400006, op = 0x170000c, dpcs = 0x0780010,
                         intpl = 0x0980011, mvmva = 0x0400012, ncds = 0x0e80413, cdp = 0x1280414,
                         ncdt = 0x0f80416, nccs = 0x108041b, cc = 0x138041c, ncs = 0x0c8041e, nct = 0x0d80420,
                         sqr = 0x0a00428, dcpl = 0x0680029, dpct = 0x0f8002a, avsz3 = 0x158002d,
                         avsz4 = 0x168002e, rtpt = 0x0280030, gpf = 0x190003d, gpl = 0x1a0003e,
                         ncct = 0x118043f;
}  // namespace sdk

/// One row of the command table.
struct CommandInfo {
  unsigned opcode = 0;
  std::string_view name{};  ///< "" where the opcode is none of the 22
  unsigned cycles = 0;      ///< CPU cycles until results may be read
  void (*run)(Registers&, Command) = nullptr;
};

/// All 64 opcodes. Of those without a name 00h does what RTPS does and 1Ah what DCPL does; the others do
/// nothing but clear FLAG [ours: the hardware's answer is not known].
extern const std::array<CommandInfo, 64> command_table;

/// Runs whatever command the word says.
void execute(Registers& r, Command c);

// ---- coordinates

/// RTPS: rotates, translates and projects V0.
///     A(i) = TRi*1000h + RTi1*VX0 + RTi2*VY0 + RTi3*VZ0
///     SZ3  = A(3) >> 12 limited to 0..FFFFh, pushed          (>> 12 whatever sf says)
///     q    = H / SZ3, see divide.h
///     SX2  = (OFX + q*IR1) >> 16,  SY2 = (OFY + q*IR2) >> 16, limited to -400h..3FFh, pushed
///     MAC0 = DQB + q*DQA,  IR0 = MAC0 >> 12 limited to 0..1000h, both limits taken from the exact sum
/// Writes  MAC0..3, IR0..3, SZ0..3, SXY0..2, FLAG.
/// Quirk   bit 22 (IR3) is set iff A(3) >> 12 leaves -8000h..7FFFh, whatever sf and lm say; IR3 itself is
/// MAC3 limited as
///         usual, in silence. [docs/hardware.md#perspective-transformation]
void rtps(Registers& r, Command c = sdk::rtps);

/// RTPT: RTPS for V0, V1, V2; only V2 makes MAC0 and IR0. SZ0 is then the SZ3 of before.
void rtpt(Registers& r, Command c = sdk::rtpt);

/// NCLIP: twice the signed area of the screen triangle, positive when clockwise with Y
/// down. sf and lm mean nothing.
///     MAC0 = SX0*(SY1-SY2) + SX1*(SY2-SY0) + SX2*(SY0-SY1)
void nclip(Registers& r, Command c = sdk::nclip);

/// The exact sum of NCLIP, which MAC0 keeps the low 32 bits of; and that of finer positions, below 2^30.
template <class Position>
constexpr std::int64_t signed_area(const Position& a, const Position& b, const Position& c) {
  return std::int64_t{a.x} * (b.y - c.y) + std::int64_t{b.x} * (c.y - a.y) + std::int64_t{c.x} * (a.y - b.y);
}

/// AVSZ3: average of three screen depths, the bucket number of a triangle. sf and lm mean nothing.
///     MAC0 = ZSF3 * (SZ1 + SZ2 + SZ3)      OTZ = exact sum >> 12, limited to 0..FFFFh
/// Reads   SZ1..SZ3 (u16, eye units), ZSF3 (s3.12).   Writes  OTZ, MAC0, FLAG.
void avsz3(Registers& r, Command c = sdk::avsz3);

/// AVSZ4: as AVSZ3 for a quad, MAC0 = ZSF4 * (SZ0 + SZ1 + SZ2 + SZ3).
void avsz4(Registers& r, Command c = sdk::avsz4);

/// What AVSZ3 and AVSZ4 come to before their limits; `depths` is the sum of SZ.
struct DepthAverage {
  std::int64_t mac0, otz;
};
constexpr DepthAverage depth_average(S3_12 scale, std::int64_t depths) {
  const std::int64_t sum = scale.raw * depths;
  return {sum, sum >> 12};
}

// ---- vectors

/// MVMVA: A(i) = Ti*1000h + Mi1*X + Mi2*Y + Mi3*Z with T, M, V from the word. [docs/hardware.md#mvmva]
/// Quirks  cv = 2 (far colour): the first product and the translation only leave their FLAG bits, the
///         result is Mi2*Y + Mi3*Z.   mx = 3: rows (-R<<4, R<<4, IR0), (RT13 x3), (RT22 x3), R = red of RGBC.
void mvmva(Registers& r, Command c);

/// The matrix and the translation that an MVMVA word selects.
Matrix mvmva_matrix(const Registers& r, Command c);
std::array<std::int32_t, 3> mvmva_translation(const Registers& r, Command c);

/// OP: cross product of the RT diagonal D with IR.
///     MAC1 = D2*IR3 - D3*IR2,  MAC2 = D3*IR1 - D1*IR3,  MAC3 = D1*IR2 - D2*IR1
void op(Registers& r, Command c = sdk::op);

/// SQR: MACi = IRi*IRi.
void sqr(Registers& r, Command c = sdk::sqr);

/// GPF: MACi = IR0*IRi, pushed as a colour.
void gpf(Registers& r, Command c = sdk::gpf);

/// GPL: MACi = (MACi << sh) + IR0*IRi, pushed as a colour.
void gpl(Registers& r, Command c = sdk::gpl);

// ---- light and depth cue

// The steps, each leaving MAC1..3 and IR1..3:
//     light(k)   A(i) = LLMi1*VXk + LLMi2*VYk + LLMi3*VZk
//     colour     A(i) = BKi*1000h + LCMi1*IR1 + LCMi2*IR2 + LCMi3*IR3
//     modulate   A(i) = (RGBCi*IRi) << 4
//     cue(in)    d = A(FCi*1000h - in_i), IRi = (d >> sh) limited to -8000h..7FFFh,
//                then A(i) = in_i + IRi*IR0
//     push       the FIFO gets MACi >> 4 limited to 0..FFh, and CODE of RGBC
// The triple forms do V0, V1, V2 one after the other; FLAG gathers all three.

void ncs(Registers& r, Command c = sdk::ncs);    ///< light(0), colour, push
void nct(Registers& r, Command c = sdk::nct);    ///< NCS for V0..2
void nccs(Registers& r, Command c = sdk::nccs);  ///< light(0), colour, modulate, push
void ncct(Registers& r, Command c = sdk::ncct);  ///< NCCS for V0..2
void ncds(Registers& r, Command c = sdk::ncds);  ///< light(0), colour, cue((RGBCi*IRi) << 4), push
void ncdt(Registers& r, Command c = sdk::ncdt);  ///< NCDS for V0..2
void cc(Registers& r, Command c = sdk::cc);      ///< colour, modulate, push
void cdp(Registers& r, Command c = sdk::cdp);    ///< colour, cue((RGBCi*IRi) << 4), push
void dcpl(Registers& r, Command c = sdk::dcpl);  ///< cue((RGBCi*IRi) << 4), push
void dpcs(Registers& r, Command c = sdk::dpcs);  ///< cue(RGBCi << 16), push
void dpct(Registers& r,
          Command c = sdk::dpct);  ///< three times: cue(RGB0i << 16), push; so the FIFO is used in order
void intpl(Registers& r, Command c = sdk::intpl);  ///< cue(IRi << 12), push

}  // namespace gte
