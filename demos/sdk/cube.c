// A turning cube: RTPT and NCLIP for every face, AVSZ4 for its bucket, an ordering table of 256 entries.

#include <inline_c.h>
#include <psxgpu.h>
#include <psxgte.h>

enum { buckets = 256, packet_bytes = 4096, width = 320, height = 240 };

typedef struct {
  DISPENV display;
  DRAWENV draw;
  uint32_t table[buckets];
  uint8_t packets[packet_bytes];
} Buffer;

static Buffer buffers[2];

static SVECTOR corners[8] = {{-100, -100, -100, 0}, {100, -100, -100, 0}, {-100, 100, -100, 0}, {100, 100, -100, 0},
                             {-100, -100, 100, 0},  {100, -100, 100, 0},  {-100, 100, 100, 0},  {100, 100, 100, 0}};
static const uint8_t faces[6][4] = {{0, 1, 2, 3}, {5, 4, 7, 6}, {4, 5, 0, 1}, {2, 3, 6, 7}, {4, 0, 6, 2}, {1, 5, 3, 7}};
static SVECTOR normals[6] = {{0, 0, -ONE, 0}, {0, 0, ONE, 0}, {0, -ONE, 0, 0}, {0, ONE, 0, 0}, {-ONE, 0, 0, 0}, {ONE, 0, 0, 0}};

static MATRIX lights = {{{2048, -1024, -3072}, {-3072, -1024, 1024}, {0, 0, 0}}, {0, 0, 0}};  // rows: towards a light
static MATRIX light_colours = {{{ONE, 800, 0}, {ONE, 1200, 0}, {ONE, 2400, 0}}, {0, 0, 0}};  // columns: its colour

static void set_up(void) {
  ResetGraph(0);
  for (int i = 0; i < 2; ++i) {
    SetDefDispEnv(&buffers[i].display, 0, height * i, width, height);
    SetDefDrawEnv(&buffers[i].draw, 0, height * (1 - i), width, height);
    setRGB0(&buffers[i].draw, 30, 30, 60);
    buffers[i].draw.isbg = 1;
  }
  InitGeom();
  gte_SetGeomOffset(width / 2, height / 2);
  gte_SetGeomScreen(width / 2);
  gte_SetBackColor(60, 60, 60);
  gte_SetColorMatrix(&light_colours);
}

/// The packets of the faces turned to the eye; returns the free place behind them.
static uint8_t* draw_cube(Buffer* buffer, uint8_t* next) {
  for (int f = 0; f < 6; ++f) {
    int area, bucket;
    gte_ldv3(&corners[faces[f][0]], &corners[faces[f][1]], &corners[faces[f][2]]);
    gte_rtpt();
    gte_nclip();
    gte_stopz(&area);
    if (area <= 0) continue;

    POLY_F4* quad = (POLY_F4*)next;
    setPolyF4(quad);
    gte_stsxy3_f4(quad);
    gte_ldv0(&corners[faces[f][3]]);
    gte_rtps();
    gte_stsxy(&quad->x3);
    gte_avsz4();
    gte_stotz(&bucket);
    bucket >>= 2;
    if (bucket <= 0 || bucket >= buckets) continue;

    CVECTOR colour = {200, 160, 80, quad->code};
    gte_ldrgb(&colour);
    gte_ldv0(&normals[f]);
    gte_nccs();
    gte_strgb(&quad->r0);
    addPrim(&buffer->table[bucket], quad);
    next += sizeof(POLY_F4);
  }
  return next;
}

int main(void) {
  set_up();
  SVECTOR angle = {0, 0, 0, 0};
  VECTOR place = {0, 0, 450};
  for (int frame = 0;; ++frame) {
    Buffer* buffer = &buffers[frame & 1];
    MATRIX turn, light;
    RotMatrix(&angle, &turn);
    TransMatrix(&turn, &place);
    MulMatrix0(&lights, &turn, &light);
    gte_SetLightMatrix(&light);
    gte_SetRotMatrix(&turn);
    gte_SetTransMatrix(&turn);

    ClearOTagR(buffer->table, buckets);
    draw_cube(buffer, buffer->packets);
    angle.vx += 16;
    angle.vy += 24;

    DrawSync(0);
    VSync(0);
    PutDispEnv(&buffer->display);
    PutDrawEnv(&buffer->draw);
    SetDispMask(1);
    DrawOTag(&buffer->table[buckets - 1]);
  }
}
