// What happens at the borders of VRAM and of registers, each by hand.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t irq = 1U << 24;  // of GPUSTAT

/// A drawing area over everything that an area can name: 1,024 rows, of which VRAM has half.
const Words all_rows{0xe3000000, 0xe4000000 | 1023U << 10 | 1023U, 0xe5000000};

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE(
      "A rectangle that reaches row 512 and beyond goes on at row 0, plain, watched or half-transparent") {
    for (const std::uint32_t height : {12U, 13U, 40U}) {
      const Words plain{0x60ffffff, 500U << 16 | 8, height << 16 | 64};
      const auto expected = [&](int x, int y) {
        const bool is_row = y >= 500 || y < static_cast<int>(height) - 12;
        return is_row && x >= 8 && x < 72 ? 0x7fff : 0;
      };
      for (const bool is_watched : {false, true}) {
        const auto gpu = std::make_unique<gpu::Gpu>();
        gpu::Trace trace;
        if (is_watched) gpu->set_trace(&trace);
        gpu->gp0(all_rows);
        gpu->gp0(plain);
        int wrong = 0;
        for (int y = 0; y < 512; ++y) {
          for (int x = 0; x < 1024; ++x) wrong += gpu->vram().at(x, y) != expected(x, y) ? 1 : 0;
        }
        CAPTURE(height);
        CHECK(wrong == 0);
      }
    }
  }

  TEST_CASE("GP1(00h) and GP1(02h) take the interrupt flag back, GP1(01h) does not") {
    for (const auto& row : {std::pair{0x00000000U, false}, {0x01000000U, true}, {0x02000000U, false}}) {
      const std::uint32_t word = row.first;
      const bool stays = row.second;
      gpu::Gpu gpu;
      gpu.gp0(0x1f000000);
      REQUIRE((gpu.status() & irq) != 0);
      gpu.gp1(word);
      CAPTURE(word);
      CHECK(((gpu.status() & irq) != 0) == stays);
    }
  }

  TEST_CASE("The display may start in any of 512 rows and 1,024 columns") {
    for (const auto& row : {std::pair{0U, 255U}, {0U, 256U}, {1023U, 511U}, {640U, 300U}}) {
      const auto x = row.first;
      const auto y = row.second;
      gpu::Gpu gpu;
      gpu.gp1(0x05000000 | y << 10 | x);
      CHECK(gpu.display().start_x() == static_cast<int>(x));
      CHECK(gpu.display().start_y() == static_cast<int>(y));
    }
  }
}
