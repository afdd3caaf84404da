// A textured corridor: affine texture coordinates bend on large walls, so each wall is a grid of small quads. Left
// and right walk the camera sideways, up and down along the corridor. Two signs hang in it.

#include <inline_c.h>
#include <psxapi.h>
#include <psxgpu.h>
#include <psxgte.h>
#include <psxpad.h>

enum {
  buckets = 1024,
  packet_bytes = 32768,
  width = 320,
  height = 240,
  half_width = 256,   // of the corridor, in its own units
  half_height = 192,
  across = 4,         // quads across a wall
  along = 12,         // and along it
  length = 3072,
  nearest = 64,
};

typedef struct {
  DISPENV display;
  DRAWENV draw;
  uint32_t table[buckets];
  uint8_t packets[packet_bytes];
} Buffer;

static Buffer buffers[2];
static uint8_t pads[2][34];
static uint32_t bricks[64 * 64 / 8];  // 4 bits a texel

static void paint_bricks(void) {
  static const uint16_t colours[16] = {0x0842, 0x1d18, 0x2539, 0x2d5a};
  const RECT texture = {640, 0, 16, 64}, palette = {640, 64, 16, 1};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int row = y / 16, column = (x + row % 2 * 16) % 64;
      const int is_joint = y % 16 < 2 || column % 32 < 2;
      const uint32_t colour = is_joint ? 0u : 1u + (uint32_t)((row * 2 + column / 32) % 3);
      bricks[(y * 64 + x) / 8] |= colour << (x % 8 * 4);
    }
  }
  LoadImage(&texture, bricks);
  LoadImage(&palette, (const uint32_t*)colours);
}

static void set_up(void) {
  ResetGraph(0);
  for (int i = 0; i < 2; ++i) {
    SetDefDispEnv(&buffers[i].display, 0, height * i, width, height);
    SetDefDrawEnv(&buffers[i].draw, 0, height * (1 - i), width, height);
    buffers[i].draw.isbg = 1;
  }
  InitGeom();
  gte_SetGeomOffset(width / 2, height / 2);
  gte_SetGeomScreen(width / 2);
  paint_bricks();
  InitPAD(pads[0], 34, pads[1], 34);
  StartPAD();
}

/// One quad of a wall, from four corners in the order of the packet.
static uint8_t* draw_quad(Buffer* buffer, uint8_t* next, SVECTOR* v, int brightness) {
  const uint8_t shade = (uint8_t)brightness;
  int flag, bucket, area;
  POLY_FT4* quad = (POLY_FT4*)next;
  setPolyFT4(quad);
  setRGB0(quad, shade, shade, shade);
  setTPage(quad, 0, 0, 640, 0);
  setClut(quad, 640, 64);
  setUVWH(quad, 0, 0, 63, 63);

  gte_ldv3(&v[0], &v[1], &v[2]);
  gte_rtpt();
  gte_stflg(&flag);
  if (flag < 0) return next;
  gte_nclip();
  gte_stopz(&area);
  if (area <= 0) return next;
  gte_stsxy3_ft4(quad);
  gte_ldv0(&v[3]);
  gte_rtps();
  gte_stflg(&flag);
  if (flag < 0) return next;
  gte_stsxy(&quad->x3);
  gte_avsz4();
  gte_stotz(&bucket);
  if (bucket <= 0 || bucket >= buckets) return next;
  addPrim(&buffer->table[bucket], quad);
  return next + sizeof(POLY_FT4);
}

/// One wall: `at` gives the corner of column i, 0..across.
static uint8_t* draw_wall(Buffer* buffer, uint8_t* next, SVECTOR (*at)(int i), int shade, int from) {
  for (int j = 0; j < along; ++j) {
    const int near = from + length * j / along, far = from + length * (j + 1) / along;
    if (near < nearest) continue;
    for (int i = 0; i < across; ++i) {
      SVECTOR v[4] = {at(i), at(i + 1), at(i), at(i + 1)};
      v[0].vz = v[1].vz = (int16_t)far;
      v[2].vz = v[3].vz = (int16_t)near;
      next = draw_quad(buffer, next, v, shade - j * 6);
    }
  }
  return next;
}

/// A square that hangs in the corridor and faces the eye, at the near edge of a ring of wall quads: every quad that
/// it hides lies farther by its average, too, so the table's order is right.
static uint8_t* draw_sign(Buffer* buffer, uint8_t* next, int x, int y, int half, int z) {
  SVECTOR v[4];
  for (int i = 0; i < 4; ++i) {
    setVector(&v[i], (int16_t)(x + (i & 1 ? half : -half)), (int16_t)(y + (i & 2 ? half : -half)), (int16_t)z);
  }
  return draw_quad(buffer, next, v, 150);
}

static SVECTOR corner(int x, int y) {
  SVECTOR v = {(int16_t)x, (int16_t)y, 0, 0};
  return v;
}
static int step(int half, int i) { return 2 * half * i / across - half; }
static SVECTOR floor_corner(int i) { return corner(step(half_width, i), half_height); }
static SVECTOR ceiling_corner(int i) { return corner(-step(half_width, i), -half_height); }
static SVECTOR left_corner(int i) { return corner(-half_width, step(half_height, i)); }
static SVECTOR right_corner(int i) { return corner(half_width, -step(half_height, i)); }

int main(void) {
  set_up();
  VECTOR eye = {0, 0, 0};
  SVECTOR angle = {0, 0, 0, 0};
  for (int frame = 0;; ++frame) {
    Buffer* buffer = &buffers[frame & 1];
    const PADTYPE* pad = (const PADTYPE*)pads[0];
    const int held = pad->stat == 0 ? ~pad->btn : 0;
    if (held & PAD_LEFT) eye.vx -= 8;
    if (held & PAD_RIGHT) eye.vx += 8;
    if (held & PAD_UP) eye.vz += 8;
    if (held & PAD_DOWN) eye.vz -= 8;

    MATRIX view;
    VECTOR moved = {-eye.vx, -eye.vy, 0};
    RotMatrix(&angle, &view);
    TransMatrix(&view, &moved);
    gte_SetRotMatrix(&view);
    gte_SetTransMatrix(&view);

    ClearOTagR(buffer->table, buckets);
    uint8_t* next = buffer->packets;
    const int from = -(eye.vz % (length / along));
    next = draw_wall(buffer, next, floor_corner, 128, from);
    next = draw_wall(buffer, next, ceiling_corner, 90, from);
    next = draw_wall(buffer, next, left_corner, 110, from);
    next = draw_wall(buffer, next, right_corner, 110, from);
    next = draw_sign(buffer, next, -60, -70, 60, from + 3 * length / along);
    draw_sign(buffer, next, 20, -40, 110, from + 6 * length / along);

    DrawSync(0);
    VSync(0);
    PutDispEnv(&buffer->display);
    PutDrawEnv(&buffer->draw);
    SetDispMask(1);
    DrawOTag(&buffer->table[buckets - 1]);
  }
}
