#pragma once
// The coprocessor's macros: gte_ld* load registers, gte_st* store them, the others run a command. Here they
// are inline functions over one set of registers; a pointer may be of any type, as with the macros. Register
// numbers: data 0..31, control 32..63.   [psx-spx, "GTE Registers"]

#include <stdint.h>

#include "otter_hooks.h"

// ---- loads: vectors, colours, positions

static inline void otter_gte_load_vector(const void* p, unsigned offset, unsigned n) {
  otter_gte_put(2 * n, otter_word(p, offset));
  otter_gte_put(2 * n + 1, otter_half(p, offset + 4));
}
static inline void otter_gte_load_words(const void* p, unsigned offset, unsigned first, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_gte_put(first + i, otter_word(p, offset + 4 * i));
}
static inline void otter_gte_load_halves(const void* p, unsigned step, unsigned first, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_gte_put(first + i, otter_half(p, step * i));
}
static inline void otter_gte_load_bytes(const void* p, unsigned first, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_gte_put(first + i, otter_byte(p, i));
}
static inline void otter_gte_put3(unsigned first, uint32_t a, uint32_t b, uint32_t c) {
  otter_gte_put(first, a);
  otter_gte_put(first + 1, b);
  otter_gte_put(first + 2, c);
}

static inline void gte_ldv0(const void* p) { otter_gte_load_vector(p, 0, 0); }
static inline void gte_ldv1(const void* p) { otter_gte_load_vector(p, 0, 1); }
static inline void gte_ldv2(const void* p) { otter_gte_load_vector(p, 0, 2); }
static inline void gte_ldv3(const void* a, const void* b, const void* c) {
  gte_ldv0(a);
  gte_ldv1(b);
  gte_ldv2(c);
}
static inline void gte_ldv3c(const void* p) {  // SVECTOR[3]
  for (unsigned n = 0; n < 3; ++n) otter_gte_load_vector(p, 8 * n, n);
}
static inline void gte_ldv3c_vertc(const void* p) {  // SVECTOR and a colour word, three times
  for (unsigned n = 0; n < 3; ++n) otter_gte_load_vector(p, 12 * n, n);
}
static inline void gte_ldv01(const void* a, const void* b) {
  gte_ldv0(a);
  gte_ldv1(b);
}
static inline void gte_ldv01c(const void* p) {  // SVECTOR[2]
  for (unsigned n = 0; n < 2; ++n) otter_gte_load_vector(p, 8 * n, n);
}
static inline void gte_ldlv0(const void* p) {  // V0 from a VECTOR: the low halves of its words
  otter_gte_put(0, (otter_word(p, 0) & 0xffff) | otter_word(p, 4) << 16);
  otter_gte_put(1, otter_word(p, 8));
}
static inline void gte_ldrgb(const void* p) { otter_gte_load_words(p, 0, 6, 1); }
static inline void gte_SetRGBcd(const void* p) { gte_ldrgb(p); }
static inline void gte_ldrgb3(const void* a, const void* b, const void* c) {
  otter_gte_put3(20, otter_word(a, 0), otter_word(b, 0), otter_word(c, 0));
  gte_ldrgb(c);
}
static inline void gte_ldrgb3c(const void* p) {
  otter_gte_load_words(p, 0, 20, 3);
  otter_gte_put(6, otter_word(p, 8));
}
static inline void gte_ldsxy0(uint32_t xy) { otter_gte_put(12, xy); }
static inline void gte_ldsxy1(uint32_t xy) { otter_gte_put(13, xy); }
static inline void gte_ldsxy2(uint32_t xy) { otter_gte_put(14, xy); }
static inline void gte_ldsxy3(uint32_t a, uint32_t b, uint32_t c) { otter_gte_put3(12, a, b, c); }
static inline void gte_ldsxy3c(const void* p) { otter_gte_load_words(p, 0, 12, 3); }
static inline void gte_ldsz3(uint32_t a, uint32_t b, uint32_t c) { otter_gte_put3(17, a, b, c); }
static inline void gte_ldsz4(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  otter_gte_put(16, a);
  otter_gte_put3(17, b, c, d);
}

// ---- loads: IR, the depth cue, LZCS

static inline void gte_ldlvl(const void* p) { otter_gte_load_words(p, 0, 9, 3); }
static inline void gte_ldsv(const void* p) { otter_gte_load_halves(p, 2, 9, 3); }
static inline void gte_ldbv(const void* p) { otter_gte_load_bytes(p, 9, 2); }
static inline void gte_ldcv(const void* p) { otter_gte_load_bytes(p, 9, 3); }
static inline void gte_ldclmv(const void* p) { otter_gte_load_halves(p, 6, 9, 3); }  // a column of a MATRIX
static inline void gte_ldopv2(const void* p) { gte_ldlvl(p); }
static inline void gte_ldopv2SV(const void* p) { gte_ldsv(p); }
static inline void gte_lddp(uint32_t value) { otter_gte_put(8, value); }
static inline void gte_ldlzc(uint32_t value) { otter_gte_put(30, value); }

// ---- loads: control registers

static inline void otter_gte_load_matrix(const void* p, unsigned first) {
  otter_gte_load_words(p, 0, first, 4);
  otter_gte_put(first + 4, otter_half(p, 16));
}
static inline void gte_SetRotMatrix(const void* p) { otter_gte_load_matrix(p, 32); }
static inline void gte_SetLightMatrix(const void* p) { otter_gte_load_matrix(p, 40); }
static inline void gte_SetColorMatrix(const void* p) { otter_gte_load_matrix(p, 48); }
static inline void gte_SetTransMatrix(const void* p) { otter_gte_load_words(p, 20, 37, 3); }
static inline void gte_SetTransVector(const void* p) { otter_gte_load_words(p, 0, 37, 3); }
static inline void gte_ldtr(uint32_t x, uint32_t y, uint32_t z) { otter_gte_put3(37, x, y, z); }
static inline void gte_ldsvrtrow0(const void* p) { otter_gte_load_words(p, 0, 32, 2); }
static inline void gte_ldsvllrow0(const void* p) { otter_gte_load_words(p, 0, 40, 2); }
static inline void gte_ldsvlcrow0(const void* p) { otter_gte_load_words(p, 0, 48, 2); }
static inline void gte_ldbkdir(uint32_t r, uint32_t g, uint32_t b) { otter_gte_put3(45, r, g, b); }
static inline void gte_SetBackColor(uint32_t r, uint32_t g, uint32_t b) {
  otter_gte_put3(45, r << 4, g << 4, b << 4);
}
static inline void gte_ldfcdir(uint32_t r, uint32_t g, uint32_t b) { otter_gte_put3(53, r, g, b); }
static inline void gte_SetFarColor(uint32_t r, uint32_t g, uint32_t b) {
  otter_gte_put3(53, r << 4, g << 4, b << 4);
}
static inline void gte_ldfc(const void* p) { otter_gte_load_words(p, 0, 53, 3); }
static inline void gte_SetGeomOffset(uint32_t x, uint32_t y) {
  otter_gte_put(56, x << 16);
  otter_gte_put(57, y << 16);
}
static inline void gte_SetGeomScreen(uint32_t h) { otter_gte_put(58, h); }
// The outer product's first vector lies on the diagonal of the rotation matrix.
static inline void gte_ldopv1(const void* p) {
  for (unsigned i = 0; i < 3; ++i) otter_gte_put(32 + 2 * i, otter_word(p, 4 * i));
}
static inline void gte_ldopv1SV(const void* p) {
  for (unsigned i = 0; i < 3; ++i) otter_gte_put(32 + 2 * i, otter_half(p, 2 * i));
}
// The two ends of an interpolation: the first in the far colour, the second in IR.
static inline void gte_ld_intpol_uv0(const void* p) { otter_gte_load_bytes(p, 53, 2); }
static inline void gte_ld_intpol_uv1(const void* p) { otter_gte_load_bytes(p, 9, 2); }
static inline void gte_ld_intpol_bv0(const void* p) { otter_gte_load_bytes(p, 53, 2); }
static inline void gte_ld_intpol_bv1(const void* p) { otter_gte_load_bytes(p, 9, 2); }
static inline void gte_ld_intpol_sv0(const void* p) { otter_gte_load_halves(p, 2, 53, 3); }
static inline void gte_ld_intpol_sv1(const void* p) { otter_gte_load_halves(p, 2, 9, 3); }

// ---- stores: screen positions, which the runtime remembers

static inline void gte_stsxy0(void* p) { otter_gte_store_xy(p, 0); }
static inline void gte_stsxy1(void* p) { otter_gte_store_xy(p, 1); }
static inline void gte_stsxy2(void* p) { otter_gte_store_xy(p, 2); }
static inline void gte_stsxy(void* p) { otter_gte_store_xy(p, 2); }
static inline void gte_stsxy3(void* a, void* b, void* c) {
  gte_stsxy0(a);
  gte_stsxy1(b);
  gte_stsxy2(c);
}
static inline void gte_stsxy01(void* a, void* b) {
  gte_stsxy0(a);
  gte_stsxy1(b);
}
static inline void otter_gte_store_xys(void* p, unsigned offset, unsigned step, unsigned count) {
  for (unsigned n = 0; n < count; ++n) otter_gte_store_xy((char*)p + offset + n * step, n);
}
static inline void gte_stsxy3c(void* p) { otter_gte_store_xys(p, 0, 4, 3); }
static inline void gte_stsxy01c(void* p) { otter_gte_store_xys(p, 0, 4, 2); }
// Vertices 0..2 of a packet: behind the tag and the colour, as far apart as its kind says.
static inline void gte_stsxy3_f3(void* p) { otter_gte_store_xys(p, 8, 4, 3); }
static inline void gte_stsxy3_f4(void* p) { otter_gte_store_xys(p, 8, 4, 3); }
static inline void gte_stsxy3_g3(void* p) { otter_gte_store_xys(p, 8, 8, 3); }
static inline void gte_stsxy3_g4(void* p) { otter_gte_store_xys(p, 8, 8, 3); }
static inline void gte_stsxy3_ft3(void* p) { otter_gte_store_xys(p, 8, 8, 3); }
static inline void gte_stsxy3_ft4(void* p) { otter_gte_store_xys(p, 8, 8, 3); }
static inline void gte_stsxy3_gt3(void* p) { otter_gte_store_xys(p, 8, 12, 3); }
static inline void gte_stsxy3_gt4(void* p) { otter_gte_store_xys(p, 8, 12, 3); }

// ---- stores: everything else

static inline void otter_gte_store(void* p, unsigned offset, unsigned first, unsigned step, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_put_word(p, offset + step * i, otter_gte_get(first + i));
}
static inline void otter_gte_store_halves(void* p, unsigned first, unsigned step, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_put_half(p, step * i, otter_gte_get(first + i));
}
static inline void otter_gte_store_bytes(void* p, unsigned first, unsigned count) {
  for (unsigned i = 0; i < count; ++i) otter_put_byte(p, i, otter_gte_get(first + i));
}
static inline void gte_stdp(void* p) { otter_gte_store(p, 0, 8, 4, 1); }
static inline void gte_stflg(void* p) { otter_gte_store(p, 0, 63, 4, 1); }
static inline void gte_stflg_4(void* p) { otter_put_word(p, 0, otter_gte_get(63) & 0x40000); }
static inline void gte_stsz(void* p) { otter_gte_store(p, 0, 19, 4, 1); }
static inline void gte_stsz3(void* a, void* b, void* c) {
  otter_gte_store(a, 0, 17, 4, 1);
  otter_gte_store(b, 0, 18, 4, 1);
  otter_gte_store(c, 0, 19, 4, 1);
}
static inline void gte_stsz4(void* a, void* b, void* c, void* d) {
  otter_gte_store(a, 0, 16, 4, 1);
  gte_stsz3(b, c, d);
}
static inline void gte_stsz3c(void* p) { otter_gte_store(p, 0, 17, 4, 3); }
static inline void gte_stsz4c(void* p) { otter_gte_store(p, 0, 16, 4, 4); }
static inline void gte_stszotz(void* p) { otter_put_word(p, 0, otter_gte_get(19) >> 2); }
static inline void gte_stotz(void* p) { otter_gte_store(p, 0, 7, 4, 1); }
static inline void gte_stopz(void* p) { otter_gte_store(p, 0, 24, 4, 1); }
static inline void gte_stlvl(void* p) { otter_gte_store(p, 0, 9, 4, 3); }
static inline void gte_stlvnl(void* p) { otter_gte_store(p, 0, 25, 4, 3); }
static inline void gte_stlvnl0(void* p) { otter_gte_store(p, 0, 25, 4, 1); }
static inline void gte_stlvnl1(void* p) { otter_gte_store(p, 0, 26, 4, 1); }
static inline void gte_stlvnl2(void* p) { otter_gte_store(p, 0, 27, 4, 1); }
static inline void gte_stsv(void* p) { otter_gte_store_halves(p, 9, 2, 3); }
static inline void gte_stclmv(void* p) { otter_gte_store_halves(p, 9, 6, 3); }
static inline void gte_stbv(void* p) { otter_gte_store_bytes(p, 9, 2); }
static inline void gte_stcv(void* p) { otter_gte_store_bytes(p, 9, 3); }
static inline void gte_strgb(void* p) { otter_gte_store(p, 0, 22, 4, 1); }
static inline void gte_strgb3(void* a, void* b, void* c) {
  otter_gte_store(a, 0, 20, 4, 1);
  otter_gte_store(b, 0, 21, 4, 1);
  otter_gte_store(c, 0, 22, 4, 1);
}
static inline void gte_strgb3_g3(void* p) { otter_gte_store(p, 4, 20, 8, 3); }
static inline void gte_strgb3_g4(void* p) { otter_gte_store(p, 4, 20, 8, 3); }
static inline void gte_strgb3_gt3(void* p) { otter_gte_store(p, 4, 20, 12, 3); }
static inline void gte_strgb3_gt4(void* p) { otter_gte_store(p, 4, 20, 12, 3); }
static inline void gte_stlzc(void* p) { otter_gte_store(p, 0, 31, 4, 1); }
static inline void gte_stfc(void* p) { otter_gte_store(p, 0, 53, 4, 3); }
static inline void gte_sttr(void* p) { otter_gte_store(p, 0, 37, 4, 3); }
// A MATRIX: five words of elements, three of the vector that follows in the registers.
static inline void gte_ReadRotMatrix(void* p) { otter_gte_store(p, 0, 32, 4, 8); }
static inline void gte_ReadLightMatrix(void* p) { otter_gte_store(p, 0, 40, 4, 8); }
static inline void gte_ReadColorMatrix(void* p) { otter_gte_store(p, 0, 48, 4, 8); }
static inline void gte_ReadGeomOffset(void* x, void* y) {
  otter_put_word(x, 0, (uint32_t)((int32_t)otter_gte_get(56) >> 16));
  otter_put_word(y, 0, (uint32_t)((int32_t)otter_gte_get(57) >> 16));
}
static inline void gte_ReadGeomScreen(void* p) { otter_gte_store(p, 0, 58, 4, 1); }

// ---- arithmetic of the macros' own

static inline void gte_mvlvtr(void) {
  otter_gte_put3(37, otter_gte_get(25), otter_gte_get(26), otter_gte_get(27));
}
static inline void gte_FlipTRX(void) { otter_gte_put(37, 0u - otter_gte_get(37)); }
static inline void gte_FlipRotMatrixX(void) {  // negates the first row
  const uint32_t a = otter_gte_get(32), b = otter_gte_get(33);
  otter_gte_put(32, ((0u - a) & 0xffff) | (0u - (a >> 16)) << 16);
  otter_gte_put(33, ((0u - b) & 0xffff) | (b & 0xffff0000u));
}
// DVECTOR +- DVECTOR, into a VECTOR (l) or a DVECTOR (d). The two words pass through IR1 and IR2.
static inline void otter_gte_load_pair(const void* a, const void* b) {
  otter_gte_put(9, otter_word(a, 0));
  otter_gte_put(10, otter_word(b, 0));
}
static inline void gte_subdvl(const void* a, const void* b, void* out) {
  const uint32_t x = otter_half(a, 0) - otter_half(b, 0), y = otter_half(a, 2) - otter_half(b, 2);
  otter_gte_load_pair(a, b);
  otter_put_word(out, 0, x);
  otter_put_word(out, 4, y);
}
static inline void gte_subdvd(const void* a, const void* b, void* out) {
  const uint32_t x = otter_half(a, 0) - otter_half(b, 0), y = otter_half(a, 2) - otter_half(b, 2);
  otter_gte_load_pair(a, b);
  otter_put_half(out, 0, x);
  otter_put_half(out, 2, y);
}
static inline void gte_adddvl(const void* a, const void* b, void* out) {
  const uint32_t x = otter_half(a, 0) + otter_half(b, 0), y = otter_half(a, 2) + otter_half(b, 2);
  otter_gte_load_pair(a, b);
  otter_put_word(out, 0, x);
  otter_put_word(out, 4, y);
}
static inline void gte_adddvd(const void* a, const void* b, void* out) {
  const uint32_t x = otter_half(a, 0) + otter_half(b, 0), y = otter_half(a, 2) + otter_half(b, 2);
  otter_gte_load_pair(a, b);
  otter_put_half(out, 0, x);
  otter_put_half(out, 2, y);
}

// ---- commands. gte_NAME_b is the one without the two waiting instructions before it: the same here.

#define OTTER_GTE_COMMAND(name, word)                         \
  static inline void gte_##name(void) { otter_gte_do(word); } \
  static inline void gte_##name##_b(void) { otter_gte_do(word); }
/// MVMVA: shift by 12, matrix (0 rotation, 1 light, 2 colour), vector (0..2 V0..V2, 3 IR), translation
/// (0 TR, 1 BK, 3 none), IR not below 0.
#define OTTER_GTE_MVMVA(sf, mx, v, cv, lm)                                                                 \
  (0x0400012u | (uint32_t)(sf) << 19 | (uint32_t)(mx) << 17 | (uint32_t)(v) << 15 | (uint32_t)(cv) << 13 | \
   (uint32_t)(lm) << 10)
#define OTTER_GTE_PRODUCTS(name, mx)                             \
  OTTER_GTE_COMMAND(name##v0, OTTER_GTE_MVMVA(1, mx, 0, 3, 0))   \
  OTTER_GTE_COMMAND(name##v1, OTTER_GTE_MVMVA(1, mx, 1, 3, 0))   \
  OTTER_GTE_COMMAND(name##v2, OTTER_GTE_MVMVA(1, mx, 2, 3, 0))   \
  OTTER_GTE_COMMAND(name##ir, OTTER_GTE_MVMVA(1, mx, 3, 3, 0))   \
  OTTER_GTE_COMMAND(name##v0tr, OTTER_GTE_MVMVA(1, mx, 0, 0, 0)) \
  OTTER_GTE_COMMAND(name##v1tr, OTTER_GTE_MVMVA(1, mx, 1, 0, 0)) \
  OTTER_GTE_COMMAND(name##v2tr, OTTER_GTE_MVMVA(1, mx, 2, 0, 0)) \
  OTTER_GTE_COMMAND(name##irtr, OTTER_GTE_MVMVA(1, mx, 3, 0, 0)) \
  OTTER_GTE_COMMAND(name##v0bk, OTTER_GTE_MVMVA(1, mx, 0, 1, 0)) \
  OTTER_GTE_COMMAND(name##v1bk, OTTER_GTE_MVMVA(1, mx, 1, 1, 0)) \
  OTTER_GTE_COMMAND(name##v2bk, OTTER_GTE_MVMVA(1, mx, 2, 1, 0)) \
  OTTER_GTE_COMMAND(name##irbk, OTTER_GTE_MVMVA(1, mx, 3, 1, 0))

OTTER_GTE_COMMAND(rtps, 0x0180001)
OTTER_GTE_COMMAND(rtpt, 0x0280030)
OTTER_GTE_COMMAND(nclip, 0x1400006)
OTTER_GTE_COMMAND(avsz3, 0x158002d)
OTTER_GTE_COMMAND(avsz4, 0x168002e)
OTTER_GTE_COMMAND(rt, OTTER_GTE_MVMVA(1, 0, 0, 0, 0))
OTTER_GTE_COMMAND(rtir_sf0, OTTER_GTE_MVMVA(0, 0, 3, 3, 0))
OTTER_GTE_PRODUCTS(rt, 0)
OTTER_GTE_COMMAND(ll, OTTER_GTE_MVMVA(1, 1, 0, 3, 1))
OTTER_GTE_PRODUCTS(ll, 1)
OTTER_GTE_COMMAND(lc, OTTER_GTE_MVMVA(1, 2, 3, 1, 1))
OTTER_GTE_PRODUCTS(lc, 2)
OTTER_GTE_COMMAND(dpcl, 0x0680029)
OTTER_GTE_COMMAND(dpcs, 0x0780010)
OTTER_GTE_COMMAND(dpct, 0x0f8002a)
OTTER_GTE_COMMAND(intpl, 0x0980011)
OTTER_GTE_COMMAND(sqr12, 0x0a80428)
OTTER_GTE_COMMAND(sqr0, 0x0a00428)
OTTER_GTE_COMMAND(ncs, 0x0c8041e)
OTTER_GTE_COMMAND(nct, 0x0d80420)
OTTER_GTE_COMMAND(ncds, 0x0e80413)
OTTER_GTE_COMMAND(ncdt, 0x0f80416)
OTTER_GTE_COMMAND(nccs, 0x108041b)
OTTER_GTE_COMMAND(ncct, 0x118043f)
OTTER_GTE_COMMAND(cdp, 0x1280414)
OTTER_GTE_COMMAND(cc, 0x138041c)
OTTER_GTE_COMMAND(op12, 0x178000c)
OTTER_GTE_COMMAND(op0, 0x170000c)
OTTER_GTE_COMMAND(gpf12, 0x198003d)
OTTER_GTE_COMMAND(gpf0, 0x190003d)
OTTER_GTE_COMMAND(gpl12, 0x1a8003e)
OTTER_GTE_COMMAND(gpl0, 0x1a0003e)

static inline void gte_mvmva_core(uint32_t command) { otter_gte_do(command); }
static inline void gte_mvmva_core_b(uint32_t command) { otter_gte_do(command); }
#define gte_mvmva(sf, mx, v, cv, lm) otter_gte_do(OTTER_GTE_MVMVA(sf, mx, v, cv, lm))
#define gte_mvmva_b(sf, mx, v, cv, lm) otter_gte_do(OTTER_GTE_MVMVA(sf, mx, v, cv, lm))
