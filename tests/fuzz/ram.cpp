// Any main RAM as a list: the first three bytes say where it begins, bit 0 of the fourth whether the
// registers of DMA channel 2 send it instead of the walker, bit 1 whether channel 6 clears a table in it
// before. The rest is copied to the start of RAM twice, so that links find something wherever they lead.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "gpu/gpu.h"
#include "ot/dma.h"
#include "ot/walker.h"

namespace {

constexpr std::uint64_t budget = 10'000;  // of words, for lists that loop

void send_by_registers(ot::MainRam& ram, gpu::Gpu& gpu, std::uint32_t first, bool clears_first) {
  ot::PortOf port(gpu);
  ot::Dma dma(ram);
  dma.write(ot::dma::dpcr, 0x0fffffff);
  if (clears_first) {
    dma.write(ot::dma::madr(ot::dma::otc), first);
    dma.write(ot::dma::bcr(ot::dma::otc), ram.words()[0] & 0xffff);
    dma.write(ot::dma::chcr(ot::dma::otc), 0x11000002);
    dma.run(port, budget);
  }
  dma.write(ot::dma::madr(ot::dma::gpu), first);
  dma.write(ot::dma::bcr(ot::dma::gpu), ram.words()[1]);
  dma.write(ot::dma::chcr(ot::dma::gpu), 0x01000401);
  dma.run(port, budget);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 12) return 0;
  std::uint32_t head = 0;
  std::memcpy(&head, data, sizeof head);
  const std::uint32_t first = head & 0xffffff;
  static ot::MainRam ram(ot::RamSize::mib2);  // behind the copies lies what earlier inputs left
  const std::size_t words = std::min<std::size_t>((size - 4) / 4, 4096);
  for (std::size_t at = 0; at < 2 * words; ++at) std::memcpy(&ram.words()[at], data + 4 + at % words * 4, 4);
  static gpu::Gpu gpu;
  gpu.gp1(0);
  if ((head >> 24 & 1) != 0) {
    send_by_registers(ram, gpu, first, (head >> 25 & 1) != 0);
    return 0;
  }
  std::uint64_t sent = 0;
  const auto result = ot::walk(ram, first, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    sent += payload.size();
    if (sent < budget) gpu.gp0(payload);
  });
  if (!result) (void)result.message();
  return 0;
}
