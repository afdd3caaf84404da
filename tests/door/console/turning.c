/* A program for the console itself, without any SDK: two triangles that turn through each other, projected by the GTE,
 * sorted by an ordering table, sent by DMA. Compiled for the MIPS it runs in an emulator that draws with the plugin.
 * Registers at 1F80xxxxh. [psx-spx, I/O Map, GTE, DMA Channels] */

typedef unsigned int u32;
typedef int s32;

#define REGISTER(address) (*(volatile u32*)(address))
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

#define TO_CONTROL(value, n) __asm__ volatile("ctc2 %0, $" #n "\n nop\n nop" : : "r"(value))
#define TO_DATA(value, n) __asm__ volatile("mtc2 %0, $" #n "\n nop\n nop" : : "r"(value))
#define FROM_DATA(n)                                                   \
  ({                                                                   \
    u32 value;                                                         \
    __asm__ volatile("mfc2 %0, $" #n "\n nop\n nop" : "=r"(value)); \
    value;                                                             \
  })
#define RTPT() __asm__ volatile("nop\n nop\n cop2 0x0280030\n nop\n nop")
#define AVSZ3() __asm__ volatile("nop\n nop\n cop2 0x158002d\n nop\n nop")

enum { entries = 64, packet_words = 7 };
static u32 table[2][entries];
static u32 packets[2][4][packet_words];

/* A circle by a rotation of 1/32 radian, 20.12; it need not stay round, only stay the same everywhere. */
static s32 cosine = 4096, sine = 0;
static void turn(void) {
  cosine -= sine / 32;
  sine += cosine / 32;
}

static void insert(u32* to, u32* packet, u32 words) {
  packet[0] = words << 24 | (*to & 0xffffff);
  *to = (u32)packet & 0xffffff;
}

/* A triangle in the x-z plane turned by the angle, with its colour. */
static void add_triangle(u32* ot, u32* packet, s32 x, s32 z, u32 colour) {
  u32 bucket;
  TO_DATA((u32)(x & 0xffff) | (u32)-80 << 16, 0);
  TO_DATA((u32)(z & 0xffff), 1);
  TO_DATA((u32)(-x & 0xffff) | (u32)-60 << 16, 2);
  TO_DATA((u32)(-z & 0xffff), 3);
  TO_DATA(80 << 16, 4);
  TO_DATA(0, 5);
  RTPT();
  packet[1] = 0x30000000 | colour;
  packet[2] = FROM_DATA(12);
  packet[3] = 0x404040;
  packet[4] = FROM_DATA(13);
  packet[5] = 0xffffff & ~colour;
  packet[6] = FROM_DATA(14);
  AVSZ3();
  bucket = FROM_DATA(7);
  insert(&ot[bucket < entries ? bucket : entries - 1], packet, 6);
}

static void wait_for_blank(void) {
  while ((I_STAT & 1) == 0) {
  }
  I_STAT = ~1u;
}

static void draw_into(u32 y) {
  GP0 = 0xe3000000 | y << 10;
  GP0 = 0xe4000000 | 319 | (y + 239) << 10;
  GP0 = 0xe5000000 | y << 11;
  GP0 = 0x02402010;
  GP0 = y << 16;
  GP0 = 240 << 16 | 320;
}

static void send(u32* ot) {
  DMA2_MADR = (u32)&ot[entries - 1] & 0xffffff;
  DMA2_BCR = 0;
  DMA2_CHCR = 0x01000401;
  while ((DMA2_CHCR & 0x01000000) != 0) {
  }
}

static void clear(u32* ot) {
  DMA6_MADR = (u32)&ot[entries - 1] & 0xffffff;
  DMA6_BCR = entries;
  DMA6_CHCR = 0x11000002;
  while ((DMA6_CHCR & 0x01000000) != 0) {
  }
}

__attribute__((section(".start"))) void start(void) {
  u32 frame;
  __asm__ volatile("mfc0 $8, $12\n nop\n lui $9, 0x4000\n or $8, $8, $9\n mtc0 $8, $12\n nop\n nop" : : : "$8", "$9");
  I_MASK = 0;
  DPCR = 0x0f6f4b21 | 0x0f000f00;
  GP1 = 0;
  GP1 = 0x04000002;
  GP1 = 0x08000001;
  GP1 = 0x03000000;
  TO_CONTROL(4096, 0);
  TO_CONTROL(0, 1);
  TO_CONTROL(4096, 2);
  TO_CONTROL(0, 3);
  TO_CONTROL(4096, 4);
  TO_CONTROL(0, 5);
  TO_CONTROL(0, 6);
  TO_CONTROL(300, 7);
  TO_CONTROL(160 << 16, 24);
  TO_CONTROL(120 << 16, 25);
  TO_CONTROL(320, 26);
  TO_CONTROL(0x155 / 8, 29);
  for (frame = 0;; ++frame) {
    u32 buffer = frame & 1;
    u32* ot = table[buffer];
    clear(ot);
    turn();
    add_triangle(ot, packets[buffer][0], cosine / 32, sine / 32, 0x0000ff);
    add_triangle(ot, packets[buffer][1], sine / 32, -cosine / 32, 0x00ff00);
    wait_for_blank();
    GP1 = 0x05000000 | (buffer != 0 ? 0 : 240) << 10;
    draw_into(buffer != 0 ? 240 : 0);
    send(ot);
  }
}
