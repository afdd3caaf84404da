// Any words drawn on an accurate target. The first four bytes choose its options; every other word is GP0's.

#include "gpu/canvas/canvas.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "gpu/canvas/sample_pattern.h"
#include "gpu/gpu.h"

namespace {

gpu::canvas::Options options(const std::uint8_t* byte) {
  gpu::canvas::Options o;
  o.width = 1 + byte[0] % 32;
  o.height = 32;
  o.scale = 1 << (byte[0] >> 6);
  o.fraction_bits = std::array{0, 2, 4, 8}[byte[1] & 3];
  o.perspective = (byte[1] & 4) != 0;
  o.filter = static_cast<gpu::canvas::Filter>(byte[1] >> 3 & 3);
  o.colour = static_cast<gpu::canvas::Colour>(byte[1] >> 5 & 1);
  o.trace = (byte[1] & 0x40) != 0;
  if ((byte[1] & 0x80) != 0) o.fog = gpu::canvas::Fog{128, 128, 160, 1, 60'000};
  if ((byte[2] & 1) != 0) {
    o.depth = gpu::DepthOptions{.format = static_cast<gpu::DepthFormat>(byte[2] >> 1 & 3),
                                .mapping = static_cast<gpu::DepthMapping>(byte[2] >> 3 & 1),
                                .test = static_cast<gpu::DepthTest>(byte[2] >> 4 & 1),
                                .reversed = (byte[2] & 0x20) != 0,
                                .near_z = (byte[2] & 0x40) != 0 ? 1e-3 : 16,
                                .far_z = (byte[2] & 0x40) != 0 ? 1e6 : 65'535};
  }
  switch (byte[3] & 7) {
    case 1:
      o.samples = gpu::canvas::rotated_grid(2 + byte[3] / 8 % 7);
      break;
    case 2:
      o.layers = gpu::canvas::regular_grid(2);
      break;
    case 3:
      o.layers = gpu::canvas::random_samples(3);
      break;
    case 4:
      o.temporal = true;
      break;
    default:
      break;
  }
  return o;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 4) return 0;
  static gpu::Gpu gpu;  // its pixels are what earlier inputs left: a new one takes longer than the input
  gpu.gp1(0);
  gpu.set_canvas(options(data));
  gpu.begin_frame();
  for (std::size_t at = 4; at + 4 <= size; at += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, data + at, sizeof word);
    gpu.gp0(word);
  }
  (void)gpu.end_frame();
  return 0;
}
