#pragma once
// Packets and drawing under the older SDK's names: what psxgpu.h has, functions where that has macros, and
// the reader of TIM files. Not here: the reader of TMD files.

#include <sys/types.h>

#include "libgte.h"
#define FntPrint otter_print_to_stream
#include "psxgpu.h"
#undef FntPrint

typedef struct {
  uint32_t tag;
  uint32_t code[2];
} DR_MODE;
typedef struct {
  uint32_t tag;
  uint32_t code[5];
} DR_PRIO;
typedef struct {
  SVECTOR *v, *n, *u;
  CVECTOR* c;
  uint32_t len;
} TMESH;
#ifdef __cplusplus
extern "C" {
#endif

int OpenTIM(u_long* address);
TIM_IMAGE* ReadTIM(TIM_IMAGE* image);  ///< null: no further TIM
int ClearImage(RECT* rect, u_char r, u_char g, u_char b);
u_short LoadTPage(u_long* pixels, int depth, int blend, int x, int y, int w, int h);
u_short LoadClut(u_long* colours, int x, int y);
void otter_set_window(uint32_t* code, const RECT* window);
void otter_use_stream(int id);  ///< FntPrint without a number means this one
int otter_print(uintptr_t first, ...);

#ifdef __cplusplus
}
/// With or without a stream's number before the format.
template <class... Arguments>
int FntPrint(Arguments... arguments) {
  return otter_print((uintptr_t)arguments...);
}
#else
/// With or without a stream's number before the format.
#define FntPrint(...) ((int (*)())otter_print)(__VA_ARGS__)
#endif

#define setDrawMode(p, dfe, dtd, page, window)                                                            \
  (setlen(p, 2), (p)->code[0] = 0xe1000000u | ((dtd) ? 0x200 : 0) | ((dfe) ? 0x400 : 0) | ((page)&0x9ff), \
   otter_set_window(&(p)->code[1], (const RECT*)(window)))
#define SetDrawMode(p, dfe, dtd, page, window) setDrawMode(p, dfe, dtd, page, window)
#define SetTexWindow(p, window) (setlen(p, 1), otter_set_window(&(p)->code[0], (const RECT*)(window)))
#define SetDrawArea(p, r) setDrawArea(p, r)
#define SetDrawOffset(p, ofs) setDrawOffset(p, (ofs)[0], (ofs)[1])
#define SetDrawMove(p, r, x, y)                                                                   \
  (setBlit(p), (p)->x0 = (r)->x, (p)->y0 = (r)->y, (p)->x1 = (x), (p)->y1 = (y), (p)->w = (r)->w, \
   (p)->h = (r)->h)

#define SetPolyF3(p) setPolyF3(p)
#define SetPolyF4(p) setPolyF4(p)
#define SetPolyG3(p) setPolyG3(p)
#define SetPolyG4(p) setPolyG4(p)
#define SetPolyFT3(p) setPolyFT3(p)
#define SetPolyFT4(p) setPolyFT4(p)
#define SetPolyGT3(p) setPolyGT3(p)
#define SetPolyGT4(p) setPolyGT4(p)
#define SetLineF2(p) setLineF2(p)
#define SetLineF3(p) setLineF3(p)
#define SetLineF4(p) setLineF4(p)
#define SetLineG2(p) setLineG2(p)
#define SetLineG3(p) setLineG3(p)
#define SetLineG4(p) setLineG4(p)
#define SetTile(p) setTile(p)
#define SetTile1(p) setTile1(p)
#define SetTile8(p) setTile8(p)
#define SetTile16(p) setTile16(p)
#define SetSprt(p) setSprt(p)
#define SetSprt8(p) setSprt8(p)
#define SetSprt16(p) setSprt16(p)
#define SetSemiTrans(p, on) setSemiTrans(p, on)
#define SetShadeTex(p, raw) setShadeTex(p, raw)
#define GetTPage(depth, blend, x, y) getTPage(depth, blend, x, y)
#define GetClut(x, y) getClut(x, y)
#define AddPrims(ot, first, last) addPrims(ot, first, last)
#define CatPrim(a, b) catPrim(a, b)
#define TermPrim(p) termPrim(p)
#define NextPrim(p) nextPrim(p)
#define IsEndPrim(p) isendprim(p)
#define SetDumpFnt(id) otter_use_stream(id)
#define FntColor(...) 0
#define SetGraphDebug(level) 0
#define SetGraphQueue(mode) 0
