// Any main RAM walked as a list: four bytes say where it begins, the rest is copied to the start of RAM as
// often as it fits, so that links find something wherever they lead.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "gpu/gpu.h"
#include "ot/walker.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 8) return 0;
  std::uint32_t first = 0;
  std::memcpy(&first, data, sizeof first);
  static ot::MainRam ram(ot::RamSize::mib2);  // behind the copies lies what earlier inputs left
  const std::size_t words = std::min<std::size_t>((size - 4) / 4, 4096);
  for (std::size_t at = 0; at < 2 * words; ++at) std::memcpy(&ram.words()[at], data + 4 + at % words * 4, 4);
  static gpu::Gpu gpu;
  gpu.gp1(0);
  std::uint32_t sent = 0;
  const auto result =
      ot::walk(ram, first & 0xffffff, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
        sent += static_cast<std::uint32_t>(payload.size());
        if (sent < 10'000) gpu.gp0(payload);
      });
  if (!result) (void)result.message();
  return 0;
}
