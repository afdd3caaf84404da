// The program's own malloc and new: a heap in static storage, so that packets in it can be linked. The names
// are what objcopy puts into the program's objects in place of the usual ones (otter-sdk.cmake); the runtime
// and its libraries keep the system's.
//
// First fit in a list of blocks in address order; neighbours that are free become one.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

constexpr std::size_t heap_bytes = std::size_t{1} << 20, unit = 16;

struct alignas(unit) Block {
  std::size_t bytes;  // with this head
  bool is_free;
};
static_assert(sizeof(Block) == unit);

alignas(unit) std::byte heap[heap_bytes];
bool is_ready = false;

Block* first() {
  auto* block = reinterpret_cast<Block*>(heap);
  if (!is_ready) {
    *block = {heap_bytes, true};
    is_ready = true;
  }
  return block;
}

Block* after(Block* block) {
  auto* next = reinterpret_cast<std::byte*>(block) + block->bytes;
  return next == heap + heap_bytes ? nullptr : reinterpret_cast<Block*>(next);
}

void* memory(Block* block) { return block + 1; }
Block* block_of(void* p) { return static_cast<Block*>(p) - 1; }

void join_free_neighbours() {
  for (auto* block = first(); block != nullptr;) {
    auto* next = after(block);
    if (next != nullptr && block->is_free && next->is_free) {
      block->bytes += next->bytes;
    } else {
      block = next;
    }
  }
}

}  // namespace

extern "C" {

void* otter_malloc(std::size_t bytes) {
  if (bytes > heap_bytes) return nullptr;
  const std::size_t needed = (bytes + sizeof(Block) + unit - 1) / unit * unit;
  for (auto* block = first(); block != nullptr; block = after(block)) {
    if (!block->is_free || block->bytes < needed) continue;
    if (block->bytes > needed) {
      auto* rest = reinterpret_cast<Block*>(reinterpret_cast<std::byte*>(block) + needed);
      *rest = {block->bytes - needed, true};
    }
    *block = {needed, false};
    return memory(block);
  }
  return nullptr;
}

void otter_free(void* p) {
  if (p == nullptr) return;
  block_of(p)->is_free = true;
  join_free_neighbours();
}

void* otter_calloc(std::size_t count, std::size_t bytes) {
  if (bytes != 0 && count > heap_bytes / bytes) return nullptr;
  void* p = otter_malloc(count * bytes);
  if (p != nullptr) std::memset(p, 0, count * bytes);
  return p;
}

void* otter_realloc(void* p, std::size_t bytes) {
  if (p == nullptr) return otter_malloc(bytes);
  const std::size_t held = block_of(p)->bytes - sizeof(Block);
  if (bytes <= held) return p;
  void* larger = otter_malloc(bytes);
  if (larger == nullptr) return nullptr;
  std::memcpy(larger, p, held);
  otter_free(p);
  return larger;
}

// operator new and delete, plain, of arrays, and with a size: objcopy wants a name of its own for each.
void* otter_new(std::size_t bytes) { return otter_malloc(bytes); }
void* otter_new_array(std::size_t bytes) { return otter_malloc(bytes); }
void otter_delete(void* p) { otter_free(p); }
void otter_delete_array(void* p) { otter_free(p); }
void otter_delete_sized(void* p, std::size_t) { otter_free(p); }
void otter_delete_array_sized(void* p, std::size_t) { otter_free(p); }

// The kernel's random numbers: x = x * 41C64E6Dh + 3039h, bits 16-30.   [psx-spx, BIOS A(2Fh) rand]
static std::uint32_t seed = 0;
int otter_rand(void) {
  seed = seed * 0x41c64e6dU + 0x3039U;
  return static_cast<int>(seed >> 16 & 0x7fff);
}
void otter_srand(unsigned value) { seed = value; }

}  // extern "C"
