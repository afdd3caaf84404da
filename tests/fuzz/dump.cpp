// Any bytes as a GPU dump, packed or plain: refused with an offset, or replayed whole.

#include "dump/dump.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "dump/compression.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A lower limit than the program's keeps one input from taking seconds.
  auto plain = dump::unpack(std::as_bytes(std::span(data, size)), std::uint64_t{1} << 20);
  if (!plain) return 0;
  auto dump = dump::parse_dump(*plain);
  if (!dump) return 0;
  // One GPU for all inputs: its pixels are what earlier inputs left, and a new one takes longer than a
  // replay.
  static gpu::Gpu gpu;
  gpu.gp1(0);
  (void)dump::replay(*dump, gpu);
  return 0;
}
