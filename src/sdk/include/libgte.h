#pragma once
// The coprocessor's functions under the older SDK's names. Screen positions are stored as four bytes wherever
// the pointer says `long`, because programs point into packets; depth cue and FLAG are written as whole
// longs.

#include <sys/types.h>

#define OTTER_VECTOR_PAD int32_t pad;
#include "inline_c.h"
#include "psxgte.h"

// The two SDKs mean each other's by these two names.
#define ScaleMatrix(m, s) otter_scale_columns(m, s)
#define ScaleMatrixL(m, s) otter_scale_rows(m, s)

#define SetRotMatrix(m) gte_SetRotMatrix(m)
#define SetTransMatrix(m) gte_SetTransMatrix(m)
#define SetLightMatrix(m) gte_SetLightMatrix(m)
#define SetColorMatrix(m) gte_SetColorMatrix(m)
#define SetBackColor(r, g, b) gte_SetBackColor(r, g, b)
#define SetFarColor(r, g, b) gte_SetFarColor(r, g, b)
#define SetGeomOffset(x, y) gte_SetGeomOffset(x, y)
#define SetGeomScreen(h) gte_SetGeomScreen(h)
#define ReadRotMatrix(m) gte_ReadRotMatrix(m)
#define RotMatrix_gte(r, m) RotMatrix(r, m)

#ifdef __cplusplus
extern "C" {
#endif

MATRIX* otter_scale_columns(MATRIX* m, VECTOR* s);
MATRIX* otter_scale_rows(MATRIX* m, VECTOR* s);

// Turns m by r about one axis: m = R * m.
MATRIX* RotMatrixX(long r, MATRIX* m);
MATRIX* RotMatrixY(long r, MATRIX* m);
MATRIX* RotMatrixZ(long r, MATRIX* m);
MATRIX* RotMatrixYXZ(SVECTOR* r, MATRIX* m);  ///< Y * X * Z
MATRIX* RotMatrixZYX(SVECTOR* r, MATRIX* m);  ///< Z * Y * X
MATRIX* TransposeMatrix(MATRIX* m0, MATRIX* m1);
MATRIX* MulMatrix2(MATRIX* m0, MATRIX* m1);  ///< m1 = m0 * m1
MATRIX* CompMatrix(MATRIX* m0, MATRIX* m1, MATRIX* m2);
VECTOR* ApplyMatrix(MATRIX* m, SVECTOR* v0, VECTOR* v1);
SVECTOR* ApplyMatrixSV(MATRIX* m, SVECTOR* v0, SVECTOR* v1);
VECTOR* ApplyRotMatrix(SVECTOR* v0, VECTOR* v1);  ///< by the matrix in the registers
void VectorNormal(VECTOR* v0, VECTOR* v1);
void VectorNormalSS(SVECTOR* v0, SVECTOR* v1);
int ratan2(int y, int x);  ///< 4096 a turn
void SetFogNearFar(long near, long far, long h);

#ifdef __cplusplus
}
#endif

static inline long otter_depth_cue(void) { return (int32_t)otter_gte_get(8); }
static inline long otter_flag(void) { return (int32_t)otter_gte_get(63); }
static inline long otter_sz_4(void) { return (long)(otter_gte_get(19) >> 2); }
static inline long otter_area(void) { return (int32_t)otter_gte_get(24); }
static inline long otter_otz(void) { return (long)otter_gte_get(7); }

static inline long RotTransPers(SVECTOR* v, void* xy, long* p, long* flag) {
  gte_ldv0(v);
  gte_rtps();
  gte_stsxy(xy);
  *p = otter_depth_cue();
  *flag = otter_flag();
  return otter_sz_4();
}
static inline long RotTransPers3(SVECTOR* a, SVECTOR* b, SVECTOR* c, void* xya, void* xyb, void* xyc, long* p,
                                 long* flag) {
  gte_ldv3(a, b, c);
  gte_rtpt();
  gte_stsxy3(xya, xyb, xyc);
  *p = otter_depth_cue();
  *flag = otter_flag();
  return otter_sz_4();
}
static inline long RotTransPers4(SVECTOR* a, SVECTOR* b, SVECTOR* c, SVECTOR* d, void* xya, void* xyb,
                                 void* xyc, void* xyd, long* p, long* flag) {
  long first;
  RotTransPers3(a, b, c, xya, xyb, xyc, p, &first);
  const long z = RotTransPers(d, xyd, p, flag);
  *flag |= first;
  return z;
}
static inline long RotAverage3(SVECTOR* a, SVECTOR* b, SVECTOR* c, void* xya, void* xyb, void* xyc, long* p,
                               long* flag) {
  RotTransPers3(a, b, c, xya, xyb, xyc, p, flag);
  gte_avsz3();
  return otter_otz();
}
static inline long RotAverage4(SVECTOR* a, SVECTOR* b, SVECTOR* c, SVECTOR* d, void* xya, void* xyb,
                               void* xyc, void* xyd, long* p, long* flag) {
  RotTransPers4(a, b, c, d, xya, xyb, xyc, xyd, p, flag);
  gte_avsz4();
  return otter_otz();
}
/// Twice the area on the screen, not above 0 for a face turned away, whose positions are then not stored.
static inline long RotAverageNclip3(SVECTOR* a, SVECTOR* b, SVECTOR* c, void* xya, void* xyb, void* xyc,
                                    long* p, long* otz, long* flag) {
  gte_ldv3(a, b, c);
  gte_rtpt();
  *flag = otter_flag();
  gte_nclip();
  const long area = otter_area();
  if (area <= 0) return area;
  gte_stsxy3(xya, xyb, xyc);
  *p = otter_depth_cue();
  gte_avsz3();
  *otz = otter_otz();
  return area;
}
static inline long RotAverageNclip4(SVECTOR* a, SVECTOR* b, SVECTOR* c, SVECTOR* d, void* xya, void* xyb,
                                    void* xyc, void* xyd, long* p, long* otz, long* flag) {
  long last;
  const long area = RotAverageNclip3(a, b, c, xya, xyb, xyc, p, otz, flag);
  if (area <= 0) return area;
  RotTransPers(d, xyd, p, &last);
  *flag |= last;
  gte_avsz4();
  *otz = otter_otz();
  return area;
}
static inline long NormalClip(long a, long b, long c) {
  gte_ldsxy3((uint32_t)a, (uint32_t)b, (uint32_t)c);
  gte_nclip();
  return otter_area();
}
static inline long AverageZ3(long a, long b, long c) {
  gte_ldsz3((uint32_t)a, (uint32_t)b, (uint32_t)c);
  gte_avsz3();
  return otter_otz();
}
static inline long AverageZ4(long a, long b, long c, long d) {
  gte_ldsz4((uint32_t)a, (uint32_t)b, (uint32_t)c, (uint32_t)d);
  gte_avsz4();
  return otter_otz();
}
static inline void RotTrans(SVECTOR* v, VECTOR* out, long* flag) {
  gte_ldv0(v);
  gte_rt();
  gte_stlvnl(out);
  *flag = otter_flag();
}

// Light: a normal, a colour if the name says so, and the colour that comes of them.
static inline void NormalColor(SVECTOR* n, CVECTOR* out) {
  gte_ldv0(n);
  gte_ncs();
  gte_strgb(out);
}
static inline void NormalColor3(SVECTOR* a, SVECTOR* b, SVECTOR* c, CVECTOR* outa, CVECTOR* outb,
                                CVECTOR* outc) {
  gte_ldv3(a, b, c);
  gte_nct();
  gte_strgb3(outa, outb, outc);
}
static inline void NormalColorCol(SVECTOR* n, CVECTOR* in, CVECTOR* out) {
  gte_ldv0(n);
  gte_ldrgb(in);
  gte_nccs();
  gte_strgb(out);
}
static inline void NormalColorCol3(SVECTOR* a, SVECTOR* b, SVECTOR* c, CVECTOR* in, CVECTOR* outa,
                                   CVECTOR* outb, CVECTOR* outc) {
  gte_ldv3(a, b, c);
  gte_ldrgb(in);
  gte_ncct();
  gte_strgb3(outa, outb, outc);
}
static inline void NormalColorDpq(SVECTOR* n, CVECTOR* in, long p, CVECTOR* out) {
  gte_ldv0(n);
  gte_ldrgb(in);
  gte_lddp((uint32_t)p);
  gte_ncds();
  gte_strgb(out);
}
static inline void NormalColorDpq3(SVECTOR* a, SVECTOR* b, SVECTOR* c, CVECTOR* in, long p, CVECTOR* outa,
                                   CVECTOR* outb, CVECTOR* outc) {
  gte_ldv3(a, b, c);
  gte_ldrgb(in);
  gte_lddp((uint32_t)p);
  gte_ncdt();
  gte_strgb3(outa, outb, outc);
}
static inline void DpqColor(CVECTOR* in, long p, CVECTOR* out) {
  gte_ldrgb(in);
  gte_lddp((uint32_t)p);
  gte_dpcs();
  gte_strgb(out);
}
static inline void DpqColor3(CVECTOR* a, CVECTOR* b, CVECTOR* c, long p, CVECTOR* outa, CVECTOR* outb,
                             CVECTOR* outc) {
  gte_ldrgb3(a, b, c);
  gte_lddp((uint32_t)p);
  gte_dpct();
  gte_strgb3(outa, outb, outc);
}
