#pragma once
// Packets, environments and the functions that draw. A packet is the words of its GP0 command behind a tag;
// tags hold 24-bit addresses, so whatever is linked must lie in static storage, on the program's stack or in
// its heap.   [psx-spx, GPU Commands]

#include <stddef.h>
#include <stdint.h>

#include "otter_hooks.h"

typedef enum {
  DISP_WIDTH_256 = 0,
  DISP_WIDTH_320 = 1,
  DISP_WIDTH_512 = 2,
  DISP_WIDTH_640 = 3,
  DISP_HEIGHT_HIGH = 1 << 2,
  DISP_MODE_PAL = 1 << 3,
  DISP_24BIT_COLOR = 1 << 4,
  DISP_INTERLACE = 1 << 5,
  DISP_WIDTH_384 = 1 << 6
} GPU_DispFlags;

typedef enum { MODE_NTSC = 0, MODE_PAL = 1 } GPU_VideoMode;
typedef enum { DRAWOP_TYPE_DMA = 1, DRAWOP_TYPE_GPU_IRQ = 2 } GPU_DrawOpType;

// ---- packets: NAME with its tag, NAME_T without. One line of fields is one word.

#define OTTER_PACKET(name, ...) \
  typedef struct {              \
    __VA_ARGS__                 \
  } name##_T;                   \
  typedef struct {              \
    uint32_t tag;               \
    __VA_ARGS__                 \
  } name;
// clang-format off
#define OTTER_COLOUR(n, last) uint8_t r##n, g##n, b##n, last;
#define OTTER_XY(n) int16_t x##n, y##n;
#define OTTER_UV(n, last) uint8_t u##n, v##n; uint16_t last;

OTTER_PACKET(POLY_F3, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_XY(1) OTTER_XY(2))
OTTER_PACKET(POLY_F4, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_XY(1) OTTER_XY(2) OTTER_XY(3))
OTTER_PACKET(POLY_FT3, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut)
                       OTTER_XY(1) OTTER_UV(1, tpage)
                       OTTER_XY(2) OTTER_UV(2, pad))
OTTER_PACKET(POLY_FT4, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut)
                       OTTER_XY(1) OTTER_UV(1, tpage)
                       OTTER_XY(2) OTTER_UV(2, pad0)
                       OTTER_XY(3) OTTER_UV(3, pad1))
OTTER_PACKET(POLY_G3, OTTER_COLOUR(0, code) OTTER_XY(0)
                      OTTER_COLOUR(1, pad0) OTTER_XY(1)
                      OTTER_COLOUR(2, pad1) OTTER_XY(2))
OTTER_PACKET(POLY_G4, OTTER_COLOUR(0, code) OTTER_XY(0)
                      OTTER_COLOUR(1, pad0) OTTER_XY(1)
                      OTTER_COLOUR(2, pad1) OTTER_XY(2)
                      OTTER_COLOUR(3, pad2) OTTER_XY(3))
OTTER_PACKET(POLY_GT3, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut)
                       OTTER_COLOUR(1, pad0) OTTER_XY(1) OTTER_UV(1, tpage)
                       OTTER_COLOUR(2, pad1) OTTER_XY(2) OTTER_UV(2, pad2))
OTTER_PACKET(POLY_GT4, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut)
                       OTTER_COLOUR(1, pad0) OTTER_XY(1) OTTER_UV(1, tpage)
                       OTTER_COLOUR(2, pad1) OTTER_XY(2) OTTER_UV(2, pad2)
                       OTTER_COLOUR(3, pad3) OTTER_XY(3) OTTER_UV(3, pad4))

OTTER_PACKET(LINE_F2, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_XY(1))
OTTER_PACKET(LINE_F3, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_XY(1) OTTER_XY(2) uint32_t pad;)
OTTER_PACKET(LINE_F4, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_XY(1) OTTER_XY(2) OTTER_XY(3) uint32_t pad;)
OTTER_PACKET(LINE_G2, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_COLOUR(1, p1) OTTER_XY(1))
OTTER_PACKET(LINE_G3, OTTER_COLOUR(0, code) OTTER_XY(0)
                      OTTER_COLOUR(1, p1) OTTER_XY(1)
                      OTTER_COLOUR(2, p2) OTTER_XY(2) uint32_t pad;)
OTTER_PACKET(LINE_G4, OTTER_COLOUR(0, code) OTTER_XY(0)
                      OTTER_COLOUR(1, p1) OTTER_XY(1)
                      OTTER_COLOUR(2, p2) OTTER_XY(2)
                      OTTER_COLOUR(3, p3) OTTER_XY(3) uint32_t pad;)

OTTER_PACKET(TILE, OTTER_COLOUR(0, code) OTTER_XY(0) int16_t w, h;)
OTTER_PACKET(TILE_1, OTTER_COLOUR(0, code) OTTER_XY(0))
OTTER_PACKET(SPRT, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut) uint16_t w, h;)
OTTER_PACKET(SPRT_1, OTTER_COLOUR(0, code) OTTER_XY(0) OTTER_UV(0, clut))
typedef TILE_1_T TILE_8_T, TILE_16_T;
typedef TILE_1 TILE_8, TILE_16;
typedef SPRT_1_T SPRT_8_T, SPRT_16_T;
typedef SPRT_1 SPRT_8, SPRT_16;

OTTER_PACKET(FILL, OTTER_COLOUR(0, code) uint16_t x0, y0; uint16_t w, h;)
OTTER_PACKET(DR_MOVE, uint8_t p0, p1, p2, code; uint16_t x0, y0; uint16_t x1, y1; uint16_t w, h;)
OTTER_PACKET(DR_AREA, uint32_t code[2];)
OTTER_PACKET(DR_OFFSET, uint32_t code[1];)
OTTER_PACKET(DR_TWIN, uint32_t code[1];)
OTTER_PACKET(DR_TPAGE, uint32_t code[1];)
OTTER_PACKET(DR_STP, uint32_t code[1];)
OTTER_PACKET(DR_IRQ, uint32_t code[1];)
OTTER_PACKET(DR_ENV, DR_TPAGE_T tpage; DR_TWIN_T twin; DR_AREA_T area; DR_OFFSET_T offset; FILL_T fill;)
// clang-format on

// Views of any packet's first words.
typedef struct __attribute__((may_alias)) {
  uint32_t addr : 24, len : 8;
  uint32_t color : 24, code : 8;
} P_TAG;
typedef struct __attribute__((may_alias)) {
  uint32_t color : 24, code : 8;
} P_TAG_T;
typedef struct __attribute__((may_alias)) {
  uint32_t color : 24, pad : 8;
} P_COLOR;

typedef struct {
  int16_t x, y, w, h;
} RECT;
typedef struct {
  RECT disp;    ///< the rectangle of VRAM that is shown
  RECT screen;  ///< where on the television, relative to the usual place; 0 x 0: all of it
  uint8_t isinter, isrgb24, reverse;
  uint8_t _reserved;
} DISPENV;
typedef struct {
  RECT clip;
  int16_t ofs[2];  ///< drawing offset, relative to clip
  RECT tw;         ///< texture window
  uint16_t tpage;
  uint8_t dtd, dfe, isbg;  ///< dither; draw to the displayed area; fill clip with r0, g0, b0 first
  uint8_t r0, g0, b0;
  DR_ENV dr_env;  ///< the packet made of the above
} DRAWENV;
typedef struct {
  uint32_t mode;
  RECT* crect;
  uint32_t* caddr;
  RECT* prect;
  uint32_t* paddr;
} TIM_IMAGE;
typedef struct {
  uint32_t pmode;
  int16_t px, py, pw, ph;
  uint32_t* pixel;
  int16_t cx, cy, cw, ch;
  uint32_t* clut;
} GsIMAGE;

// ---- tags and links

#define setlen(p, n) (((P_TAG*)(p))->len = (uint8_t)(n))
#define setaddr(p, a) (((P_TAG*)(p))->addr = (uint32_t)(uintptr_t)(a)&0xffffff)
#define setcode(p, c) (((P_TAG*)(p))->code = (uint8_t)(c))
#define setcode_T(p, c) (((P_TAG_T*)(p))->code = (uint8_t)(c))
#define getlen(p) (((P_TAG*)(p))->len)
#define getaddr(p) (((P_TAG*)(p))->addr)
#define getcode(p) (((P_TAG*)(p))->code)
#define getcode_T(p) (((P_TAG_T*)(p))->code)
#define nextPrim(p) ((void*)(uintptr_t)getaddr(p))
#define isendprim(p) (getaddr(p) == 0xffffff)
#define termPrim(p) setaddr(p, 0xffffff)
#define catPrim(a, b) setaddr(a, b)
#define addPrim(ot, p) otter_link((void*)(ot), (void*)(p), (void*)(p))
#define addPrims(ot, first, last) otter_link((void*)(ot), (void*)(first), (void*)(last))

#define setSemiTrans(p, on) (getcode(p) = (uint8_t)((on) ? getcode(p) | 2 : getcode(p) & 0xfd))
#define setSemiTrans_T(p, on) ((on) ? (getcode_T(p) |= 2) : (getcode_T(p) &= 0xfd))
#define setShadeTex(p, raw) (getcode(p) = (uint8_t)((raw) ? getcode(p) | 1 : getcode(p) & 0xfe))
#define setShadeTex_T(p, raw) ((raw) ? (getcode_T(p) |= 1) : (getcode_T(p) &= 0xfe))

// ---- fields

#define setVector(v, X, Y, Z) ((v)->vx = (X), (v)->vy = (Y), (v)->vz = (Z))
#define setRECT(q, X, Y, W, H) ((q)->x = (X), (q)->y = (Y), (q)->w = (W), (q)->h = (H))
#define setWH(p, W, H) ((p)->w = (W), (p)->h = (H))

#define setColor0(p, c) (((P_COLOR*)&(p)->r0)->color = (c))
#define setColor1(p, c) (((P_COLOR*)&(p)->r1)->color = (c))
#define setColor2(p, c) (((P_COLOR*)&(p)->r2)->color = (c))
#define setColor3(p, c) (((P_COLOR*)&(p)->r3)->color = (c))
#define setRGB0(p, r, g, b) ((p)->r0 = (r), (p)->g0 = (g), (p)->b0 = (b))
#define setRGB1(p, r, g, b) ((p)->r1 = (r), (p)->g1 = (g), (p)->b1 = (b))
#define setRGB2(p, r, g, b) ((p)->r2 = (r), (p)->g2 = (g), (p)->b2 = (b))
#define setRGB3(p, r, g, b) ((p)->r3 = (r), (p)->g3 = (g), (p)->b3 = (b))

#define OTTER_SET_XY(p, n, X, Y) ((p)->x##n = (X), (p)->y##n = (Y))
#define setXY0(p, xa, ya) OTTER_SET_XY(p, 0, xa, ya)
#define setXY2(p, xa, ya, xb, yb) (setXY0(p, xa, ya), OTTER_SET_XY(p, 1, xb, yb))
#define setXY3(p, xa, ya, xb, yb, xc, yc) (setXY2(p, xa, ya, xb, yb), OTTER_SET_XY(p, 2, xc, yc))
#define setXY4(p, xa, ya, xb, yb, xc, yc, xd, yd) \
  (setXY3(p, xa, ya, xb, yb, xc, yc), OTTER_SET_XY(p, 3, xd, yd))
#define setXYWH(p, X, Y, W, H) setXY4(p, X, Y, (X) + (W), Y, X, (Y) + (H), (X) + (W), (Y) + (H))

#define OTTER_SET_UV(p, n, U, V) ((p)->u##n = (U), (p)->v##n = (V))
#define setUV0(p, ua, va) OTTER_SET_UV(p, 0, ua, va)
#define setUV3(p, ua, va, ub, vb, uc, vc) \
  (setUV0(p, ua, va), OTTER_SET_UV(p, 1, ub, vb), OTTER_SET_UV(p, 2, uc, vc))
#define setUV4(p, ua, va, ub, vb, uc, vc, ud, vd) \
  (setUV3(p, ua, va, ub, vb, uc, vc), OTTER_SET_UV(p, 3, ud, vd))
#define setUVWH(p, U, V, W, H) setUV4(p, U, V, (U) + (W), V, U, (V) + (H), (U) + (W), (V) + (H))

#define getTPage(depth, blend, x, y) \
  ((((x)&0x3c0) >> 6) | (((y)&0x100) >> 4) | (((y)&0x200) << 2) | (((blend)&3) << 5) | (((depth)&3) << 7))
#define getClut(x, y) (((y) << 6) | (((x) >> 4) & 0x3f))
#define setTPage(p, depth, blend, x, y) ((p)->tpage = getTPage(depth, blend, x, y))
#define setClut(p, x, y) ((p)->clut = getClut(x, y))

// ---- the head of each packet: payload words and GP0 code

#define OTTER_HEAD(p, words, code) (setlen(p, words), setcode(p, code))
#define setPolyF3(p) OTTER_HEAD(p, 4, 0x20)
#define setPolyFT3(p) OTTER_HEAD(p, 7, 0x24)
#define setPolyF4(p) OTTER_HEAD(p, 5, 0x28)
#define setPolyFT4(p) OTTER_HEAD(p, 9, 0x2c)
#define setPolyG3(p) OTTER_HEAD(p, 6, 0x30)
#define setPolyGT3(p) OTTER_HEAD(p, 9, 0x34)
#define setPolyG4(p) OTTER_HEAD(p, 8, 0x38)
#define setPolyGT4(p) OTTER_HEAD(p, 12, 0x3c)
#define setLineF2(p) OTTER_HEAD(p, 3, 0x40)
#define setLineG2(p) OTTER_HEAD(p, 4, 0x50)
#define setTile(p) OTTER_HEAD(p, 3, 0x60)
#define setSprt(p) OTTER_HEAD(p, 4, 0x64)
#define setTile1(p) OTTER_HEAD(p, 2, 0x68)
#define setTile8(p) OTTER_HEAD(p, 2, 0x70)
#define setSprt8(p) OTTER_HEAD(p, 3, 0x74)
#define setTile16(p) OTTER_HEAD(p, 2, 0x78)
#define setSprt16(p) OTTER_HEAD(p, 3, 0x7c)
#define setFill(p) OTTER_HEAD(p, 3, 0x02)
// Lines of three and four points end with a word that no vertex can be.
#define OTTER_LINE_END(p) ((p)->pad = 0x55555555)
#define setLineF3(p) (setlen(p, 5), setcode(p, 0x48), OTTER_LINE_END(p))
#define setLineF4(p) (setlen(p, 6), setcode(p, 0x4c), OTTER_LINE_END(p))
#define setLineG3(p) (setlen(p, 7), setcode(p, 0x58), (p)->p1 = 0, (p)->p2 = 0, OTTER_LINE_END(p))
#define setLineG4(p) \
  (setlen(p, 9), setcode(p, 0x5c), (p)->p1 = 0, (p)->p2 = 0, (p)->p3 = 0, OTTER_LINE_END(p))

#define setPolyF3_T(p) setcode_T(p, 0x20)
#define setPolyFT3_T(p) setcode_T(p, 0x24)
#define setPolyF4_T(p) setcode_T(p, 0x28)
#define setPolyFT4_T(p) setcode_T(p, 0x2c)
#define setPolyG3_T(p) setcode_T(p, 0x30)
#define setPolyGT3_T(p) setcode_T(p, 0x34)
#define setPolyG4_T(p) setcode_T(p, 0x38)
#define setPolyGT4_T(p) setcode_T(p, 0x3c)
#define setLineF2_T(p) setcode_T(p, 0x40)
#define setLineG2_T(p) setcode_T(p, 0x50)
#define setTile_T(p) setcode_T(p, 0x60)
#define setSprt_T(p) setcode_T(p, 0x64)
#define setTile1_T(p) setcode_T(p, 0x68)
#define setTile8_T(p) setcode_T(p, 0x70)
#define setSprt8_T(p) setcode_T(p, 0x74)
#define setTile16_T(p) setcode_T(p, 0x78)
#define setSprt16_T(p) setcode_T(p, 0x7c)
#define setFill_T(p) setcode_T(p, 0x02)
#define setLineF3_T(p) (setcode_T(p, 0x48), OTTER_LINE_END(p))
#define setLineF4_T(p) (setcode_T(p, 0x4c), OTTER_LINE_END(p))
#define setLineG3_T(p) (setcode_T(p, 0x58), (p)->p1 = 0, (p)->p2 = 0, OTTER_LINE_END(p))
#define setLineG4_T(p) (setcode_T(p, 0x5c), (p)->p1 = 0, (p)->p2 = 0, (p)->p3 = 0, OTTER_LINE_END(p))

// VRAM to VRAM; p0..p2 are the low bytes of the command word.
#define setBlit_T(p) (setcode_T(p, 0x80), (p)->p0 = 0, (p)->p1 = 0, (p)->p2 = 0)
#define setBlit(p) (setlen(p, 4), setcode(p, 0x80), (p)->p0 = 0, (p)->p1 = 0, (p)->p2 = 0)

// ---- draw state, one word each

#define OTTER_STATE(p, word) ((p)->code[0] = (uint32_t)(word))
#define setDrawTPage_T(p, dfe, dtd, page) \
  OTTER_STATE(p, 0xe1000000u | (page) | ((dtd)&1) << 9 | ((dfe)&1) << 10)
#define setTexWindow_T(p, q) \
  OTTER_STATE(p, 0xe2000000u | ((q)->w & 31) | ((q)->h & 31) << 5 | ((q)->x & 31) << 10 | ((q)->y & 31) << 15)
#define setDrawAreaXY_T(p, xa, ya, xb, yb)                          \
  (OTTER_STATE(p, 0xe3000000u | ((xa)&0x3ff) | ((ya)&0x3ff) << 10), \
   (p)->code[1] = 0xe4000000u | ((xb)&0x3ff) | ((yb)&0x3ff) << 10)
#define setDrawArea_T(p, q) setDrawAreaXY_T(p, (q)->x, (q)->y, (q)->x + (q)->w - 1, (q)->y + (q)->h - 1)
#define setDrawOffset_T(p, x, y) OTTER_STATE(p, 0xe5000000u | ((x)&0x7ff) | ((y)&0x7ff) << 11)
#define setDrawStp_T(p, set, test) OTTER_STATE(p, 0xe6000000u | (set) | (test) << 1)
#define setDrawIRQ_T(p) OTTER_STATE(p, 0x1f000000u)

#define setDrawTPage(p, dfe, dtd, page) (setlen(p, 1), setDrawTPage_T(p, dfe, dtd, page))
#define setTexWindow(p, q) (setlen(p, 1), setTexWindow_T(p, q))
#define setDrawAreaXY(p, xa, ya, xb, yb) (setlen(p, 2), setDrawAreaXY_T(p, xa, ya, xb, yb))
#define setDrawArea(p, q) (setlen(p, 2), setDrawArea_T(p, q))
#define setDrawOffset(p, x, y) (setlen(p, 1), setDrawOffset_T(p, x, y))
#define setDrawStp(p, set, test) (setlen(p, 1), setDrawStp_T(p, set, test))
#define setDrawIRQ(p) (setlen(p, 1), setDrawIRQ_T(p))

// ---- functions

#ifdef __cplusplus
extern "C" {
#endif

/// 0: GPU and environment as after power-on; 1 and 3: what is queued is dropped (nothing is: every call draws
/// at once).
void ResetGraph(int mode);
GPU_VideoMode GetVideoMode(void);
void SetVideoMode(GPU_VideoMode mode);
void SetDispMask(int mask);  ///< 0: the screen is black
void PutDispEnv(const DISPENV* env);
void PutDrawEnv(DRAWENV* env);
void PutDrawEnvFast(DRAWENV* env);  ///< sends the packet that env holds, without making it anew
int GetODE(void);                   ///< the field shown, for interlaced modes
int IsIdleGPU(int timeout);         ///< 0: idle

/// 0: waits for the next vertical blank; n > 1: for n of them; -1: the number of blanks so far; 1: lines
/// since the last (0: time stands still between blanks).
int VSync(int mode);
void* VSyncHaltFunction(void (*func)(void));
void* VSyncCallback(void (*func)(void));
void SetDrawOpType(GPU_DrawOpType type);
int EnqueueDrawOp(void (*func)(), uint32_t arg1, uint32_t arg2, uint32_t arg3);
int DrawSync(int mode);  ///< 0: everything is drawn, always
void* DrawSyncCallback(void (*func)(void));

int LoadImage(const RECT* rect, const uint32_t* data);
int StoreImage(const RECT* rect, uint32_t* data);
int MoveImage(const RECT* rect, int x, int y);
void LoadImage2(const RECT* rect, const uint32_t* data);
void StoreImage2(const RECT* rect, uint32_t* data);
void MoveImage2(const RECT* rect, int x, int y);

void ClearOTagR(uint32_t* ot, size_t length);  ///< entry n links to n - 1; the list begins at the last
void ClearOTag(uint32_t* ot, size_t length);   ///< entry n links to n + 1
int DrawOTag(const uint32_t* ot);
int DrawOTagIRQ(const uint32_t* ot);
int DrawOTagEnv(const uint32_t* ot, DRAWENV* env);
int DrawOTagEnvIRQ(const uint32_t* ot, DRAWENV* env);
void DrawOTag2(const uint32_t* ot);
void DrawOTagIRQ2(const uint32_t* ot);
int DrawBuffer(const uint32_t* buf, size_t length);
int DrawBufferIRQ(const uint32_t* buf, size_t length);
void DrawBuffer2(const uint32_t* buf, size_t length);
void DrawBufferIRQ2(const uint32_t* buf, size_t length);
void DrawPrim(const void* pri);
void AddPrim(uint32_t* ot, const void* pri);

/// Where the parts of a TIM lie, as pointers into it. Not 0: no TIM.
int GetTimInfo(const uint32_t* tim, TIM_IMAGE* info);
int GsGetTimInfo(const uint32_t* tim, GsIMAGE* info);
DISPENV* SetDefDispEnv(DISPENV* env, int x, int y, int w, int h);
DRAWENV* SetDefDrawEnv(DRAWENV* env, int x, int y, int w, int h);

/// The debug font: 32 x 32 words of VRAM at x, y and its CLUT below.
void FntLoad(int x, int y);
void* FntSort(uint32_t* ot, void* pri, int x, int y, const char* text);
int FntOpen(int x, int y, int w, int h, int isbg, int n);
int FntPrint(int id, const char* fmt, ...);
void* FntFlush(int id);

#ifdef __cplusplus
}
#endif
