// Any bytes as a GPU dump: refused with an offset, or replayed whole.

#include "gpu/dump.h"

#include <cstddef>
#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto dump = gpu::parse_dump(std::as_bytes(std::span(data, size)));
  if (!dump) return 0;
  static gpu::Gpu
      gpu;  // its pixels are what earlier inputs left: harmless, and a new one takes longer than a replay
  gpu.gp1(0);
  (void)gpu::replay(*dump, gpu);
  return 0;
}
