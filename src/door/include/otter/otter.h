/* The console's GPU as a C library, for emulators and for programs in other languages.
 *
 * A handle is one GPU with its own 1 MiB of VRAM: GP0 and GP1 words go in, pixels, status and read-back come
 * out, to the bit as on the first PlayStation. Beyond the console, and only when asked for: a z-buffer and
 * the other knobs of the program `otter`, recordings that `otter replay` reads, and who wrote which pixel.
 *
 * Not modelled: time. Every command is complete when its call returns, the FIFO is always empty, GPUSTAT
 * never says busy. A host that wants cycles weighs the pixels that otter_pixels() counts. The texture cache
 * is not modelled either: texels are read from VRAM as it is.
 *
 * Errors. Functions that return int return OTTER_OK or one of the negative codes below; otter_last_error()
 * then has one sentence. No call crashes, whatever it is given, as long as pointers are null or point to as
 * much memory as is said here. Nothing is written to standard output or standard error, and no signal is
 * raised or caught.
 *
 * Threads. A handle is used by one thread at a time; different handles may be used by different threads at
 * once.
 *
 * Memory. Whatever a pointer to const points to is read during the call and not kept. What a function returns
 * a pointer to belongs to the handle (or, where no handle is given, to the library) and lives as long as is
 * said there.
 *
 * Versions. The name of the library's file (libotter.so.1) changes when a function or a structure of this
 * header does; functions that are added bear the version in which they came. */
#ifndef OTTER_OTTER_H
#define OTTER_OTTER_H

#include <stddef.h>
#include <stdint.h>

#define OTTER_VERSION_MAJOR 0
#define OTTER_VERSION_MINOR 1
#define OTTER_VERSION_PATCH 0

#if defined(__GNUC__)
#define OTTER_API __attribute__((visibility("default")))
#else
#define OTTER_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct otter otter; /* one GPU */

enum {
  OTTER_OK = 0,
  OTTER_NO_HANDLE = -1,    /* the handle is null */
  OTTER_BAD_ARGUMENT = -2, /* a null pointer, or a number outside what the function says */
  OTTER_BAD_DATA = -3,     /* a state that is none, is damaged or of another version */
  OTTER_UNKNOWN_KNOB = -4, /* no knob of this name, or none that a stream of words can honour */
  OTTER_BAD_VALUE = -5,    /* the knob does not take this value */
  OTTER_NO_MEMORY = -6,    /* the system has no memory left; the handle is as it was */
  OTTER_NOT_WRITTEN = -7,  /* a file could not be written */
  OTTER_NOT_AVAILABLE = -8 /* asked for what is switched off, or for something that is not there */
};

/* "0.1.0". The numbers of the library, where those above are the header's. */
OTTER_API const char* otter_version(void);

/* One sentence about the last call with this handle that failed, "" if none has; it lives until the next call
 * with the handle. With a null handle: about the last call of this thread that had no handle. Never null. */
OTTER_API const char* otter_last_error(const otter* gpu);

/* A GPU as after GP1(00h) with VRAM all zero; null when there is no memory. Null may be destroyed. */
OTTER_API otter* otter_create(void);
OTTER_API void otter_destroy(otter* gpu);

/* --- the two ports --- */

/* GP0: commands and their data. A command may be cut between calls in any way; any word is accepted. */
OTTER_API int otter_gp0(otter* gpu, const uint32_t* words, size_t count);
OTTER_API int otter_gp0_word(otter* gpu, uint32_t word);

/* GP1: one control word. */
OTTER_API int otter_gp1(otter* gpu, uint32_t word);

/* GPUREAD: the next two pixels of a transfer from VRAM, else what GP1(10h) latched. Without a handle 0. */
OTTER_API uint32_t otter_read(otter* gpu);
OTTER_API int otter_read_many(otter* gpu, uint32_t* words, size_t count);

/* GPUSTAT of a GPU that is never busy. Bit 31 changes with every vertical blank; a host that knows the line
 * being displayed puts its own there. Without a handle 0. */
OTTER_API uint32_t otter_status(otter* gpu);

/* A vertical blank: an interlaced picture goes on with its other field. With --visibility zbuffer the frame
 * ends and the next one begins with an empty depth plane. */
OTTER_API int otter_vblank(otter* gpu);

/* --- lists in main RAM --- */

enum {
  OTTER_LIST_DONE = 0,             /* the list ended with the end marker, FFFFFFh */
  OTTER_LIST_LOOP = 1,             /* a link leads back to a tag of the list */
  OTTER_LIST_OUTSIDE_RAM = 2,      /* a link has bit 23 set and is not the end marker */
  OTTER_LIST_PAYLOAD_PAST_END = 3, /* a payload runs past the end of RAM */
  OTTER_LIST_TOO_LONG = 4          /* there are more tags than were allowed */
};

typedef struct otter_list {
  uint32_t end;         /* OTTER_LIST_DONE ... */
  uint32_t bad_tag;     /* address of the faulty tag as it was linked; FFFFFFFFh without a fault */
  uint32_t linked_from; /* the tag whose link led there; FFFFFFFFh: the head did */
  uint32_t nodes;       /* good tags, those of ordering tables included, each of a loop once */
  uint32_t words;       /* their payload, all sent */
  uint32_t tables;      /* ordering tables found: runs of 4 or more empty tags one word apart */
  uint32_t buckets;     /* entries of the longest of them */
} otter_list;

/* DMA channel 2 in linked-list mode: sends the list at `head`, up to its end or its fault, or `max_tags`
 * tags. `ram`: main RAM in words of the host, `bytes` long, a power of two from 4 to 8 MiB; addresses are
 * those of the tags: bytes, mirrored into the RAM, bit 23 outside it. Any list is OTTER_OK: what is wrong
 * with one is told in `list` (may be null) and by otter_last_error(). While writes are traced, what is drawn
 * is noted with its bucket. */
OTTER_API int otter_dma_chain(otter* gpu, const uint32_t* ram, size_t bytes, uint32_t head, uint32_t max_tags,
                              otter_list* list);

/* What is suspicious about a list, drawing nothing: loops, tags linked twice, packets that overlap, buckets
 * that the list skips, packets beside the table. Returns how many findings there are, or a negative code.
 * Text n: "KIND ADDRESS: one clause", null beyond the last; it lives until the next lint of the handle. */
OTTER_API int otter_lint(otter* gpu, const uint32_t* ram, size_t bytes, uint32_t head);
OTTER_API const char* otter_lint_text(const otter* gpu, int n);

/* --- VRAM, picture, state --- */

/* 1024 x 512 pixels, rows from the top; bits 0-4 red, 5-9 green, 10-14 blue, 15 mask. May be written to.
 * Lives as long as the handle; the address never changes. Without a handle null. */
OTTER_API uint16_t* otter_vram(otter* gpu);

typedef struct otter_area {
  int32_t x, y;          /* top left in VRAM */
  int32_t width, height; /* pixels of the picture, as the mode says; height 0: an empty range */
  int32_t is_24_bit;     /* three bytes a pixel from x on */
  int32_t is_off;        /* the picture is black */
} otter_area;

/* The display area that GP1(03h), (05h), (07h) and (08h) select. */
OTTER_API int otter_display(const otter* gpu, otter_area* area);

/* The picture shown, as the knobs ask for it: 4 bytes a pixel in the order R, G, B, A (255), rows from the
 * top, no padding. Sets *width and *height (may be null). `rgba` null: that is all; else `bytes` must be at
 * least 4 * width * height, or OTTER_BAD_ARGUMENT. */
OTTER_API int otter_picture(otter* gpu, uint8_t* rgba, size_t bytes, int* width, int* height);

/* The whole GPU as bytes: VRAM, registers, palette cache, what is half sent or half received, a frame's
 * depth. About 1 MiB, 3 MiB with a z-buffer. Returns the bytes needed, and has written them if `size` is that
 * large and `state` is not null; 0 without a handle or memory. Not in it: knobs, trace, recording, counts. */
OTTER_API size_t otter_save(otter* gpu, void* state, size_t size);
/* Goes on from a saved state, of this version of the format. OTTER_BAD_DATA: the handle is as it was. A
 * recording goes on too: what the load changed is in it. */
OTTER_API int otter_load(otter* gpu, const void* state, size_t size);

/* --- knobs --- */

/* The knobs of the program by name and value, those that a stream of words can honour: otter_set(gpu,
 * "visibility", "zbuffer"). Takes effect with the next command; depth planes begin empty. */
OTTER_API int otter_set(otter* gpu, const char* knob, const char* value);
/* The value of a knob: copied, cut to size - 1 characters and ended with 0. */
OTTER_API int otter_get(const otter* gpu, const char* knob, char* value, size_t size);
/* Knob n, from 0: its name, what it takes ("ot|zbuffer"), and a line of help; null beyond the last. */
OTTER_API const char* otter_knob_name(int n);
OTTER_API const char* otter_knob_values(int n);
OTTER_API const char* otter_knob_help(int n);

/* --- depth of programs that know nothing of it --- */

/* A vertex that the GTE has just projected. `xy`: SXY2 as the program reads it, y in the high half. `z`:
 * view-space depth, unsigned 20.12 (SZ3 << 12 at least). `fractions`: the 8 bits below the integer x, and
 * shifted by 8 those below y. A polygon of which all vertices were told, in this list or the one before, is
 * given their depth; the last vertex told wins where two lie on one pixel. The depth is seen by --visibility
 * zbuffer, by knobs that need it, in the trace and in recordings; on the console's own picture it has no
 * influence. */
OTTER_API int otter_vertex(otter* gpu, uint32_t xy, uint32_t z, uint32_t fractions);

typedef struct otter_depth {
  uint64_t polygons;   /* seen since the first vertex was told */
  uint64_t with_depth; /* of these, given depth or bringing it */
  uint64_t partly;     /* some vertices were known and others not */
  uint64_t doubtful;   /* given depth, but two vertices of different depth lay on one of their pixels */
} otter_depth;

OTTER_API int otter_depth_found(const otter* gpu, otter_depth* depth);

/* --- recording --- */

/* Begins to record a GPU dump of what comes in (PSXGPUDUMPv1r1, read by `otter replay`), the present state
 * first; a recording under way is written. `path` null: ends and writes the file, whole or not at all. */
OTTER_API int otter_record(otter* gpu, const char* path);

/* --- who wrote which pixel --- */

enum {
  OTTER_TRACE_OFF = 0,
  OTTER_TRACE_WRITERS = 1, /* the last writer of each pixel */
  OTTER_TRACE_HISTORY = 2  /* all writes since the frame began: 28 bytes each */
};
/* Begins, or begins anew, or ends to note writes; otter_vblank() begins anew too. */
OTTER_API int otter_trace(otter* gpu, int mode);

enum {
  OTTER_POLYGON = 0,
  OTTER_RECTANGLE = 1,
  OTTER_LINE = 2,
  OTTER_FILL = 3,
  OTTER_COPY = 4,
  OTTER_UPLOAD = 5
};

typedef struct otter_draw {
  uint32_t kind;           /* OTTER_POLYGON ... */
  uint32_t command;        /* the command word */
  uint32_t command_number; /* of the frame, from 0 */
  uint32_t bucket;         /* of its ordering table; FFFFFFFFh: unknown */
  uint32_t vertices;       /* 1 to 4 */
  int32_t x[4], y[4];      /* in VRAM, drawing offset added */
  uint32_t z[4];           /* view-space depth, 20.12; 0 where there is none */
  int32_t width, height;   /* of rectangles, fills, copies, uploads */
} otter_draw;

typedef struct otter_write {
  uint32_t draw;          /* number of the draw, for otter_draw_at() */
  uint16_t before, after; /* the pixel */
  uint16_t fragment;      /* what was to be written before blending */
  uint8_t blended;        /* 1: after was mixed with before */
  uint8_t rejected;       /* 1: lost the depth test, nothing was written */
} otter_write;

/* The draw that wrote a pixel last. OTTER_NOT_AVAILABLE: no trace, or nobody wrote it since the trace began.
 */
OTTER_API int otter_last_writer(otter* gpu, int x, int y, otter_draw* draw);
/* The writes to a pixel, oldest first: copies up to `max` of them to `writes` (may be null) and returns how
 * many there are, or a negative code. */
OTTER_API int otter_history(otter* gpu, int x, int y, otter_write* writes, size_t max);
/* Draw number n since the trace began. */
OTTER_API int otter_draw_at(otter* gpu, uint32_t n, otter_draw* draw);

/* --- pixels for the host's clock --- */

typedef struct otter_pixel_counts {
  uint64_t polygons[8], rectangles[8], lines[8]; /* index: 1 Gouraud + 2 textured + 4 semi-transparent */
  uint64_t fills, copies, uploads, downloads;
} otter_pixel_counts;

/* The pixels that the console would have visited since the last call, which begins the count: the first call
 * finds zeros. A handle that is never asked counts nothing. */
OTTER_API int otter_pixels(otter* gpu, otter_pixel_counts* counts);

#ifdef __cplusplus
}
#endif

#endif
