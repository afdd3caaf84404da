// Calls that cannot be served, one of a kind.
#include <psxgpu.h>

static uint32_t table[4];
static POLY_F3 loop[2];
static POLY_F3 triangle;
static uint32_t pixels[4];

int main(void) {
  const RECT huge = {0, 0, 2000, 1};
  const RECT small = {0, 0, 2, 2};
  ClearOTagR(table, 4);
  setPolyF3(&triangle);
  PutDrawEnv(0);
  LoadImage(&small, 0);
  LoadImage(0, pixels);
  LoadImage(&huge, pixels);
  addPrim((uint32_t*)0x7fff00000000, &triangle);
  setaddr(&loop[0], &loop[1]);
  setaddr(&loop[1], &loop[0]);
  DrawOTag((const uint32_t*)loop);
  VSync(0);
  return 0;
}
