// Commands that lie across the border of two frames: the trace of the second one begins in the middle of
// them.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>

#include "gpu/gpu.h"
#include "inspect/history.h"
#include "inspect/json.h"
#include "inspect/maps.h"
#include "inspect/report.h"
#include "tests/gpu/random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t whole_vram[] = {0xe3000000, 0xe407ffff, 0xe5000000};

/// Everything that looks at a frame, as the program's `inspect` does with every option.
void observe(const gpu::Trace& trace, const gpu::Gpu& gpu, inspect::Order order) {
  const auto report = inspect::inspect(trace, {.order = order});
  (void)inspect::to_json(report);
  (void)inspect::to_text(report);
  (void)inspect::heatmap(report, gpu.vram().pixels());
  (void)inspect::overdraw(report, trace);
  (void)inspect::ids(report, trace);
  (void)inspect::truth_image(report, trace, gpu.vram().pixels());
  (void)inspect::depth_image(report, trace);
  (void)inspect::pixel_history(report, trace, report.picture.width / 2, report.picture.height / 2);
}

/// What a trace must be, whatever was drawn: numbers of draws that it has, and as many writes as it counts.
bool is_whole(const gpu::Trace& trace) {
  const auto known = [&](const gpu::Event& event) { return event.draw < trace.draws.size(); };
  if (!std::ranges::all_of(trace.history, known)) return false;
  if (std::ranges::any_of(trace.last_writer, [&](std::uint32_t w) { return w > trace.draws.size(); }))
    return false;
  const auto writes = std::ranges::count_if(trace.history, [](const gpu::Event& e) { return !e.rejected; });
  return trace.written.size() == trace.draws.size() &&
         std::accumulate(trace.written.begin(), trace.written.end(), std::uint64_t{0}) ==
             static_cast<std::uint64_t>(writes);
}

Words every_kind(tests::RandomWords& random, bool with_depth) {
  Words words;
  random.state(words);
  random.place(60);
  for (const std::uint32_t opcode : {0x20U, 0x2aU, 0x34U, 0x3eU}) random.polygon(words, opcode, with_depth);
  const Words rest{0x48ffffff, 0x00010001, 0x00200010, 0x00010030, 0x55555555,  // flat polyline
                   0x5a0000ff, 0x00050005, 0x0000ff00, 0x00100040, 0x00ff0000, 0x00400010, 0x55555555,
                   0xa0000000, 0x00020003, 0x00030005, 1,          2,          3,          4,
                   5,          6,          7,          8,  // upload
                   0x80000000, 0x00000000, 0x00400040, 0x00100010, 0x02123456, 0x60,       0x00100010};
  words.insert(words.end(), rest.begin(), rest.end());
  return words;
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("Frames may begin after any word: traces are whole, every observer ends, VRAM is as ever") {
    tests::RandomWords random(19);
    for (const bool has_depth : {false, true}) {
      const Words words = every_kind(random, has_depth);
      const auto depth = has_depth ? std::optional(gpu::DepthOptions{}) : std::nullopt;
      const auto order = has_depth ? inspect::Order::depth : inspect::Order::list;
      const auto plain = std::make_unique<gpu::Gpu>();
      plain->set_depth(depth);
      plain->begin_frame();
      plain->gp0(whole_vram);
      plain->gp0(words);
      (void)plain->end_frame();
      for (std::size_t cut = 0; cut <= words.size(); ++cut) {
        const auto gpu = std::make_unique<gpu::Gpu>();
        gpu::Trace trace;
        trace.keep_history = true;
        gpu->set_depth(depth);
        gpu->begin_frame();
        gpu->gp0(whole_vram);
        // The one half of the cuts: the first frame is not watched. The other: its trace begins anew.
        if (cut % 2 == 0) gpu->set_trace(&trace);
        gpu->gp0(std::span(words).first(cut));
        CHECK(is_whole(trace));
        trace.clear();
        gpu->set_trace(&trace);
        gpu->gp0(std::span(words).subspan(cut));
        (void)gpu->end_frame();
        CAPTURE(cut);
        REQUIRE(is_whole(trace));
        if (cut % 7 == 0) observe(trace, *gpu, order);
        REQUIRE(std::ranges::equal(gpu->vram().pixels(), plain->vram().pixels()));
      }
    }
  }

  TEST_CASE("Semi-transparent polygons queued before a trace began anew are draws of the new one") {
    gpu::Gpu gpu;
    gpu::Trace trace;
    trace.keep_history = true;
    gpu.set_depth(gpu::DepthOptions{});
    gpu.set_trace(&trace);
    gpu.begin_frame();
    gpu.gp0(whole_vram);
    const Words glass{0xe8100000, 0xe9100000, 0xea100000, 0x22ffffff, 0, 8, 0x00080000};
    gpu.gp0(glass);
    trace.clear();
    (void)gpu.end_frame();
    REQUIRE(trace.draws.size() == 1);
    CHECK(trace.draws[0].command == 0x22ffffff);
    CHECK(trace.written[0] == 36);  // 8 + 7 + ... + 1 pixels: the hypotenuse is not covered
    CHECK(is_whole(trace));
  }

  TEST_CASE("A trace whose allowance is used up is full, says what it could hold, and stays within it") {
    gpu::Gpu gpu;
    gpu::Trace trace;
    trace.keep_history = true;
    trace.allowance = gpu::Trace::draw_cost * 4 + gpu::Trace::event_cost * 1000;
    trace.clear();
    gpu.set_trace(&trace);
    const Words small{0x02ffffff, 0, 0x00010010};  // 16 pixels
    gpu.gp0(small);
    CHECK_FALSE(trace.is_full);
    for (int i = 0; i < 100; ++i) gpu.gp0(small);
    CHECK(trace.is_full);
    CHECK(trace.draws.size() * gpu::Trace::draw_cost + trace.history.size() * gpu::Trace::event_cost <=
          static_cast<std::size_t>(trace.allowance));
    CHECK(trace.limit_text().find("pixel events") != std::string::npos);
    trace.clear();
    CHECK_FALSE(trace.is_full);
  }
}
