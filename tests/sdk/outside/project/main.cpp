// One rectangle in an ordering table, the colour from a file.
#include <psxapi.h>
#include <psxetc.h>
#include <psxgpu.h>
#include <sys/types.h>

extern "C" {
extern const unsigned char colour[];
void make_tile(TILE* tile, const unsigned char* rgb);
}

namespace {
u_long table[8];
TILE* tile = new TILE;
}  // namespace

int main() {
  DISPENV disp;
  DRAWENV draw;
  ResetGraph(0);
  SetDefDispEnv(&disp, 0, 0, 320, 240);
  SetDefDrawEnv(&draw, 0, 0, 320, 240);
  draw.isbg = 1;
  SetDispMask(1);
  for (;;) {
    DrawSync(0);
    ClearOTagR(table, 8);
    make_tile(tile, colour);
    addPrim(&table[3], tile);
    VSync(0);
    PutDispEnv(&disp);
    PutDrawEnv(&draw);
    DrawOTag(&table[7]);
  }
}
