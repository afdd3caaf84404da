// Single commands as tables of {before, command, after}: registers not named before are 0, registers not
// named after are not looked at.

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "gte/check.h"
#include "gte/commands.h"

namespace {

using Values = std::vector<std::pair<const char*, std::uint32_t>>;

struct Example {
  const char* name;
  Values before;
  std::uint32_t command;
  Values after;
};

unsigned number(std::string_view name) {
  for (unsigned i = 0; i < 64; ++i) {
    if (gte::register_name(i) == name) return i;
  }
  FAIL("no register is called ", std::string(name));
  return 0;
}

gte::Registers loaded(const Values& values) {
  gte::Registers r;
  for (const auto& [name, value] : values) gte::write(r, number(name), value);
  return r;
}

void check(const gte::Registers& r, const Values& after) {
  for (const auto& expected : after) {
    CAPTURE(expected.first);
    CHECK(gte::read(r, number(expected.first)) == expected.second);
  }
}

void run(const Example& e) {
  CAPTURE(e.name);
  gte::Registers r = loaded(e.before);
  gte::execute(r, e.command);
  check(r, e.after);
}

Values operator+(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

constexpr std::uint32_t s(std::int32_t v) { return static_cast<std::uint32_t>(v); }
constexpr std::uint32_t sf = 1u << 19, lm = 1u << 10;
constexpr std::uint32_t cv(unsigned v) { return v << 13; }
constexpr std::uint32_t mx(unsigned v) { return v << 17; }

const Values identity{{"R11R12", 0x1000}, {"R22R23", 0x1000}, {"R33", 0x1000}};
const Values screen{{"OFX", 160 << 16}, {"OFY", 120 << 16}, {"H", 320}};
const Values v0{{"VXY0", 50 << 16 | 100}};

}  // namespace

TEST_SUITE("gte") {
  TEST_CASE("RTPS projects, cues and saturates as the hardware does") {
    const Values scene = identity + screen + v0;
    const Values fog{{"TRZ", 1000}, {"DQA", 0xef9e}, {"DQB", 0x01400000}};
    const std::vector<Example> examples{
        {"a vertex in front",
         scene + fog,
         sf | 0x01,
         {{"MAC1", 100},
          {"MAC2", 50},
          {"MAC3", 1000},
          {"IR1", 100},
          {"IR2", 50},
          {"IR3", 1000},
          {"SZ3", 1000},
          {"SXY2", 0x008800c0},
          {"MAC0", 0xfc01e3a8},
          {"IR0", 0},
          {"FLAG", 0x00001000}}},
        {"sf = 0: IR3 is limited in silence, SZ3 is shifted all the same",
         scene + fog,
         0x01,
         {{"MAC1", 0x64000},
          {"MAC2", 0x32000},
          {"MAC3", 0x3e8000},
          {"IR1", 0x7fff},
          {"IR2", 0x7fff},
          {"IR3", 0x7fff},
          {"SZ3", 1000},
          {"SXY2", 0x03ff03ff},
          {"MAC0", 0xfc01e3a8},
          {"FLAG", 0x81807000}}},
        {"too near: the division overflows",
         scene + Values{{"TRZ", 1000}, {"VZ0", s(-900)}},
         sf | 0x01,
         {{"SZ3", 100}, {"SXY2", 0x00db0167}, {"FLAG", 0x80020000}}},
        {"behind the eye with lm: IR3 is 0 and bit 22 clear",
         scene + Values{{"TRZ", s(-5)}},
         sf | lm | 0x01,
         {{"IR1", 100}, {"IR2", 50}, {"IR3", 0}, {"SZ3", 0}, {"SXY2", 0x00db0167}, {"FLAG", 0x80060000}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("MVMVA wraps at 44 bits, and its unused selections do what the hardware does") {
    const Values far_colour = Values{{"R11R12", 3 << 16 | 2},
                                     {"R13R21", 5 << 16 | 4},
                                     {"R22R23", 7 << 16 | 6},
                                     {"R31R32", 9 << 16 | 8},
                                     {"R33", 10},
                                     {"VXY0", 20 << 16 | 10},
                                     {"VZ0", 30},
                                     {"RFC", 0x100},
                                     {"GFC", 0x200},
                                     {"BFC", 0x300},
                                     {"RGBC", 5},
                                     {"IR0", 7}};
    const std::vector<Example> examples{
        {"a sum beyond 2^43",
         {{"TRX", 0x7fffffff}, {"R11R12", 0x7fff}, {"VXY0", 0x7fff}},
         sf | 0x12,
         {{"MAC1", 0x8003ffef}, {"IR1", 0xffff8000}, {"FLAG", 0xc1000000}}},
        {"a sum that overflows and comes back",
         identity + Values{{"R11R12", 0x80007fff}, {"TRX", 0x7fffffff}, {"VXY0", 0x7fff7fff}},
         sf | 0x12,
         {{"MAC1", 0x7ffffff7}, {"IR1", 0x7fff}, {"MAC2", 0x7fff}, {"IR2", 0x7fff}, {"FLAG", 0xc9000000}}},
        {"cv = 2 loses the first product",
         far_colour,
         cv(2) | 0x12,
         {{"MAC1", 180}, {"MAC2", 330}, {"MAC3", 480}, {"FLAG", 0x81c00000}}},
        {"cv = 3 adds nothing",
         far_colour,
         cv(3) | 0x12,
         {{"MAC1", 200}, {"MAC2", 380}, {"MAC3", 560}, {"FLAG", 0}}},
        {"mx = 3 is the garbage matrix",
         far_colour,
         mx(3) | cv(3) | 0x12,
         {{"MAC1", 1010}, {"MAC2", 240}, {"MAC3", 360}, {"FLAG", 0}}},
        {"the lost part keeps its flags",
         {{"R11R12", 0x7fff}, {"VXY0", 0x7fff}, {"RFC", 0x7fffffff}},
         sf | lm | cv(2) | 0x12,
         {{"MAC1", 0}, {"MAC2", 0}, {"MAC3", 0}, {"IR1", 0}, {"IR2", 0}, {"IR3", 0}, {"FLAG", 0xc1000000}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("NCLIP, AVSZ3 and AVSZ4 take their limits from the exact sum") {
    const Values depths{{"SZ0", 1000}, {"SZ1", 1200},   {"SZ2", 1400},
                        {"SZ3", 1600}, {"ZSF3", 0x155}, {"ZSF4", 0x100}};
    const Values deepest{{"SZ0", 0xffff}, {"SZ1", 0xffff}, {"SZ2", 0xffff}, {"SZ3", 0xffff}};
    const std::vector<Example> examples{
        {"clockwise",
         {{"SXY0", 10 << 16 | 10}, {"SXY1", 10 << 16 | 60}, {"SXY2", 60 << 16 | 10}},
         0x06,
         {{"MAC0", 2500}, {"FLAG", 0}}},
        {"anticlockwise",
         {{"SXY0", 10 << 16 | 10}, {"SXY2", 10 << 16 | 60}, {"SXY1", 60 << 16 | 10}},
         0x06,
         {{"MAC0", s(-2500)}, {"FLAG", 0}}},
        {"an area beyond 32 bits",
         {{"SXY0", 0x80008000}, {"SXY1", 0x7fff8000}, {"SXY2", 0x80007fff}},
         0x06,
         {{"MAC0", 0x0001ffff}, {"FLAG", 0x80008000}}},
        {"average of three", depths, 0x2d, {{"MAC0", 1432200}, {"OTZ", 349}, {"FLAG", 0}}},
        {"average of four", depths, 0x2e, {{"MAC0", 1331200}, {"OTZ", 325}, {"FLAG", 0}}},
        {"above the limit",
         deepest + Values{{"ZSF3", 0x7fff}},
         0x2d,
         {{"MAC0", 0x7ffb8003}, {"OTZ", 0xffff}, {"FLAG", 0x80050000}}},
        {"below the limit",
         deepest + Values{{"ZSF3", 0x8000}},
         0x2d,
         {{"MAC0", 0x80018000}, {"OTZ", 0}, {"FLAG", 0x80048000}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("SQR, OP, GPF and GPL saturate IR and the colours") {
    const Values cross{{"R11R12", 0x1000}, {"R22R23", 0x800}, {"R33", 0x400},
                       {"IR1", 100},       {"IR2", 200},      {"IR3", 300}};
    const Values square{{"IR1", 300}, {"IR2", s(-400)}, {"IR3", 32767}};
    const Values gp{{"IR0", 0x800}, {"IR1", 0x1000}, {"IR2", 0xf000}, {"IR3", 0x7fff}, {"RGBC", 0x20000000}};
    const std::vector<Example> examples{
        {"SQR sf = 0",
         square,
         0x28,
         {{"MAC1", 0x15f90},
          {"MAC2", 0x27100},
          {"MAC3", 0x3fff0001},
          {"IR1", 0x7fff},
          {"IR2", 0x7fff},
          {"IR3", 0x7fff},
          {"FLAG", 0x81c00000}}},
        {"SQR sf = 1",
         square,
         sf | 0x28,
         {{"MAC1", 0x15},
          {"MAC2", 0x27},
          {"MAC3", 0x3fff0},
          {"IR1", 0x15},
          {"IR2", 0x27},
          {"IR3", 0x7fff},
          {"FLAG", 0x00400000}}},
        {"OP sf = 1",
         cross,
         sf | 0x0c,
         {{"MAC1", 100},
          {"MAC2", s(-275)},
          {"MAC3", 150},
          {"IR1", 100},
          {"IR2", s(-275)},
          {"IR3", 150},
          {"FLAG", 0}}},
        {"OP sf = 0, lm",
         cross,
         lm | 0x0c,
         {{"MAC1", 0x64000},
          {"MAC2", 0xffeed000},
          {"MAC3", 0x96000},
          {"IR1", 0x7fff},
          {"IR2", 0},
          {"IR3", 0x7fff},
          {"FLAG", 0x81c00000}}},
        {"GPF",
         gp,
         sf | 0x3d,
         {{"MAC1", 0x800},
          {"MAC2", s(-0x800)},
          {"MAC3", 0x3fff},
          {"RGB2", 0x20ff0080},
          {"FLAG", 0x00180000}}},
        {"GPL",
         gp + Values{{"MAC1", 100}, {"MAC2", 200}, {"MAC3", 0x7fffffff}},
         sf | 0x3e,
         {{"MAC1", 0x864},
          {"MAC2", 0xfffff8c8},
          {"MAC3", 0x80003ffe},
          {"IR1", 0x864},
          {"IR2", 0xfffff8c8},
          {"IR3", 0xffff8000},
          {"RGB2", 0x20000086},
          {"FLAG", 0x90580000}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("DPCS, DPCT and INTPL move a colour toward the far colour") {
    const std::vector<Example> examples{
        {"DPCS",
         {{"RGBC", 0x2c806040}, {"IR0", 0x800}, {"RFC", 0xff0}, {"BFC", 0x800}},
         sf | 0x10,
         {{"MAC1", 0x9f8},
          {"MAC2", 0x300},
          {"MAC3", 0x800},
          {"IR1", 0x9f8},
          {"IR2", 0x300},
          {"IR3", 0x800},
          {"RGB2", 0x2c80309f},
          {"FLAG", 0}}},
        {"DPCT at full fog",
         {{"IR0", 0x1000},
          {"RFC", 0x100},
          {"GFC", 0x200},
          {"BFC", 0x300},
          {"RGBC", 0x34000000},
          {"RGB0", 0x102030},
          {"RGB1", 0x405060},
          {"RGB2", 0xff00ff}},
         sf | 0x2a,
         {{"RGB0", 0x34302010}, {"RGB1", 0x34302010}, {"RGB2", 0x34302010}, {"FLAG", 0}}},
        {"DPCT without fog uses the FIFO in order",
         {{"RGBC", 0x34000000}, {"RGB0", 0x102030}, {"RGB1", 0x405060}, {"RGB2", 0xff00ff}},
         sf | 0x2a,
         {{"RGB0", 0x34102030}, {"RGB1", 0x34405060}, {"RGB2", 0x34ff00ff}}},
        {"INTPL",
         {{"IR0", 0x400},
          {"IR1", 0x1000},
          {"IR2", 0x800},
          {"IR3", 0xf000},
          {"RFC", 0x2000},
          {"GFC", 0x10000000}},
         sf | 0x11,
         {{"MAC1", 0x1400},
          {"MAC2", 0x27ff},
          {"MAC3", 0xfffff400},
          {"RGB2", 0x0000ffff},
          {"FLAG", 0x80b80000}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("NCS, NCCS and NCDS light, modulate and cue a normal") {
    const Values light{{"L13L21", 0xf000}, {"LR1LR2", 0x1000},  {"LR3LG1", 0x10000000},
                       {"LB1LB2", 0x1000}, {"RBK", 0x400},      {"GBK", 0x400},
                       {"BBK", 0x400},     {"VZ0", s(-0x1000)}, {"RGBC", 0x30808080}};
    const std::vector<Example> examples{
        {"NCS",
         light,
         sf | lm | 0x1e,
         {{"MAC1", 0x1400}, {"MAC2", 0x1400}, {"MAC3", 0x1400}, {"RGB2", 0x30ffffff}, {"FLAG", 0x00380000}}},
        {"NCCS",
         light,
         sf | lm | 0x1b,
         {{"MAC1", 0xa00}, {"MAC2", 0xa00}, {"MAC3", 0xa00}, {"RGB2", 0x30a0a0a0}, {"FLAG", 0}}},
        {"NCDS",
         light + Values{{"IR0", 0x800}, {"BFC", 0xff0}},
         sf | lm | 0x13,
         {{"MAC1", 0x500}, {"MAC2", 0x500}, {"MAC3", 0xcf8}, {"RGB2", 0x30cf5050}, {"FLAG", 0}}},
    };
    for (const Example& e : examples) run(e);
  }

  TEST_CASE("IRGB spreads 5-bit colours over IR1..3, and ORGB gathers them with saturation") {
    const gte::Registers r = loaded({{"IRGB", 0x7fff}});
    check(r, {{"IR1", 0xf80}, {"IR2", 0xf80}, {"IR3", 0xf80}, {"ORGB", 0x7fff}, {"IRGB", 0x7fff}});
    check(loaded({{"IR1", 0xffff}, {"IR2", 0x1000}, {"IR3", 0x0fff}}), {{"ORGB", 0x7fe0}, {"FLAG", 0}});
  }

  TEST_CASE("LZCR counts the leading bits of LZCS that are equal") {
    const Values counts[] = {{{"LZCS", 0}, {"LZCR", 32}},          {{"LZCS", 1}, {"LZCR", 31}},
                             {{"LZCS", 0xffffffff}, {"LZCR", 32}}, {{"LZCS", 0x80000000}, {"LZCR", 1}},
                             {{"LZCS", 0x7fffffff}, {"LZCR", 1}},  {{"LZCS", 0x00010000}, {"LZCR", 15}},
                             {{"LZCS", 0xfffe0000}, {"LZCR", 15}}};
    for (const Values& count : counts) check(loaded({count[0]}), count);
  }

  TEST_CASE("FLAG keeps bits 12..30 of a write and makes bit 31 from its error mask") {
    check(loaded({{"FLAG", 0xffffffff}}), {{"FLAG", 0xfffff000}});
    check(loaded({{"FLAG", 0x00001000}}), {{"FLAG", 0x00001000}});
    check(loaded({{"FLAG", 0x00780000}}), {{"FLAG", 0x00780000}});
    check(loaded({{"FLAG", 0x00800000}}), {{"FLAG", 0x80800000}});
  }

  TEST_CASE("H reads back sign-extended although it is unsigned") {
    check(loaded({{"H", 0x8001}}), {{"H", 0xffff8001}});
  }

  TEST_CASE("a write to SXYP pushes the screen FIFO, a write to SXY2 does not") {
    const Values three{{"SXY0", 1}, {"SXY1", 2}, {"SXY2", 3}};
    check(loaded(three + Values{{"SXYP", 4}}), {{"SXY0", 2}, {"SXY1", 3}, {"SXY2", 4}, {"SXYP", 4}});
    check(loaded(three + Values{{"SXY2", 4}}), {{"SXY0", 1}, {"SXY1", 2}, {"SXY2", 4}, {"SXYP", 4}});
  }

  TEST_CASE("ORGB and LZCR cannot be written") {
    check(loaded({{"ORGB", 0x7fff}, {"LZCR", 5}}), {{"IR1", 0}, {"ORGB", 0}, {"LZCR", 32}});
  }

  TEST_CASE("an unlisted opcode clears FLAG and touches nothing else") {
    for (unsigned opcode = 0; opcode < 64; ++opcode) {
      if (!gte::command_table[opcode].name.empty() || opcode == 0x00 || opcode == 0x1a) continue;
      gte::Registers r;
      for (unsigned i = 0; i < 64; ++i) gte::write(r, i, 0x12345678u * (i + 1));
      gte::Registers expected = r;
      expected.flag = 0;
      gte::execute(r, opcode);
      CHECK(r == expected);
    }
  }

  TEST_CASE("opcode 00h does what RTPS does, and 1Ah what DCPL does") {
    for (const auto& [opcode, twin] : {std::pair{0x00u, 0x01u}, std::pair{0x1au, 0x29u}}) {
      gte::Registers r;
      for (unsigned i = 0; i < 64; ++i) gte::write(r, i, 0x12345678u * (i + 1));
      gte::Registers expected = r;
      gte::execute(expected, 0x80000u | twin);
      gte::execute(r, 0x80000u | opcode);
      CHECK(r == expected);
    }
  }

  TEST_CASE("the command table lists 22 commands, each under the opcode of its SDK word") {
    int named = 0;
    for (const gte::CommandInfo& c : gte::command_table) named += c.name.empty() ? 0 : 1;
    CHECK(named == 22);
    CHECK(gte::command_table[gte::sdk::ncdt.opcode()].name == "NCDT");
    CHECK(gte::command_table[gte::sdk::ncdt.opcode()].cycles == 44);
    CHECK(gte::command_table[gte::sdk::rtps.opcode()].cycles == 15);
    CHECK(gte::sdk::rtps.sf());
    CHECK_FALSE(gte::sdk::rtps.lm());
    CHECK(gte::sdk::ncds.lm());
  }
}
