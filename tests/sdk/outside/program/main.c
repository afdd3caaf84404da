/* Clears the screen in a colour that comes from a file: the drawing environment and INCBIN are all it takes. */
#include <psxapi.h>
#include <psxetc.h>
#include <psxgpu.h>

extern const unsigned char words[], words_end[];
extern const int words_size;

int main(void) {
  DISPENV disp;
  DRAWENV draw;
  ResetGraph(0);
  SetDefDispEnv(&disp, 0, 0, 320, 240);
  SetDefDrawEnv(&draw, 0, 0, 320, 240);
  setRGB0(&draw, words[0], words_end - words, words_size);
  draw.isbg = 1;
  PutDispEnv(&disp);
  SetDispMask(1);
  for (;;) {
    PutDrawEnv(&draw);
    DrawSync(0);
    VSync(0);
  }
}
