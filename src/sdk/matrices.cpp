// Matrices and vectors. The products are MVMVA of the coprocessor, as on the console: they saturate, and
// leave the left matrix in RT; programs see both.

#include <array>
#include <cstdint>
#include <vector>

#include "gte/commands.h"
#include "sdk/console.h"
#include "sdk/include/psxgte.h"

namespace {

using sdk::half;
using sdk::the_console;

constexpr gte::Command rt_v0 = 0x0486012, rt_ir = 0x049e012, rt_ir_tr = 0x0498012;

void load_rotation(const MATRIX& m) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) the_console().gte.rt[r][c].raw = m.m[r][c];
  }
}

void load_ir(const std::int32_t (&v)[3]) {
  for (std::size_t i = 0; i < 3; ++i) the_console().gte.ir[i + 1] = half(v[i]);
}

/// RT * b into `out`; b may be out.
void multiply(const MATRIX& b, MATRIX& out) {
  auto& gte = the_console().gte;
  const MATRIX right = b;
  for (std::size_t c = 0; c < 3; ++c) {
    gte.v[0] = {right.m[0][c], right.m[1][c], right.m[2][c]};
    gte::execute(gte, rt_v0);
    for (std::size_t r = 0; r < 3; ++r) out.m[r][c] = gte.ir[r + 1];
  }
}

struct Kept {
  gte::Matrix rt;
  std::array<std::int32_t, 3> tr;
};
std::vector<Kept>& stack() {
  static auto& kept = *new std::vector<Kept>;
  return kept;
}

/// X * Y * Z from the sines and cosines of the three angles.
MATRIX* rotation(const std::array<int, 3>& s, const std::array<int, 3>& c, MATRIX* out) {
  const MATRIX x{{{ONE, 0, 0}, {0, half(c[0]), half(-s[0])}, {0, half(s[0]), half(c[0])}}, {}};
  const MATRIX y{{{half(c[1]), 0, half(s[1])}, {0, ONE, 0}, {half(-s[1]), 0, half(c[1])}}, {}};
  const MATRIX z{{{half(c[2]), half(-s[2]), 0}, {half(s[2]), half(c[2]), 0}, {0, 0, ONE}}, {}};
  MATRIX xy{};
  PushMatrix();
  load_rotation(x);
  multiply(y, xy);
  load_rotation(xy);
  multiply(z, *out);
  PopMatrix();
  return out;
}

void scale(std::int16_t& element, std::int32_t by) {
  element = half(static_cast<int>((std::int64_t{element} * by) >> 12));
}

std::int32_t square(std::int32_t v) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(v));
}

}  // namespace

extern "C" {

void InitGeom(void) {
  auto& gte = the_console().gte;
  gte.ofx.raw = gte.ofy.raw = 0;
  gte.h = 320;
  gte.zsf3.raw = ONE / 12;
  gte.zsf4.raw = ONE / 16;
  gte.dqa.raw = half(0xef9e);
  gte.dqb.raw = 0x01400000;
}

void PushMatrix(void) { stack().push_back({the_console().gte.rt, the_console().gte.tr}); }
void PopMatrix(void) {
  if (stack().empty()) {
    the_console().lint.note("bad-size", __builtin_return_address(0),
                            "PopMatrix without a PushMatrix before it");
    return;
  }
  the_console().gte.rt = stack().back().rt;
  the_console().gte.tr = stack().back().tr;
  stack().pop_back();
}

MATRIX* RotMatrix(SVECTOR* r, MATRIX* m) {
  return rotation({isin(r->vx), isin(r->vy), isin(r->vz)}, {icos(r->vx), icos(r->vy), icos(r->vz)}, m);
}
MATRIX* HiRotMatrix(VECTOR* r, MATRIX* m) {
  return rotation({hisin(r->vx), hisin(r->vy), hisin(r->vz)}, {hicos(r->vx), hicos(r->vy), hicos(r->vz)}, m);
}

MATRIX* TransMatrix(MATRIX* m, VECTOR* r) {
  m->t[0] = r->vx;
  m->t[1] = r->vy;
  m->t[2] = r->vz;
  return m;
}

MATRIX* ScaleMatrix(MATRIX* m, VECTOR* s) {
  const std::int32_t by[3] = {s->vx, s->vy, s->vz};
  for (std::size_t r = 0; r < 3; ++r) {
    for (auto& element : m->m[r]) scale(element, by[r]);
  }
  return m;
}
MATRIX* ScaleMatrixL(MATRIX* m, VECTOR* s) {
  const std::int32_t by[3] = {s->vx, s->vy, s->vz};
  for (auto& row : m->m) {
    for (std::size_t c = 0; c < 3; ++c) scale(row[c], by[c]);
  }
  return m;
}

MATRIX* MulMatrix0(MATRIX* m0, MATRIX* m1, MATRIX* m2) {
  load_rotation(*m0);
  multiply(*m1, *m2);
  return m2;
}
MATRIX* MulMatrix(MATRIX* m0, MATRIX* m1) { return MulMatrix0(m0, m1, m0); }

MATRIX* CompMatrixLV(MATRIX* v0, MATRIX* v1, MATRIX* v2) {
  auto& gte = the_console().gte;
  load_rotation(*v0);
  gte.tr = {v0->t[0], v0->t[1], v0->t[2]};
  load_ir(v1->t);
  gte::execute(gte, rt_ir_tr);
  const std::int32_t moved[3] = {gte.ir[1], gte.ir[2], gte.ir[3]};
  multiply(*v1, *v2);
  for (std::size_t i = 0; i < 3; ++i) v2->t[i] = moved[i];
  return v2;
}

VECTOR* ApplyMatrixLV(MATRIX* m, VECTOR* v0, VECTOR* v1) {
  auto& gte = the_console().gte;
  load_rotation(*m);
  load_ir({v0->vx, v0->vy, v0->vz});
  gte::execute(gte, rt_ir);
  *v1 = {gte.ir[1], gte.ir[2], gte.ir[3]};
  return v1;
}

// 4096 / length by a table of 32768 / sqrt(k), k the sum of squares shifted by an even number of bits to 6..8
// significant ones.
void VectorNormalS(VECTOR* v0, SVECTOR* v1) {
  const std::array<std::int32_t, 3> d{half(v0->vx), half(v0->vy), half(v0->vz)};
  std::uint32_t sum = 0;
  for (const auto component : d) sum += static_cast<std::uint32_t>(square(component));
  const int zeros = static_cast<int>(gte::leading_equal_bits(sum)) & ~1;
  const int shift = (31 - zeros) >> 1;
  const std::uint32_t k = zeros >= 24 ? sum << (zeros - 24) : sum >> (24 - zeros);
  std::uint32_t factor = 0;
  constexpr std::uint32_t one = 32768, largest = 4096;
  while ((factor + 1) * (factor + 1) * std::uint64_t{k} <= std::uint64_t{one} * one && factor < largest)
    ++factor;
  const auto scaled = [&](std::int32_t component) {
    return half(static_cast<int>((std::int64_t{component} * factor) >> shift));
  };
  *v1 = {scaled(d[0]), scaled(d[1]), scaled(d[2]), 0};
}

void Square0(VECTOR* v0, VECTOR* v1) { *v1 = {square(v0->vx), square(v0->vy), square(v0->vz)}; }

}  // extern "C"
