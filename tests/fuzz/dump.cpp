// Any bytes as a GPU dump, packed or plain: refused with an offset, or replayed whole.

#include "gpu/dump.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/compression.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A lower limit than the program's keeps one input from taking seconds.
  auto plain = gpu::unpack(std::as_bytes(std::span(data, size)), std::uint64_t{1} << 20);
  if (!plain) return 0;
  auto dump = gpu::parse_dump(*plain);
  if (!dump) return 0;
  // One GPU for all inputs: its pixels are what earlier inputs left, and a new one takes longer than a
  // replay.
  static gpu::Gpu gpu;
  gpu.gp1(0);
  (void)gpu::replay(*dump, gpu);
  return 0;
}
