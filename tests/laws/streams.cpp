// The GPU and a stream of words: how the words come does not matter.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "generate.h"
#include "gpu/gpu.h"

namespace {

using laws::Words;

bool same_vram(const gpu::Gpu& a, const gpu::Gpu& b) {
  return std::ranges::equal(a.vram().pixels(), b.vram().pixels());
}

/// The stream in calls of the given sizes, again and again.
void send(gpu::Gpu& gpu, const Words& words, const std::vector<std::size_t>& sizes) {
  std::size_t at = 0;
  for (std::size_t n = 0; at < words.size(); ++n) {
    const std::size_t size = sizes.empty() ? words.size() : 1 + sizes[n % sizes.size()] % 40;
    const std::size_t count = std::min(size, words.size() - at);
    gpu.gp0(std::span(words).subspan(at, count));
    at += count;
  }
}

}  // namespace

TEST_SUITE("laws") {
  TEST_CASE("Any split of a stream into calls gives equal VRAM, state and counters") {
    CHECK(rc::check([](const std::vector<std::size_t>& sizes) {
      const Words words = *laws::stream();
      const auto whole = std::make_unique<gpu::Gpu>(), split = std::make_unique<gpu::Gpu>();
      whole->gp0(words);
      send(*split, words, sizes);
      RC_ASSERT(same_vram(*whole, *split));
      RC_ASSERT(whole->status() == split->status());
      RC_ASSERT(whole->counters().words == split->counters().words);
      RC_ASSERT(whole->counters().primitives == split->counters().primitives);
    }));
  }

  TEST_CASE(
      "Who watches changes nothing: with a trace, without one, and with one that begins anew anywhere") {
    CHECK(rc::check([](const std::vector<std::size_t>& sizes, bool keeps_history) {
      const Words words = *laws::stream();
      const std::size_t cut = *rc::gen::inRange<std::size_t>(0, words.size());
      const auto plain = std::make_unique<gpu::Gpu>(), watched = std::make_unique<gpu::Gpu>();
      plain->gp0(words);
      gpu::Trace trace;
      trace.keep_history = keeps_history;
      watched->set_trace(&trace);
      send(*watched, {words.begin(), words.begin() + static_cast<std::ptrdiff_t>(cut)}, sizes);
      trace.clear();
      send(*watched, {words.begin() + static_cast<std::ptrdiff_t>(cut), words.end()}, sizes);
      RC_ASSERT(same_vram(*plain, *watched));
      RC_ASSERT(trace.draws.size() == trace.written.size());
      RC_ASSERT(
          std::ranges::all_of(trace.history, [&](const auto& e) { return e.draw < trace.draws.size(); }));
      RC_ASSERT(std::ranges::all_of(trace.last_writer, [&](auto w) { return w <= trace.draws.size(); }));
    }));
  }

  TEST_CASE("VRAM and drawing state carried over to another GPU go on equal") {
    CHECK(rc::check([] {
      const Words first = *laws::stream(), second = *laws::stream();
      const auto one = std::make_unique<gpu::Gpu>(), other = std::make_unique<gpu::Gpu>();
      one->gp0(first);
      one->gp1(0x01000000);  // what is still open is forgotten
      const auto& state = one->state();
      other->gp1(0);
      for (const std::uint32_t word :
           {0xe1000000 | (state.draw_mode & 0x37ff), 0xe2000000 | state.texture_window,
            0xe3000000 | state.area_top_left, 0xe4000000 | state.area_bottom_right, 0xe5000000 | state.offset,
            0xe6000000 | state.mask}) {
        other->gp0(word);
      }
      std::ranges::copy(one->vram().pixels(), other->vram().pixels().begin());
      for (auto* gpu : {one.get(), other.get()}) {
        gpu->gp0(0x01000000);  // the palette is read again
        gpu->gp0(second);
      }
      RC_ASSERT(same_vram(*one, *other));
    }));
  }
}
