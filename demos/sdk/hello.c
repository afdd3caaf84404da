// The smallest program: two buffers, a clear colour, a line of text that is printed anew in every frame.

#include <psxgpu.h>

typedef struct {
  DISPENV display;
  DRAWENV draw;
} Buffer;

static Buffer buffers[2];

static void set_up(void) {
  ResetGraph(0);
  for (int i = 0; i < 2; ++i) {
    SetDefDispEnv(&buffers[i].display, 0, 240 * i, 320, 240);
    SetDefDrawEnv(&buffers[i].draw, 0, 240 * (1 - i), 320, 240);
    setRGB0(&buffers[i].draw, 40, 60, 120);
    buffers[i].draw.isbg = 1;
  }
  FntLoad(960, 0);
  FntOpen(16, 24, 288, 192, 0, 256);
}

int main(void) {
  set_up();
  for (int frame = 0;; ++frame) {
    FntPrint(-1, "HELLO FROM OTTER\n\nFRAME %d", frame);
    FntFlush(-1);
    DrawSync(0);
    VSync(0);
    PutDispEnv(&buffers[frame & 1].display);
    PutDrawEnv(&buffers[frame & 1].draw);
    SetDispMask(1);
  }
}
