// Many GPUs, a thread each: what they share is constant. The same file is a program of its own under
// ThreadSanitizer
// (./run test-long).

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>
#include <vector>

#include "gpu/gpu.h"

TEST_SUITE("gpu") {
  TEST_CASE("Four GPUs that begin to draw in four threads at once draw the same picture") {
    const std::vector<std::uint32_t> words{
        0xe3000000, 0xe407ffff,  // the drawing area: all of VRAM
        0x300000ff, 0x00000000, 0x0000ff00, 0x00000040, 0x00ff0000, 0x00400000,  // a Gouraud triangle
        0x62808080, 0x00100010, 0x00200020};  // a semi-transparent rectangle
    std::array<gpu::Gpu, 4> gpus;
    {
      std::vector<std::jthread> threads;
      for (gpu::Gpu& gpu : gpus) threads.emplace_back([&gpu, &words] { gpu.gp0(words); });
    }
    CHECK(gpus[0].vram().pixels()[0] != 0);  // the triangle's corner is red
    for (const gpu::Gpu& gpu : gpus) {
      CHECK(std::equal(gpu.vram().pixels().begin(), gpu.vram().pixels().end(),
                       gpus[0].vram().pixels().begin()));
    }
  }
}
