/* dump_to_png DUMP OUT.png: replays a GPU dump through the C library and writes what the display shows.
 *
 *     cc dump_to_png.c $(pkg-config --cflags --libs otter libpng) -o dump_to_png
 *
 * A dump (PSXGPUDUMPv1r1) is a magic of 16 bytes and packets: a little-endian word of type (bits 24-31) and length
 * (bits 0-23, in words), then so many words. */
#include <otter/otter.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PORT0 = 0, PORT1 = 1, VSYNC = 2, DISCARD = 3, READBACK = 4 };

/* The next little-endian word; 0 at the end of the file. */
static int next_word(FILE* file, uint32_t* word) {
  unsigned char bytes[4];
  if (fread(bytes, 1, 4, file) != 4) return 0;
  *word = (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
  return 1;
}

/* Sends one packet. */
static int send_packet(otter* gpu, unsigned type, const uint32_t* words, size_t count) {
  size_t i;
  switch (type) {
    case PORT0:
      return otter_gp0(gpu, words, count);
    case PORT1:
      for (i = 0; i < count; ++i) otter_gp1(gpu, words[i]);
      return OTTER_OK;
    case VSYNC:
      return otter_vblank(gpu);
    case DISCARD:
    case READBACK:
      for (i = 0; count > 0 && i < words[0] && i < 0x40000; ++i) (void)otter_read(gpu);
      return OTTER_OK;
    default: /* comments and the like */
      return OTTER_OK;
  }
}

static int replay(otter* gpu, FILE* file) {
  char magic[16];
  uint32_t header;
  if (fread(magic, 1, sizeof magic, file) != sizeof magic || memcmp(magic, "PSXGPUDUMPv1r1", 14) != 0) {
    fprintf(stderr, "expected a dump that begins with PSXGPUDUMPv1r1\n");
    return 0;
  }
  while (next_word(file, &header)) {
    const size_t count = header & 0xffffff;
    size_t read = 0;
    uint32_t* words = (uint32_t*)malloc(count * sizeof *words + 1);
    if (words == NULL) return 0;
    while (read < count && next_word(file, &words[read])) ++read;
    if (read < count || send_packet(gpu, header >> 24, words, count) != OTTER_OK) {
      fprintf(stderr, "a packet of %lu words is cut short: %s\n", (unsigned long)count, otter_last_error(gpu));
      free(words);
      return 0;
    }
    free(words);
  }
  return 1;
}

static int write_picture(otter* gpu, const char* path) {
  png_image image;
  uint8_t* pixels;
  int width, height, written;
  if (otter_picture(gpu, NULL, 0, &width, &height) != OTTER_OK) return 0;
  if (width == 0 || height == 0) {
    fprintf(stderr, "the display area is empty: there is no picture\n");
    return 0;
  }
  pixels = (uint8_t*)malloc((size_t)width * (size_t)height * 4);
  if (pixels == NULL) return 0;
  otter_picture(gpu, pixels, (size_t)width * (size_t)height * 4, NULL, NULL);
  memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = (png_uint_32)width;
  image.height = (png_uint_32)height;
  image.format = PNG_FORMAT_RGBA;
  written = png_image_write_to_file(&image, path, 0, pixels, 0, NULL);
  if (!written) fprintf(stderr, "%s: %s\n", path, image.message);
  free(pixels);
  return written;
}

int main(int argc, char** argv) {
  otter* gpu;
  FILE* file;
  int done;
  if (argc != 3 || (file = fopen(argv[1], "rb")) == NULL) {
    fprintf(stderr, "usage: dump_to_png DUMP OUT.png (DUMP must be readable)\n");
    return 2;
  }
  gpu = otter_create();
  done = gpu != NULL && replay(gpu, file) && write_picture(gpu, argv[2]);
  otter_destroy(gpu);
  fclose(file);
  return done ? 0 : 1;
}
