#include <psxgpu.h>

void make_tile(TILE* tile, const unsigned char* rgb) {
  setTile(tile);
  setXY0(tile, 100, 60);
  setWH(tile, 64, 32);
  setRGB0(tile, rgb[0], rgb[1], rgb[2]);
}
