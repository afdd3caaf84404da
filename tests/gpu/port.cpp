// GP0 and GP1 as a program sees them: words, status, readback.

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "gpu/gpu.h"
#include "random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;

std::unique_ptr<gpu::Gpu> fresh() {
  auto gpu = std::make_unique<gpu::Gpu>();
  gpu->gp0(Words{0xe3000000, 0xe4000000 | 1023 | 511 << 10});
  return gpu;
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("GPUSTAT after a reset is 14802000h") {
    gpu::Gpu gpu;
    CHECK(gpu.status() == 0x14802000);
    gpu.gp0(Words{0xe1000fff, 0xe6000003});
    gpu.gp1(0x08000041);
    gpu.gp1(0);
    CHECK(gpu.status() == 0x14802000);
  }

  TEST_CASE("GPUSTAT shows the draw mode, the mask bits and the display mode") {
    gpu::Gpu gpu;
    gpu.gp0(Words{0xe10007ff, 0xe6000003});
    CHECK((gpu.status() & 0x1fff) == 0x1fff);
    gpu.gp1(0x080000ff);
    CHECK((gpu.status() >> 14 & 1) == 1);
    CHECK((gpu.status() >> 16 & 0x7f) == 0x7f);
    gpu.gp1(0x03000000);
    CHECK((gpu.status() >> 23 & 1) == 0);
  }

  TEST_CASE("Draw-mode bit 11 is stored only while GP1(09h) allows it, and stays until the next write") {
    gpu::Gpu gpu;
    gpu.gp0(0xe1000800);
    CHECK((gpu.status() >> 15 & 1) == 0);
    gpu.gp1(0x09000001);
    gpu.gp0(0xe1000800);
    CHECK((gpu.status() >> 15 & 1) == 1);
    gpu.gp1(0x09000000);
    CHECK((gpu.status() >> 15 & 1) == 1);
    gpu.gp0(0xe1000800);
    CHECK((gpu.status() >> 15 & 1) == 0);
  }

  TEST_CASE("The page of a textured polygon stays in force; a sprite leaves the draw mode alone") {
    const auto gpu = fresh();
    gpu->gp0(Words{0xe1003600, 0x24ffffff, 0, 0, 1, 0x09ff0000, 2, 0});
    CHECK(gpu->state().draw_mode == (0x3600 | 0x1ff));
    gpu->gp0(Words{0x6cffffff, 0, 0xffff0000});
    CHECK(gpu->state().draw_mode == (0x3600 | 0x1ff));
  }

  TEST_CASE("DMA request follows the direction: off, FIFO, CPU to GP0, GPUREAD to CPU") {
    gpu::Gpu gpu;
    const auto request = [&](std::uint32_t direction) {
      gpu.gp1(0x04000000 | direction);
      return gpu.status() >> 25 & 1;
    };
    CHECK(request(0) == 0);
    CHECK(request(1) == 1);
    CHECK(request(2) == 1);
    CHECK(request(3) == 0);
    gpu.gp0(Words{0xc0000000, 0, 0x00010002});
    CHECK(request(3) == 1);
    CHECK((gpu.status() >> 27 & 1) == 1);
    gpu.read();
    CHECK((gpu.status() >> 27 & 1) == 0);
    CHECK(request(3) == 0);
  }

  TEST_CASE("GP1(10h) latches registers into GPUREAD and leaves it alone for other numbers") {
    gpu::Gpu gpu;
    gpu.gp0(Words{0xe20abcde, 0xe3012345, 0xe4054321, 0xe51a2b3c});
    const auto latch = [&](std::uint32_t number) {
      gpu.gp1(0x10000000 | number);
      return gpu.read();
    };
    CHECK(latch(2) == 0xabcde);
    CHECK(latch(3) == 0x12345);
    CHECK(latch(4) == 0x54321);
    CHECK(latch(5) == 0x1a2b3c);
    CHECK(latch(7) == 2);
    CHECK(latch(9) == 2);
    CHECK(latch(8) == 0);
  }

  TEST_CASE("GP0(1Fh) raises the interrupt flag, GP1(02h) clears it") {
    gpu::Gpu gpu;
    gpu.gp0(0x1f000000);
    CHECK((gpu.status() >> 24 & 1) == 1);
    gpu.gp1(0x02000000);
    CHECK((gpu.status() >> 24 & 1) == 0);
  }

  TEST_CASE("An upload and a download wrap at both edges and keep the order of pixels") {
    const auto gpu = fresh();
    gpu->gp0(Words{0xa0000000, 1023 | 511 << 16, 3 | 2 << 16, 0x00020001, 0x00040003, 0x00060005});
    CHECK(gpu->vram().at(1023, 511) == 1);
    CHECK(gpu->vram().at(0, 511) == 2);
    CHECK(gpu->vram().at(1, 511) == 3);
    CHECK(gpu->vram().at(1023, 0) == 4);
    CHECK(gpu->vram().at(1, 0) == 6);
    gpu->gp0(Words{0xc0000000, 1023 | 511 << 16, 3 | 2 << 16});
    CHECK(gpu->read() == 0x00020001);
    CHECK(gpu->read() == 0x00040003);
    CHECK(gpu->read() == 0x00060005);
  }

  TEST_CASE("An odd number of uploaded pixels leaves the last half word unused") {
    const auto gpu = fresh();
    gpu->gp0(Words{0xa0000000, 0, 1 | 1 << 16, 0x12345678, 0x68ffffff, 5});
    CHECK(gpu->vram().at(0, 0) == 0x5678);
    CHECK(gpu->vram().at(1, 0) == 0);
    CHECK(gpu->vram().at(5, 0) == 0x7fff);
  }

  TEST_CASE("Upload and copy respect and set mask bits") {
    const auto gpu = fresh();
    gpu->vram().at(1, 0) = 0x8000;
    gpu->gp0(Words{0xe6000003, 0xa0000000, 0, 2 | 1 << 16, 0x00020001});
    CHECK(gpu->vram().at(0, 0) == 0x8001);
    CHECK(gpu->vram().at(1, 0) == 0x8000);
    gpu->gp0(Words{0x80000000, 0, 4, 1 | 1 << 16});
    CHECK(gpu->vram().at(4, 0) == 0x8001);
  }

  TEST_CASE("GP1(01h) drops a half-sent command, an upload and an open polyline") {
    const auto gpu = fresh();
    gpu->gp0(Words{0x20ffffff, 0});
    CHECK((gpu->status() >> 26 & 1) == 0);
    gpu->gp1(0x01000000);
    CHECK((gpu->status() >> 26 & 1) == 1);
    gpu->gp0(Words{0xa0000000, 0, 64 | 64 << 16, 0x11111111});
    gpu->gp1(0x01000000);
    gpu->gp0(Words{0x48ffffff, 9, 10});
    gpu->gp1(0x01000000);
    gpu->gp0(Words{0x68ffffff, 20});
    CHECK(gpu->vram().at(20, 0) == 0x7fff);
  }

  TEST_CASE("Split anywhere, the same words draw the same picture") {
    tests::RandomWords random(99);
    Words words;
    random.state(words);
    for (int i = 0; i < 800; ++i) random.command(words);
    const auto whole = fresh(), pieces = fresh();
    whole->gp0(words);
    for (std::size_t at = 0; at < words.size();) {
      const auto count = std::min<std::size_t>(1 + random.below(9), words.size() - at);
      pieces->gp0(std::span(words).subspan(at, count));
      at += count;
    }
    CHECK(std::equal(whole->vram().pixels().begin(), whole->vram().pixels().end(),
                     pieces->vram().pixels().begin()));
  }

  TEST_CASE("A palette is loaded when its name or a larger depth asks for it, not when VRAM changes") {
    const auto gpu = fresh();
    const auto draw = [&](std::uint32_t format, int x) {
      gpu->gp0(Words{0xe1000000 | 10 | format << 7, 0x6dffffff, static_cast<std::uint32_t>(x), 0x7d00 << 16});
      return gpu->vram().at(x, 0);
    };
    gpu->vram().at(0, 500) = 0x1111;
    CHECK(draw(0, 20) == 0x1111);
    gpu->vram().at(0, 500) = 0x2222;
    CHECK(draw(0, 21) == 0x1111);  // the cache still holds it
    CHECK(draw(1, 22) == 0x2222);  // 8-bit needs all 256
    gpu->vram().at(0, 500) = 0x3333;
    CHECK(draw(0, 23) == 0x2222);  // 256 entries serve 16
    gpu->gp0(0x01000000);
    CHECK(draw(0, 24) == 0x3333);
  }

  TEST_CASE(
      "Rows of the field on screen are skipped in an interlaced 480-line mode unless E1h bit 10 allows "
      "them") {
    const auto gpu = fresh();
    gpu->gp1(0x08000024);
    const auto filled = [&](int y) { return gpu->vram().at(100, y) != 0; };
    gpu->gp0(Words{0x60ffffff, 100, 4 | 4 << 16});
    CHECK_FALSE(filled(0));
    CHECK(filled(1));
    gpu->next_field();
    gpu->gp0(Words{0x02ffffff, 96, 16 | 4 << 16});
    CHECK(filled(0));
    gpu->gp0(Words{0xe1000400, 0x60ffffff, 100 | 8 << 16, 4 | 2 << 16});
    CHECK(filled(8));
    CHECK(filled(9));
  }

  TEST_CASE("An upload that is open when a trace begins anew goes on as the first draw of the new one") {
    gpu::Gpu gpu;
    gpu::Trace trace;
    trace.keep_history = true;
    gpu.set_trace(&trace);
    gpu.gp0(std::vector<std::uint32_t>{0x02000000, 0,
                                       0x00010010});  // a draw before, so that the upload is number 1
    gpu.gp0(std::vector<std::uint32_t>{0xa0000000, 0, 0x00010004, 0x00020001});
    trace.clear();
    gpu.gp0(std::vector<std::uint32_t>{0x00040003});
    REQUIRE(trace.draws.size() == 1);
    CHECK(trace.draws[0].kind == gpu::Kind::upload);
    CHECK(trace.last_writer[1] == 0);  // written before the trace began
    CHECK(trace.last_writer[2] == 1);
    REQUIRE(trace.history.size() == 2);
    CHECK(trace.history[1].draw == 0);
  }

  TEST_CASE("Any words whatever leave the GPU standing") {
    tests::RandomWords random(1234);
    const auto gpu = std::make_unique<gpu::Gpu>();
    for (int round = 0; round < 60; ++round) {
      if (round == 30) gpu->set_depth(gpu::DepthOptions{});
      Words words;
      for (int i = 0; i < 2000; ++i) {
        // Mostly short commands: an upload or a polyline that never ends would swallow the rest.
        const std::uint32_t word = random.word();
        words.push_back((word >> 29) == 5 && random.below(50) != 0 ? word ^ 0x80000000 : word);
      }
      gpu->gp0(words);
      gpu->end_frame();
      for (int i = 0; i < 4; ++i) gpu->gp1(random.word() & 0x3fffffff & ~(random.coin() ? 0x3e000000U : 0U));
      gpu->gp1(0x01000000);
      gpu->read();
    }
    CHECK(gpu->counters().words == 60 * 2000);
  }
}
