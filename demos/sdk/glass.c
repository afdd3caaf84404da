// Semi-transparency depends on order: three panes of glass pass one another before a wall, and each frame puts them
// into the table by their own depth, far to near, so that the nearest is blended last.

#include <inline_c.h>
#include <psxgpu.h>
#include <psxgte.h>

enum { buckets = 512, packet_bytes = 4096, width = 320, height = 240, panes = 3 };

typedef struct {
  DISPENV display;
  DRAWENV draw;
  uint32_t table[buckets];
  uint8_t packets[packet_bytes];
} Buffer;

static Buffer buffers[2];

static const uint8_t colours[panes][3] = {{180, 40, 40}, {40, 180, 40}, {40, 40, 180}};

static void set_up(void) {
  ResetGraph(0);
  for (int i = 0; i < 2; ++i) {
    SetDefDispEnv(&buffers[i].display, 0, height * i, width, height);
    SetDefDrawEnv(&buffers[i].draw, 0, height * (1 - i), width, height);
    setRGB0(&buffers[i].draw, 20, 20, 20);
    buffers[i].draw.isbg = 1;
  }
  InitGeom();
  gte_SetGeomOffset(width / 2, height / 2);
  gte_SetGeomScreen(width / 2);
}

/// A square around (x, y, z) that faces the eye.
static uint8_t* draw_square(Buffer* buffer, uint8_t* next, int x, int y, int z, int half, const uint8_t* colour,
                            int is_glass) {
  SVECTOR v[4];
  for (int i = 0; i < 4; ++i) {
    setVector(&v[i], (int16_t)(x + (i & 1 ? half : -half)), (int16_t)(y + (i & 2 ? half : -half)), (int16_t)z);
  }
  POLY_F4* quad = (POLY_F4*)next;
  setPolyF4(quad);
  setRGB0(quad, colour[0], colour[1], colour[2]);
  setSemiTrans(quad, is_glass);
  gte_ldv3c(v);
  gte_rtpt();
  gte_stsxy3_f4(quad);
  gte_ldv0(&v[3]);
  gte_rtps();
  gte_stsxy(&quad->x3);
  int bucket;
  gte_avsz4();
  gte_stotz(&bucket);
  if (bucket <= 0 || bucket >= buckets) return next;
  addPrim(&buffer->table[bucket], quad);
  return next + sizeof(POLY_F4);
}

int main(void) {
  set_up();
  static const uint8_t wall[3] = {150, 150, 120};
  for (int frame = 0;; ++frame) {
    Buffer* buffer = &buffers[frame & 1];
    MATRIX still = {{{ONE, 0, 0}, {0, ONE, 0}, {0, 0, ONE}}, {0, 0, 0}};
    gte_SetRotMatrix(&still);
    gte_SetTransMatrix(&still);
    ClearOTagR(buffer->table, buckets);
    uint8_t* next = draw_square(buffer, buffer->packets, 0, 0, 1600, 500, wall, 0);
    for (int i = 0; i < panes; ++i) {
      const int turn = frame * 16 + i * ONE / panes;
      next = draw_square(buffer, next, 250 * icos(turn) / ONE, 60 * (i - 1), 1000 + 350 * isin(turn) / ONE, 180,
                         colours[i], 1);
    }
    DrawSync(0);
    VSync(0);
    PutDispEnv(&buffer->display);
    PutDrawEnv(&buffer->draw);
    SetDispMask(1);
    DrawOTag(&buffer->table[buckets - 1]);
  }
}
