#pragma once
// Controllers, blanks and callbacks under the older SDK's names.

#include <sys/types.h>

#include "psxetc.h"
#include "psxgpu.h"

#ifdef __cplusplus
extern "C" {
#endif

void PadInit(int mode);
u_long PadRead(int id);  ///< a bit is 1 while held: the second controller in bits 16-31

#ifdef __cplusplus
}
#endif

#define PADLup (1 << 12)
#define PADLright (1 << 13)
#define PADLdown (1 << 14)
#define PADLleft (1 << 15)
#define PADRup (1 << 4)
#define PADRright (1 << 5)
#define PADRdown (1 << 6)
#define PADRleft (1 << 7)
#define PADL2 (1 << 0)
#define PADR2 (1 << 1)
#define PADL1 (1 << 2)
#define PADR1 (1 << 3)
#define PADselect (1 << 8)
#define PADi (1 << 9)
#define PADj (1 << 10)
#define PADstart (1 << 11)
#define _PAD(x, y) ((y) << ((x) << 4))
