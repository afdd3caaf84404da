// Packets from new and on the stack.
#include <psxgpu.h>
#include <stdlib.h>

int main() {
  uint32_t* table = new uint32_t[8];
  TILE on_stack;
  TILE* from_malloc = static_cast<TILE*>(malloc(sizeof(TILE)));
  for (int frame = 0; frame < 2; ++frame) {
    ClearOTagR(table, 8);
    TILE* tiles[] = {&on_stack, from_malloc};
    for (TILE* tile : tiles) {
      setTile(tile);
      setXY0(tile, 0, 0);
      setWH(tile, 8, 8);
      addPrim(&table[3], tile);
    }
    DrawOTag(&table[7]);
    VSync(0);
  }
  delete[] table;
  free(from_malloc);
}
