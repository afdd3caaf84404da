// A planted mistake, a common one: the bucket is compared with > where >= is needed. When the square is so far that
// its bucket is the table's length, it is put into the word behind the table, which here is the packet itself. On
// screen it vanishes for a frame; the report names this line.

#include <inline_c.h>
#include <psxgpu.h>
#include <psxgte.h>

enum { buckets = 256, packet_bytes = 1024, width = 320, height = 240 };

typedef struct {
  DISPENV display;
  DRAWENV draw;
  uint32_t table[buckets];
  uint8_t packets[packet_bytes];
} Buffer;

static Buffer buffers[2];

int main(void) {
  ResetGraph(0);
  for (int i = 0; i < 2; ++i) {
    SetDefDispEnv(&buffers[i].display, 0, height * i, width, height);
    SetDefDrawEnv(&buffers[i].draw, 0, height * (1 - i), width, height);
    setRGB0(&buffers[i].draw, 20, 40, 20);
    buffers[i].draw.isbg = 1;
  }
  InitGeom();
  gte_SetGeomOffset(width / 2, height / 2);
  gte_SetGeomScreen(width / 2);
  for (int frame = 0;; ++frame) {
    Buffer* buffer = &buffers[frame & 1];
    MATRIX place = {{{ONE, 0, 0}, {0, ONE, 0}, {0, 0, ONE}}, {0, 0, 1000 + 2 * frame}};
    SVECTOR v[4] = {{-200, -200, 0, 0}, {200, -200, 0, 0}, {-200, 200, 0, 0}, {200, 200, 0, 0}};
    gte_SetRotMatrix(&place);
    gte_SetTransMatrix(&place);
    ClearOTagR(buffer->table, buckets);

    POLY_F4* quad = (POLY_F4*)buffer->packets;
    setPolyF4(quad);
    setRGB0(quad, 200, 200, 60);
    gte_ldv3c(v);
    gte_rtpt();
    gte_stsxy3_f4(quad);
    gte_ldv0(&v[3]);
    gte_rtps();
    gte_stsxy(&quad->x3);
    int bucket;
    gte_avsz4();
    gte_stotz(&bucket);
    if (!(bucket > buckets)) addPrim(&buffer->table[bucket], quad);

    DrawSync(0);
    VSync(0);
    PutDispEnv(&buffer->display);
    PutDrawEnv(&buffer->draw);
    SetDispMask(1);
    DrawOTag(&buffer->table[buckets - 1]);
  }
}
