#include "cost/subject.h"

#include "base/clock.h"
#include "ot/walker.h"
#include "scene/accurate.h"
#include "scene/pipeline.h"

namespace cost {

Subject::Subject(scene::Scene scene, std::uint32_t frame) : scene_(std::move(scene)), frame_(frame) {}

base::Result<Drawn> Subject::draw(const scene::Knobs& knobs) {
  gpu::Gpu& gpu = machine_.gpu();
  auto& build = builder(knobs);
  gpu.set_trace(nullptr);
  machine_.presenter().forget();
  const int before = std::max(1, machine::Presenter::frames_before(knobs));
  base::Result<scene::FrameStats> stats;
  double filter = 0, cpu = 0;
  for (int i = 0; i <= before; ++i) {
    if (gpu.canvas() != nullptr) gpu.canvas()->reset_counters();  // those of the last frame are asked for
    const double cpu_start = base::cpu_ms();
    stats = scene::render_frame(build, seconds(), knobs, machine_.ram(), gpu);
    if (!stats) return tl::make_unexpected(stats.error());
    const double start = base::now_ms();
    machine_.show(knobs);
    filter = base::now_ms() - start;
    cpu = base::cpu_ms() - cpu_start;
  }
  // The walk alone, over the list that is still in RAM.
  auto frame = build.build(seconds(), knobs, machine_.ram());
  if (!frame) return tl::make_unexpected(frame.error());
  std::uint32_t sum = 0;
  const double start = base::now_ms();
  (void)ot::walk(machine_.ram(), frame->head, [&sum](std::uint32_t, std::span<const std::uint32_t> payload) {
    for (auto w : payload) sum += w;
  });
  Drawn drawn;
  drawn.stages.walk = base::now_ms() - start;
  if (sum == 1) drawn.stages.walk += 0;  // the sum is used, so the walk is made
  drawn.stats = *stats;
  drawn.stages.gte = stats->gte_ms;
  drawn.stages.ot = stats->ot_ms;
  drawn.stages.raster = std::max(0.0, stats->raster_ms - drawn.stages.walk);
  drawn.stages.filter = filter;
  drawn.cpu_ms = cpu;
  drawn.history_bytes = machine_.presenter().bytes();
  drawn.held_bytes = stats->ram_bytes + gpu.depth_bytes() + gpu.queue_bytes() + machine_.presenter().bytes();
  if (gpu.canvas() != nullptr) {
    for (const auto& buffer : gpu.canvas()->buffers()) drawn.held_bytes += buffer.bytes;
  } else {
    drawn.held_bytes +=
        static_cast<std::uint64_t>(knobs.width) * static_cast<std::uint64_t>(knobs.height) * 2;
  }
  return drawn;
}

base::Result<void> Subject::trace(const scene::Knobs& knobs, gpu::Trace& trace) {
  gpu::Gpu& gpu = machine_.gpu();
  auto& build = builder(knobs);
  gpu.set_trace(&trace);
  const auto drawn = scene::render_frame(build, seconds(), knobs, machine_.ram(), gpu);
  gpu.set_trace(nullptr);
  if (!drawn) return tl::make_unexpected(drawn.error());
  if (trace.is_full) return base::fail(scene_.name + ": " + trace.limit_text());
  return {};
}

base::Result<void> Subject::trace_console(scene::Knobs knobs, gpu::Trace& to) {
  const scene::Knobs console;
  knobs.position = console.position;
  knobs.texture = console.texture;
  knobs.filter = console.filter;
  return trace_surfaces(knobs, to);
}

base::Result<void> Subject::trace_surfaces(scene::Knobs knobs, gpu::Trace& to) {
  const scene::Knobs console;
  knobs.colour = console.colour;
  knobs.antialias = console.antialias;
  knobs.fog = console.fog;
  knobs.resolution = console.resolution;
  return trace(knobs, to);
}

base::Result<Traced> Subject::trace_canvas(scene::Knobs knobs) {
  gpu::Gpu& gpu = machine_.gpu();
  knobs.antialias = {};
  knobs.resolution = 1;
  knobs.filter = scene::Filter::nearest;
  knobs.colour = scene::Colour::bits24;  // asks for a canvas and changes no coordinate
  const auto& build = builder(knobs);
  auto options = build.plan_of(knobs).canvas;
  options->trace = true;
  gpu.set_canvas(options);  // use_targets keeps the trace of a canvas that has one
  gpu::Trace to;
  const auto traced = trace(knobs, to);
  if (!traced) return tl::make_unexpected(traced.error());
  const auto ids = gpu.canvas()->ids();
  const auto texcoords = gpu.canvas()->texcoords();
  Traced result{{ids.begin(), ids.end()}, {texcoords.begin(), texcoords.end()}, std::move(to.draws)};
  gpu.set_canvas({});
  return result;
}

base::Result<std::vector<std::uint32_t>> Subject::words(const scene::Knobs& knobs) {
  auto& build = builder(knobs);
  auto frame = build.build(seconds(), knobs, machine_.ram());
  if (!frame) return tl::make_unexpected(frame.error());
  std::vector<std::uint32_t> list;
  for (;;) {
    const auto walked =
        ot::walk(machine_.ram(), frame->head, [&list](std::uint32_t, std::span<const std::uint32_t> payload) {
          list.insert(list.end(), payload.begin(), payload.end());
        });
    if (!walked) return base::fail(walked.message(), base::Exit::failed);
    buffer_y_ = frame->buffer_y;
    if (frame->nearer_lists == 0) return list;
    if (auto next = build.next(*frame, machine_.ram()); !next) return tl::make_unexpected(next.error());
  }
}

base::Result<double> Subject::draw_words(const scene::Knobs& knobs, std::span<const std::uint32_t> words) {
  gpu::Gpu& gpu = machine_.gpu();
  gpu.set_trace(nullptr);
  if (auto used = scene::use_targets(builder(knobs).plan_of(knobs), gpu); !used)
    return tl::make_unexpected(used.error());
  gpu.reset_counters();
  if (gpu.canvas() != nullptr) gpu.canvas()->reset_counters();
  const double start = base::now_ms();
  gpu.begin_frame(0, buffer_y_);
  gpu.gp0(words);
  gpu.end_frame();
  return base::now_ms() - start;
}

std::vector<scene::ScreenPolygon> Subject::polygons(const scene::Knobs& knobs) {
  std::vector<scene::ScreenPolygon> list;
  builder(knobs).polygons(seconds(), knobs, list);
  return list;
}

}  // namespace cost
