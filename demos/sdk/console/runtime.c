// The SDK's functions on the console itself, as far as the programs beside this folder use them. Written apart from
// those of the window (src/sdk), which must send the same words. Registers at 1F80xxxxh: pcsxr hangs on their mirrors
// at BF80xxxxh. Blanks are polled, controllers are not there.   [psx-spx, I/O Map, DMA Channels, GPU Commands]

#include <inline_c.h>
#include <psxapi.h>
#include <psxgpu.h>
#include <psxgte.h>
#include <stdarg.h>

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define GP0 REGISTER(0x1f801810)
#define GP1 REGISTER(0x1f801814)
#define I_STAT REGISTER(0x1f801070)
#define I_MASK REGISTER(0x1f801074)
#define DMA2_MADR REGISTER(0x1f8010a0)
#define DMA2_BCR REGISTER(0x1f8010a4)
#define DMA2_CHCR REGISTER(0x1f8010a8)
#define DMA6_MADR REGISTER(0x1f8010e0)
#define DMA6_BCR REGISTER(0x1f8010e4)
#define DMA6_CHCR REGISTER(0x1f8010e8)
#define DPCR REGISTER(0x1f8010f0)

enum { busy = 1 << 24, blank = 1 };

void* memcpy(void* to, const void* from, size_t bytes) {
  uint8_t* out = to;
  for (const uint8_t* in = from; bytes != 0; --bytes) *out++ = *in++;
  return to;
}
void* memset(void* to, int byte, size_t bytes) {
  for (uint8_t* out = to; bytes != 0; --bytes) *out++ = (uint8_t)byte;
  return to;
}

static void send(const uint32_t* words, size_t count) {
  for (; count != 0; --count) GP0 = *words++;
}

// ---- screen and environments

void ResetGraph(int mode) {
  I_MASK = 0;
  DPCR |= 0x08000800;  // channels 2 and 6 may run
  GP1 = mode == 0 ? 0 : 0x01000000;
  GP1 = 0x04000002;  // port 0 takes words from DMA
}

void SetDispMask(int mask) { GP1 = 0x03000000 | (mask == 0); }

DISPENV* SetDefDispEnv(DISPENV* env, int x, int y, int w, int h) {
  memset(env, 0, sizeof *env);
  setRECT(&env->disp, (int16_t)x, (int16_t)y, (int16_t)w, (int16_t)h);
  return env;
}

DRAWENV* SetDefDrawEnv(DRAWENV* env, int x, int y, int w, int h) {
  memset(env, 0, sizeof *env);
  setRECT(&env->clip, (int16_t)x, (int16_t)y, (int16_t)w, (int16_t)h);
  setRECT(&env->tw, 0, 0, 256, 256);
  env->tpage = 10;
  env->dtd = 1;
  return env;
}

void PutDispEnv(const DISPENV* env) {
  const int w = env->disp.w, left = 0x760 - 1280, top = 0x88 - 120;
  const uint32_t width = w > 560 ? 3 : w > 400 ? 2 : w > 352 ? 1 << 6 : w > 280 ? 1 : 0;
  GP1 = 0x05000000 | (uint32_t)env->disp.x | (uint32_t)env->disp.y << 10;
  GP1 = 0x06000000 | (uint32_t)left | (uint32_t)(left + 2560) << 12;
  GP1 = 0x07000000 | (uint32_t)top | (uint32_t)(top + 240) << 10;
  GP1 = 0x08000000 | width;
}

void PutDrawEnv(DRAWENV* env) {
  const RECT* clip = &env->clip;
  DR_ENV* out = &env->dr_env;
  // A window of all 256 texels: no bit of a coordinate is replaced.
  setDrawTPage_T(&out->tpage, env->dfe, env->dtd, env->tpage);
  out->twin.code[0] = 0xe2000000;
  setDrawArea_T(&out->area, clip);
  setDrawOffset_T(&out->offset, clip->x + env->ofs[0], clip->y + env->ofs[1]);
  setlen(out, env->isbg ? 8 : 5);
  if (env->isbg) {
    setFill_T(&out->fill);
    setRGB0(&out->fill, env->r0, env->g0, env->b0);
    setXY0(&out->fill, (uint16_t)clip->x, (uint16_t)clip->y);
    setWH(&out->fill, (uint16_t)clip->w, (uint16_t)clip->h);
  }
  send((const uint32_t*)out + 1, getlen(out));
}

int VSync(int mode) {
  (void)mode;
  I_STAT = ~(uint32_t)blank;
  while ((I_STAT & blank) == 0) {
  }
  return 0;
}

int DrawSync(int mode) {
  (void)mode;
  while (DMA2_CHCR & busy) {
  }
  return 0;
}

int LoadImage(const RECT* rect, const uint32_t* data) {
  GP0 = 0x01000000;
  GP0 = 0xa0000000;
  GP0 = (uint32_t)rect->x | (uint32_t)rect->y << 16;
  GP0 = (uint32_t)rect->w | (uint32_t)rect->h << 16;
  send(data, (size_t)(rect->w * rect->h + 1) / 2);
  return 0;
}

// ---- lists

void ClearOTagR(uint32_t* ot, size_t length) {
  DMA6_MADR = (uint32_t)&ot[length - 1] & 0xffffff;
  DMA6_BCR = length;
  DMA6_CHCR = 0x11000002;
  while (DMA6_CHCR & busy) {
  }
}

int DrawOTag(const uint32_t* ot) {
  DMA2_MADR = (uint32_t)ot & 0xffffff;
  DMA2_BCR = 0;
  DMA2_CHCR = 0x01000401;
  return DrawSync(0);
}

void DrawPrim(const void* pri) { send((const uint32_t*)pri + 1, getlen(pri)); }

void otter_link(void* ot, void* first, void* last) {
  setaddr(last, getaddr(ot));
  setaddr(ot, first);
}

// ---- numbers

/// sin(a) in 1.3.12, 1024 a quarter: from its peak on about 1 - x^2 * (19900 - 3516 * x^2), with their scales.
int isin(int a) {
  const int x = (int)((uint32_t)(a - 1024) << 21) >> 21;  // -1024 .. 1023 round the nearest peak
  const int squared = x * x >> 6;
  const int y = ONE - (squared * (19900 - (squared * 3516 >> 14)) >> 16);
  return a & 2048 ? -y : y;
}
int icos(int a) { return isin(a + 1024); }

void InitGeom(void) {
  otter_gte_put(56, 0);
  otter_gte_put(57, 0);
  otter_gte_put(58, 320);
  otter_gte_put(61, ONE / 12);
  otter_gte_put(62, ONE / 16);
}

/// out = a * b by the coprocessor, a column at a time. out may be b.
static void multiply(const MATRIX* a, const MATRIX* b, MATRIX* out) {
  const MATRIX right = *b;
  gte_SetRotMatrix(a);
  for (unsigned c = 0; c < 3; ++c) {
    otter_gte_put(0, (uint16_t)right.m[0][c] | (uint32_t)(uint16_t)right.m[1][c] << 16);
    otter_gte_put(1, (uint32_t)right.m[2][c]);
    gte_rtv0();
    for (unsigned r = 0; r < 3; ++r) out->m[r][c] = (int16_t)otter_gte_get(9 + r);
  }
}

MATRIX* MulMatrix0(MATRIX* m0, MATRIX* m1, MATRIX* m2) {
  multiply(m0, m1, m2);
  return m2;
}

/// The coprocessor's rotation is as before; its translation is not touched.
MATRIX* RotMatrix(SVECTOR* r, MATRIX* m) {
  const int16_t sx = (int16_t)isin(r->vx), cx = (int16_t)icos(r->vx), sy = (int16_t)isin(r->vy),
                cy = (int16_t)icos(r->vy), sz = (int16_t)isin(r->vz), cz = (int16_t)icos(r->vz);
  const MATRIX x = {{{ONE, 0, 0}, {0, cx, (int16_t)-sx}, {0, sx, cx}}, {0, 0, 0}};
  const MATRIX y = {{{cy, 0, sy}, {0, ONE, 0}, {(int16_t)-sy, 0, cy}}, {0, 0, 0}};
  const MATRIX z = {{{cz, (int16_t)-sz, 0}, {sz, cz, 0}, {0, 0, ONE}}, {0, 0, 0}};
  uint32_t kept[5];
  for (unsigned n = 0; n < 5; ++n) kept[n] = otter_gte_get(32 + n);
  MATRIX xy;
  multiply(&x, &y, &xy);
  multiply(&xy, &z, m);
  for (unsigned n = 0; n < 5; ++n) otter_gte_put(32 + n, kept[n]);
  return m;
}

MATRIX* TransMatrix(MATRIX* m, VECTOR* r) {
  m->t[0] = r->vx;
  m->t[1] = r->vy;
  m->t[2] = r->vz;
  return m;
}

// ---- controllers: none is there

void InitPAD(uint8_t* buff1, int len1, uint8_t* buff2, int len2) {
  if (len1 > 0) buff1[0] = 0xff;
  if (len2 > 0) buff2[0] = 0xff;
}
void StartPAD(void) {}

// ---- the debug font: one stream

enum { letter = 8, letters_a_row = 16, glyph_width = 5, glyph_height = 7 };
static const uint8_t glyphs[64][glyph_height] = {
#include "glyphs.inc"
};
static uint32_t font_texture[32 * 32 / 2];
static uint16_t font_page, font_clut;
static struct {
  int x, y, w, h, limit, length;
  char text[256];
} stream;

void FntLoad(int x, int y) {
  static const uint32_t colours[8] = {0x7fff0000};
  for (unsigned n = 0; n < 64; ++n) {
    for (unsigned bit = 0; bit < glyph_width * glyph_height; ++bit) {
      const unsigned row = bit / glyph_width, column = bit % glyph_width;
      if ((glyphs[n][row] >> (glyph_width - 1 - column) & 1) == 0) continue;
      const unsigned at = (n / letters_a_row * letter + 1 + row) * 128 + n % letters_a_row * letter + 1 + column;
      font_texture[at / 8] |= 1u << (at % 8 * 4);
    }
  }
  const RECT area = {(int16_t)x, (int16_t)y, 32, 32}, clut = {(int16_t)x, (int16_t)(y + 32), 16, 1};
  LoadImage(&area, font_texture);
  LoadImage(&clut, colours);
  font_page = (uint16_t)getTPage(0, 0, x, y);
  font_clut = (uint16_t)getClut(x, y + 32);
}

int FntOpen(int x, int y, int w, int h, int isbg, int n) {
  (void)isbg;
  stream.x = x;
  stream.y = y;
  stream.w = w;
  stream.h = h;
  stream.limit = n < (int)sizeof stream.text ? n : (int)sizeof stream.text;
  stream.length = 0;
  return 0;
}

static void add_letter(char c) {
  if (stream.length < stream.limit) stream.text[stream.length++] = c;
}
static void add_number(unsigned value) {
  if (value >= 10) add_number(value / 10);
  add_letter((char)('0' + value % 10));
}

/// Knows %d and %s.
int FntPrint(int id, const char* fmt, ...) {
  (void)id;
  va_list arguments;
  va_start(arguments, fmt);
  for (; *fmt != '\0'; ++fmt) {
    if (*fmt != '%') {
      add_letter(*fmt);
    } else if (*++fmt == 'd') {
      const int value = va_arg(arguments, int);
      if (value < 0) add_letter('-');
      add_number(value < 0 ? -(unsigned)value : (unsigned)value);
    } else if (*fmt == 's') {
      for (const char* text = va_arg(arguments, const char*); *text != '\0'; ++text) add_letter(*text);
    }
  }
  va_end(arguments);
  return stream.length;
}

void* FntFlush(int id) {
  (void)id;
  DR_TPAGE page;
  setDrawTPage(&page, 0, 0, font_page);
  DrawPrim(&page);
  int x = stream.x, y = stream.y;
  for (int n = 0; n < stream.length; ++n) {
    const char c = stream.text[n];
    if (c == '\n' || x - stream.x > stream.w - letter) {
      x = stream.x;
      y += letter;
      if (c == '\n') continue;
    }
    if (y - stream.y > stream.h - letter) break;
    if (c > ' ') {
      const int glyph = (c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c) - '!';
      SPRT_8 sprite;
      setSprt8(&sprite);
      setShadeTex(&sprite, 1);
      setRGB0(&sprite, 0, 0, 0);
      setXY0(&sprite, (int16_t)x, (int16_t)y);
      setUV0(&sprite, (uint8_t)(glyph % letters_a_row * letter), (uint8_t)(glyph / letters_a_row * letter));
      sprite.clut = font_clut;
      DrawPrim(&sprite);
    }
    x += letter;
  }
  stream.length = 0;
  return NULL;
}
