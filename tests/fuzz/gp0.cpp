// Any words on both ports: bit 0 of the first byte asks for the z-buffer, bit 1 for a trace, bit 2 for its
// history; then every word is preceded by a byte that chooses GP0, GP1 or a read.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "gpu/gpu.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // One GPU for all inputs, put back by hand: to make one takes as long as to draw the whole input.
  static gpu::Gpu gpu;
  static gpu::Trace trace;
  gpu.gp1(0);
  std::memset(gpu.vram().pixels().data(), 0, gpu.vram().pixels().size_bytes());
  const bool has_depth = (data[0] & 1) != 0;  // begin_frame empties a plane that is there already
  if (has_depth != (gpu.depth_plane() != nullptr)) {
    gpu.set_depth(has_depth ? std::optional(gpu::DepthOptions{}) : std::nullopt);
  }
  trace.draws.clear();
  trace.history.clear();
  trace.keep_history = (data[0] & 4) != 0 && size < 64;  // a large fill makes half a million events
  gpu.set_trace((data[0] & 2) != 0 ? &trace : nullptr);
  gpu.begin_frame();
  for (std::size_t at = 1; at + 5 <= size; at += 5) {
    std::uint32_t word = 0;
    std::memcpy(&word, data + at + 1, sizeof word);
    const auto port = data[at] & 7;
    if (port == 6) {
      gpu.gp1(word);
    } else if (port == 7) {
      (void)gpu.read();
    } else {
      gpu.gp0(word);
    }
  }
  (void)gpu.end_frame();
  (void)gpu.status();
  return 0;
}
