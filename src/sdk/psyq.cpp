// What the older SDK's names need beyond the newer one's.

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "sdk/console.h"
#include "sdk/include/psxapi.h"
#include "sdk/include/psxgpu.h"
#include "sdk/include/psxgte.h"
#include "sdk/include/psxpad.h"

namespace {

using sdk::half;

MATRIX about_x(int angle) {
  const auto s = half(isin(angle)), c = half(icos(angle));
  return {{{ONE, 0, 0}, {0, c, half(-s)}, {0, s, c}}, {}};
}
MATRIX about_y(int angle) {
  const auto s = half(isin(angle)), c = half(icos(angle));
  return {{{c, 0, s}, {0, ONE, 0}, {half(-s), 0, c}}, {}};
}
MATRIX about_z(int angle) {
  const auto s = half(isin(angle)), c = half(icos(angle));
  return {{{c, half(-s), 0}, {s, c, 0}, {0, 0, ONE}}, {}};
}

/// m = turn * m, with the registers as they were.
MATRIX* turn_by(MATRIX turn, MATRIX* m) {
  PushMatrix();
  MulMatrix0(&turn, m, m);
  PopMatrix();
  return m;
}

/// out = a * b * c, with the registers as they were; the translation stays.
MATRIX* product(MATRIX a, MATRIX b, MATRIX c, MATRIX* out) {
  MATRIX ab{};
  PushMatrix();
  MulMatrix0(&a, &b, &ab);
  MulMatrix0(&ab, &c, out);
  PopMatrix();
  return out;
}

const std::uint32_t* next_tim = nullptr;
int print_stream = -1;
std::uint8_t pad_answers[2][34];

}  // namespace

extern "C" {

MATRIX* otter_scale_columns(MATRIX* m, VECTOR* s) { return ScaleMatrixL(m, s); }
MATRIX* otter_scale_rows(MATRIX* m, VECTOR* s) { return ScaleMatrix(m, s); }

MATRIX* RotMatrixX(long r, MATRIX* m) { return turn_by(about_x(static_cast<int>(r)), m); }
MATRIX* RotMatrixY(long r, MATRIX* m) { return turn_by(about_y(static_cast<int>(r)), m); }
MATRIX* RotMatrixZ(long r, MATRIX* m) { return turn_by(about_z(static_cast<int>(r)), m); }
MATRIX* RotMatrixYXZ(SVECTOR* r, MATRIX* m) {
  return product(about_y(r->vy), about_x(r->vx), about_z(r->vz), m);
}
MATRIX* RotMatrixZYX(SVECTOR* r, MATRIX* m) {
  return product(about_z(r->vz), about_y(r->vy), about_x(r->vx), m);
}

MATRIX* TransposeMatrix(MATRIX* m0, MATRIX* m1) {
  const MATRIX from = *m0;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) m1->m[r][c] = from.m[c][r];
  }
  return m1;
}

MATRIX* MulMatrix2(MATRIX* m0, MATRIX* m1) { return MulMatrix0(m0, m1, m1); }
MATRIX* CompMatrix(MATRIX* m0, MATRIX* m1, MATRIX* m2) { return CompMatrixLV(m0, m1, m2); }

VECTOR* ApplyMatrix(MATRIX* m, SVECTOR* v0, VECTOR* v1) {
  VECTOR v{v0->vx, v0->vy, v0->vz};
  return ApplyMatrixLV(m, &v, v1);
}
SVECTOR* ApplyMatrixSV(MATRIX* m, SVECTOR* v0, SVECTOR* v1) {
  VECTOR out{};
  ApplyMatrix(m, v0, &out);
  v1->vx = half(out.vx);
  v1->vy = half(out.vy);
  v1->vz = half(out.vz);
  return v1;
}
VECTOR* ApplyRotMatrix(SVECTOR* v0, VECTOR* v1) {
  auto& gte = sdk::the_console().gte;
  gte.v[0] = {v0->vx, v0->vy, v0->vz, 0};
  gte::execute(gte, gte::Command(0x0486012));
  *v1 = {gte.mac[1], gte.mac[2], gte.mac[3]};
  return v1;
}

void VectorNormal(VECTOR* v0, VECTOR* v1) {
  SVECTOR out{};
  VectorNormalS(v0, &out);
  v1->vx = out.vx;
  v1->vy = out.vy;
  v1->vz = out.vz;
}
void VectorNormalSS(SVECTOR* v0, SVECTOR* v1) {
  VECTOR v{v0->vx, v0->vy, v0->vz};
  VectorNormalS(&v, v1);
}

int ratan2(int y, int x) {
  constexpr double units_per_radian = 2048 / 3.14159265358979323846;
  return static_cast<int>(std::lround(std::atan2(y, x) * units_per_radian));
}

// IR0 = 1 - (1 - near / z) * far / (far - near) of H / z, as DQA + DQB: no fog at `near`, all at `far`.
void SetFogNearFar(long near, long far, long h) {
  if (far - near < 100 || h == 0) return;
  auto& gte = sdk::the_console().gte;
  gte.dqa.raw = half(static_cast<int>(-(near * far / (far - near)) * 256 / h));
  gte.dqb.raw = static_cast<std::int32_t>((far * 4096 / (far - near)) * 4096);
}

int OpenTIM(std::uint32_t* address) {
  next_tim = address;
  return 0;
}
TIM_IMAGE* ReadTIM(TIM_IMAGE* image) {
  if (next_tim == nullptr || GetTimInfo(next_tim, image) != 0) return nullptr;
  next_tim = nullptr;
  return image;
}

int ClearImage(RECT* rect, unsigned char r, unsigned char g, unsigned char b) {
  if (!sdk::is_usable(rect, "ClearImage", __builtin_return_address(0))) return -1;
  FILL fill{};
  setFill(&fill);
  setRGB0(&fill, r, g, b);
  fill.x0 = static_cast<std::uint16_t>(rect->x);
  fill.y0 = static_cast<std::uint16_t>(rect->y);
  fill.w = static_cast<std::uint16_t>(rect->w);
  fill.h = static_cast<std::uint16_t>(rect->h);
  DrawPrim(&fill);
  return 0;
}

unsigned short LoadTPage(std::uint32_t* pixels, int depth, int blend, int x, int y, int w, int h) {
  const int pixels_a_word = depth == 0 ? 4 : depth == 1 ? 2 : 1;
  const RECT area{half(x), half(y), half(w / pixels_a_word), half(h)};
  LoadImage(&area, pixels);
  return static_cast<unsigned short>(getTPage(depth, blend, x, y));
}
unsigned short LoadClut(std::uint32_t* colours, int x, int y) {
  const RECT area{half(x), half(y), 256, 1};
  LoadImage(&area, colours);
  return static_cast<unsigned short>(getClut(x, y));
}

// Its mask has a bit for every bit that the size does not reach.
void otter_set_window(std::uint32_t* code, const RECT* window) {
  *code = 0xe2000000;
  if (window == nullptr) return;
  const auto mask = [](int size) { return (~static_cast<std::uint32_t>(size - 1) & 0xff) >> 3; };
  const auto offset = [](int at) { return (static_cast<std::uint32_t>(at) & 0xff) >> 3; };
  *code |= mask(window->w) | mask(window->h) << 5 | offset(window->x) << 10 | offset(window->y) << 15;
}

void otter_use_stream(int id) { print_stream = id; }

int otter_print(std::uintptr_t first, ...) {
  constexpr std::uintptr_t most_streams = 64;
  const auto number = static_cast<std::int32_t>(first);
  const bool has_number = first < most_streams || number == -1;
  va_list arguments;
  va_start(arguments, first);
  const auto* format = has_number ? va_arg(arguments, const char*) : reinterpret_cast<const char*>(first);
  char text[1024];
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return FntPrint(has_number ? number : print_stream, "%s", text);
}

void PadInit(int) {
  InitPAD(pad_answers[0], sizeof pad_answers[0], pad_answers[1], sizeof pad_answers[1]);
  StartPAD();
  for (auto& answer : pad_answers) answer[0] = 0xff;
}

std::uint32_t PadRead(int) {
  std::uint32_t held = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto* answer = pad_answers[i];
    if (answer[0] != 0) continue;
    // The older SDK has the bytes the other way round.
    held |= (static_cast<std::uint32_t>(static_cast<std::uint8_t>(~answer[3])) |
             static_cast<std::uint32_t>(static_cast<std::uint8_t>(~answer[2])) << 8)
            << (16 * i);
  }
  return held;
}

}  // extern "C"
