// Saved states: a GPU that is loaded goes on as the one that was saved.

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "dump/dump.h"
#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "random_words.h"
#include "tests/vectors.h"

namespace {

using Words = std::vector<std::uint32_t>;
using Bytes = std::vector<std::byte>;

std::unique_ptr<gpu::Gpu> fresh() { return std::make_unique<gpu::Gpu>(); }

std::unique_ptr<gpu::Gpu> loaded(const Bytes& state, const std::optional<gpu::DepthOptions>& depth = {}) {
  auto gpu = fresh();
  if (depth) gpu->set_depth(depth);
  REQUIRE_FALSE(gpu->load(state));
  return gpu;
}

bool same_picture(const gpu::Gpu& a, const gpu::Gpu& b) {
  return std::ranges::equal(a.vram().pixels(), b.vram().pixels());
}

/// All that both ports and the picture show; what is open shows in what comes next.
bool same(gpu::Gpu& a, gpu::Gpu& b) {
  return same_picture(a, b) && a.status() == b.status() && a.read() == b.read() && a.save() == b.save();
}

/// Both GPUs are sent the same and must stay equal.
void check_goes_on(gpu::Gpu& a, gpu::Gpu& b, const Words& words) {
  a.gp0(words);
  b.gp0(words);
  CHECK(same(a, b));
}

Words everything(std::uint32_t seed, int commands, bool depth = false) {
  tests::RandomWords random(seed);
  Words words;
  random.state(words);
  for (int i = 0; i < commands; ++i) random.command(words, depth);
  return words;
}

Bytes with_word(Bytes bytes, std::size_t at, std::uint32_t word) {
  for (std::size_t n = 0; n < 4; ++n) bytes[at + n] = static_cast<std::byte>(word >> 8 * n & 0xff);
  return bytes;
}

/// Replays packets one by one; at every `every`-th word of the two ports the GPU is replaced by one that was
/// loaded from it.
std::unique_ptr<gpu::Gpu> replay_with_loads(const dump::Dump& recorded, std::size_t every) {
  auto gpu = fresh();
  std::size_t until_load = every;
  const auto count = [&] {
    if (--until_load != 0) return;
    gpu = loaded(gpu->save());
    until_load = every;
  };
  for (const dump::Packet& packet : recorded.packets) {
    const auto words = recorded.payload(packet);
    if (packet.type == dump::PacketType::port0) {
      for (const auto word : words) gpu->gp0(word), count();
    } else if (packet.type == dump::PacketType::port1) {
      for (const auto word : words) gpu->gp1(word), count();
    } else if (packet.type == dump::PacketType::discard || packet.type == dump::PacketType::readback) {
      for (std::uint32_t n = 0; n < words[0]; ++n) gpu->read();
    } else if (packet.type == dump::PacketType::vsync) {
      gpu->next_field();
    }
  }
  return gpu;
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("A state that is loaded is saved as the same bytes") {
    const auto a = fresh();
    a->gp0(everything(1, 200));
    a->gp1(0x08000024);
    a->next_field();
    CHECK(loaded(a->save())->save() == a->save());
  }

  TEST_CASE("Cut at any word, a state goes on where it was saved") {
    const Words words = everything(2, 60);
    const auto straight = fresh();
    for (std::size_t at = 0; at < words.size(); ++at) {
      straight->gp0(words[at]);
      if (at % 3 != 0 && at > 300) continue;
      const auto other = loaded(straight->save());
      const auto next = std::span(words).subspan(at + 1, std::min<std::size_t>(12, words.size() - at - 1));
      const auto go_on = loaded(straight->save());
      go_on->gp0(next);
      other->gp0(next);
      CHECK(same(*go_on, *other));
    }
  }

  TEST_CASE("A GPU that is replaced by its saved state at every word draws what one alone draws") {
    const Words words = everything(3, 40);
    const auto alone = fresh();
    alone->gp0(words);
    auto replaced = fresh();
    for (const auto word : words) {
      replaced->gp0(word);
      replaced = loaded(replaced->save());
    }
    CHECK(same(*alone, *replaced));
  }

  TEST_CASE("Dumps go on equal from states saved on the way") {
    for (const char* name :
         {"gpu/random-mix400-01.psxgpu", "gpu/hw-quad.psxgpu", "field/copy-overlap.psxgpu"}) {
      CAPTURE(name);
      const auto path = tests::vector_path(name);
      if (!path) continue;
      std::ifstream file(*path, std::ios::binary);
      const std::vector<char> chars{std::istreambuf_iterator<char>(file), {}};
      const auto recorded = dump::parse_dump(std::as_bytes(std::span(chars)));
      REQUIRE(recorded);
      const auto alone = fresh();
      dump::replay(*recorded.value, *alone);
      CHECK(same_picture(*alone, *replay_with_loads(*recorded.value, 97)));
      CHECK(same_picture(*alone, *replay_with_loads(*recorded.value, 1009)));
    }
  }

  TEST_CASE("The palette that the cache holds is kept, not read again from VRAM") {
    const auto a = fresh();
    a->gp0(Words{0xe3000000, 0xe407ffff, 0xe100000a});
    a->vram().at(0, 500) = 0x1111;
    a->gp0(Words{0x6dffffff, 20, 0x7d00U << 16});
    a->vram().at(0, 500) = 0x2222;
    const auto b = loaded(a->save());
    check_goes_on(*a, *b, {0x6dffffff, 21, 0x7d00U << 16});
    CHECK(b->vram().at(21, 0) == 0x1111);
  }

  TEST_CASE("Transfers that are open both ways go on") {
    const auto a = fresh();
    a->vram().at(5, 3) = 0x7abc;
    a->gp0(
        Words{0xc0000000, 4 | 3 << 16, 3 | 2 << 16, 0xa0000000, 1000 | 500 << 16, 5 | 2 << 16, 0x22221111});
    CHECK(a->read() == 0x7abc0000);
    const auto b = loaded(a->save());
    CHECK(b->read() == a->read());
    check_goes_on(*a, *b, {0x44443333, 0x66665555});
    CHECK(b->vram().at(1001, 500) == 0x2222);
    CHECK(b->vram().at(1000, 501) == 0x6666);
  }

  TEST_CASE("An annotation that waits for its polygon is kept") {
    const auto a = fresh();
    a->set_depth(gpu::DepthOptions{});
    a->gp0(Words{0xe3000000, 0xe407ffff, 0xe8064000, 0xe9064000, 0xea064000});
    const auto b = loaded(a->save(), gpu::DepthOptions{});
    check_goes_on(*a, *b, {0x20ffffff, 0, 8, 8 << 16});
    CHECK_FALSE(b->depth_plane()->is_empty(1, 1));
  }

  TEST_CASE("A z-buffered frame goes on with its plane and its queue") {
    const gpu::DepthOptions options;
    const Words words = everything(4, 120, true);
    const auto a = fresh();
    a->set_depth(options);
    a->gp0(std::span(words).first(words.size() / 2));
    const auto b = loaded(a->save(), options);
    check_goes_on(*a, *b, {words.begin() + static_cast<std::ptrdiff_t>(words.size() / 2), words.end()});
    CHECK(a->end_frame().queued == b->end_frame().queued);
    CHECK(same(*a, *b));
  }

  TEST_CASE("Without a z-buffer, the polygons that waited for its second pass are drawn at once") {
    const auto a = fresh();
    a->set_depth(gpu::DepthOptions{});
    a->gp0(Words{0xe3000000, 0xe407ffff, 0xe8064000, 0xe9064000, 0xea064000, 0x22ffffff, 0, 8, 8 << 16});
    CHECK(a->vram().at(1, 1) == 0);
    const auto b = loaded(a->save());
    CHECK(b->vram().at(1, 1) == 0x3def);  // the average of white and black
    CHECK(b->queue_bytes() == 0);
  }

  TEST_CASE("With another depth format the plane begins empty") {
    const auto a = fresh();
    a->set_depth(gpu::DepthOptions{});
    a->gp0(Words{0xe3000000, 0xe407ffff, 0xe8064000, 0xe9064000, 0xea064000, 0x20ffffff, 0, 8, 8 << 16});
    CHECK_FALSE(a->depth_plane()->is_empty(1, 1));
    const gpu::DepthOptions other{.format = gpu::DepthFormat::bits16};
    CHECK(loaded(a->save(), other)->depth_plane()->is_empty(1, 1));
  }

  TEST_CASE("A canvas shows the picture that was loaded") {
    const auto a = fresh();
    a->vram().at(3, 2) = 31;
    const auto b = fresh();
    b->set_canvas(gpu::canvas::Options{.width = 16, .height = 16, .scale = 2});
    b->canvas()->begin_frame(0, 0);
    REQUIRE_FALSE(b->load(a->save()));
    CHECK((b->canvas()->layer(0)[4 * 32 + 6] & 0xff) == 0xf8);
    CHECK((b->canvas()->layer(0)[4 * 32 + 8] & 0xff) == 0);
  }

  TEST_CASE("What a trace is told after a load belongs to draws that it knows") {
    const auto a = fresh();
    a->set_depth(gpu::DepthOptions{});
    a->gp0(Words{0xe3000000, 0xe407ffff, 0xe8064000, 0xe9064000, 0xea064000, 0x22ffffff, 0, 8, 8 << 16});
    a->gp0(Words{0xa0000000, 100, 2 | 2 << 16, 0});
    gpu::Trace trace;
    const auto b = fresh();
    b->set_depth(gpu::DepthOptions{});
    b->set_trace(&trace);
    REQUIRE_FALSE(b->load(a->save()));
    b->gp0(0x7fff7fff);
    b->end_frame();
    for (const auto writer : trace.last_writer) REQUIRE(writer <= trace.draws.size());
    REQUIRE(trace.last_writer[1024 + 100] != 0);
    CHECK(trace.draws[trace.last_writer[1024 + 100] - 1].kind == gpu::Kind::upload);
  }

  TEST_CASE("States of another version, cut short, too long or of something else are refused with a reason") {
    const auto a = fresh();
    a->gp0(everything(5, 20));
    const Bytes state = a->save();
    const Bytes before = a->save();
    const auto error = [&](const Bytes& bytes) {
      const auto result = a->load(bytes);
      REQUIRE(result);
      CHECK(a->save() == before);
      return result->message;
    };
    const auto size = std::to_string(state.size());
    CHECK(error({}) == "not a saved state: expected OTTER-GPU-STATE");
    CHECK(error(with_word(state, 16, 3)) == "version 3, expected 2");
    CHECK(error({state.begin(), state.begin() + 18}) == "the state ends, expected 4 more bytes");
    CHECK(error({state.begin(), state.end() - 1}) ==
          std::to_string(state.size() - 1) + " bytes, expected " + size);
    Bytes longer = state;
    longer.push_back(std::byte{0});
    CHECK(error(longer) == std::to_string(state.size() + 1) + " bytes, expected " + size);
    CHECK(error(with_word(state, 32, 256)) == "the display mode is 256, expected 0..255");
  }

  TEST_CASE("A state with any word damaged is refused or leaves a GPU that stands") {
    tests::RandomWords random(6);
    const auto a = fresh();
    a->set_depth(gpu::DepthOptions{});
    a->gp0(everything(7, 30, true));
    a->gp0(Words{0x58ffffff, 0, 0xff, 5 | 5 << 16, 0xff00});
    const Bytes state = a->save();
    const std::size_t numbers = (state.size() - 1024 * 512 * 6) / 4;
    const auto b = fresh();
    b->set_depth(gpu::DepthOptions{});
    for (std::size_t n = 0; n < std::min<std::size_t>(numbers, 400); ++n) {
      const std::uint32_t bad = random.coin() ? random.word() : random.below(16);
      if (!b->load(
              with_word(state, 4 * (n < 200 ? n : random.below(static_cast<std::uint32_t>(numbers))), bad)))
        continue;
      b->gp0(everything(8, 6, true));
      b->end_frame();
    }
    CHECK_FALSE(b->load(state));
  }

  TEST_CASE("GPUSTAT bit 31 changes at every vertical blank, and is the field while interlaced") {
    gpu::Gpu gpu;
    const auto bit = [&] { return gpu.status() >> 31; };
    CHECK(bit() == 0);
    gpu.next_field();
    CHECK(bit() == 1);
    gpu.next_field();
    CHECK(bit() == 0);
    gpu.gp1(0x08000024);
    gpu.next_field();
    CHECK(bit() == (gpu.status() >> 13 & 1));
    gpu.next_field();
    CHECK(bit() == (gpu.status() >> 13 & 1));
  }
}
