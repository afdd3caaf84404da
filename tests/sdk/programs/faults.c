// Draws a frame, then writes through a wild pointer.
#include <psxgpu.h>

int main(void) {
  DISPENV display;
  ResetGraph(0);
  SetDefDispEnv(&display, 0, 0, 320, 240);
  PutDispEnv(&display);
  VSync(0);
  volatile int* nowhere = (volatile int*)0x123450000000;
  *nowhere = 1;
}
