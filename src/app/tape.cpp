#include "app/tape.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/commands/describe.h"
#include "app/source.h"
#include "gpu/depth.h"
#include "scene/plan.h"

namespace app {

base::Result<void> check_visibility(const scene::Knobs& knobs) {
  const auto visibility = knobs.visibility;
  if (visibility == scene::Visibility::ot || visibility == scene::Visibility::zbuffer) return {};
  return base::fail("visibility " + knob_value(knobs, "visibility") +
                    ": a recording has its own order; expected ot or zbuffer");
}

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

bool overlap(const display::Area& a, int x, int y, int width, int height) {
  return a.x < x + width && x < a.x + a.width && a.y < y + height && y < a.y + a.height;
}

// Knobs that a recording cannot follow: a setting of theirs has no price.
base::Result<void> check_applicable(const scene::Knobs& knobs) {
  static const scene::Knobs console;
  for (const auto& knob : scene::knob_table()) {
    if (applies_to_recordings(knob.name) || knob.get(knobs) == knob.get(console)) continue;
    return base::fail(std::string(knob.name) + ": " + std::string(why_not_for_recordings));
  }
  return check_visibility(knobs);
}

}  // namespace

std::string empty_reason(const gpu::Gpu& gpu, const display::Area& area, std::uint64_t drawn) {
  if (area.width <= 0 || area.height <= 0) {
    return "nothing to show: the display area is empty (" + std::to_string(area.width) + " x " +
           std::to_string(area.height) + " pixels), GP1(06h) and GP1(07h) set it; F3 shows VRAM";
  }
  if (drawn != 0 || !gpu.display().is_off) return {};
  return "nothing to show: the display is off, and the frame draws nothing; F3 shows VRAM";
}

display::Area shown_area(const gpu::Gpu& gpu, Shown shown) {
  auto area = display::area_of(gpu.display());
  area.is_off = false;  // who debugs wants to see it all the same
  const auto& state = gpu.state();
  const int width = state.right() - state.left() + 1, height = state.bottom() - state.top() + 1;
  const bool is_beside = width > 0 && height > 0 && !overlap(area, state.left(), state.top(), width, height);
  if (shown == Shown::display || (shown == Shown::either && !is_beside)) return area;
  if (width <= 0 || height <= 0) return area;
  return {state.left(),
          state.top(),
          std::min(width, std::max(area.width, 1)),
          std::min(height, std::max(area.height, 1)),
          false,
          false};
}

base::Result<scene::FrameStats> draw_clip(const debug::Clip& clip, const scene::Knobs& knobs, gpu::Gpu& gpu,
                                          gpu::Trace* trace) {
  if (auto checked = check_visibility(knobs); !checked) return tl::make_unexpected(checked.error());
  const auto begin = Clock::now();
  const bool by_bucket = knobs.without_depth == scene::WithoutDepth::bucket && clip.buckets != 0;
  debug::PlayOptions options{.depth = scene::depth_options(knobs), .trace = trace};
  if (by_bucket) {
    options.before = [&](std::size_t item) {
      const auto bucket = clip.items[item].bucket;
      if (bucket < clip.buckets) gpu.set_default_depth(gpu::depth_of_bucket(bucket, clip.buckets));
    };
  }
  debug::play(clip, gpu, options);
  gpu.set_default_depth(std::nullopt);
  scene::FrameStats stats;
  stats.primitives = static_cast<std::uint32_t>(std::count_if(
      clip.items.begin(), clip.items.end(), [](const auto& item) { return item.is_drawing(); }));
  stats.faces = stats.primitives;
  stats.raster_ms = ms_since(begin);
  return stats;
}

Tape::Tape(std::string name, std::shared_ptr<debug::Timeline> timeline, Shown shown)
    : name_(std::move(name)), timeline_(std::move(timeline)), shown_(shown) {}

std::uint64_t Tape::within(std::int64_t frame) const {
  const auto last = static_cast<std::int64_t>(std::max<std::uint64_t>(timeline_->frames(), 1));
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(frame, 1, last));
}

base::Result<scene::FrameStats> Tape::draw(std::int64_t frame, const scene::Knobs& knobs,
                                           const CameraOffset& /*camera*/) {
  const auto number = within(frame);
  scene::FrameStats stats;
  if (knobs.visibility == scene::Visibility::ot) {
    const auto begin = Clock::now();
    trace_ != nullptr ? static_cast<void>(timeline_->watch(number, *trace_))
                      : static_cast<void>(timeline_->seek({.frame = number, .command = debug::whole_frame}));
    stats.raster_ms = ms_since(begin);
    debug::go_on_from(timeline_->gpu().save(), gpu_);
    for (const auto& command : timeline_->commands(number)) stats.primitives += command.drawing != 0 ? 1 : 0;
    stats.faces = stats.primitives;
  } else {
    auto drawn = draw_clip(debug::clip_of(*timeline_, number), knobs, gpu_, trace_);
    if (!drawn) return drawn;
    stats = *drawn;
  }
  const auto area = shown_area(gpu_, shown_);
  why_empty_ = empty_reason(gpu_, area, stats.primitives);
  picture_ = area.width > 0 && area.height > 0 ? display::scan_out(gpu_.vram().pixels(), area)
                                               : base::Picture(320, 240);
  return stats;
}

std::vector<std::uint16_t> Tape::vram() const {
  const auto pixels = gpu_.vram().pixels();
  return {pixels.begin(), pixels.end()};
}

base::Result<debug::Clip> Tape::clip(std::int64_t frame, const scene::Knobs& knobs,
                                     const CameraOffset& /*camera*/) {
  if (auto checked = check_visibility(knobs); !checked) return tl::make_unexpected(checked.error());
  return debug::clip_of(*timeline_, within(frame));
}

std::unique_ptr<Subject> Tape::another(const scene::Knobs& /*knobs*/) const {
  return std::make_unique<Tape>(name_, timeline_, shown_);
}

std::unique_ptr<Subject> Tape::apart(std::int64_t frame, const scene::Knobs& /*knobs*/) {
  return std::make_unique<ClipSubject>(debug::clip_of(*timeline_, within(frame)));
}

std::optional<std::int64_t> Tape::last_frame() const {
  return static_cast<std::int64_t>(std::max<std::uint64_t>(timeline_->frames(), 1));
}

std::string Tape::why_idle(const scene::KnobInfo& knob) const {
  return applies_to_recordings(knob.name) ? std::string() : std::string(why_not_for_recordings);
}

base::Result<scene::FrameStats> ClipSubject::draw(std::int64_t /*frame*/, const scene::Knobs& knobs,
                                                  const CameraOffset& /*camera*/) {
  if (auto checked = check_applicable(knobs); !checked) return tl::make_unexpected(checked.error());
  return draw_clip(clip_, knobs, gpu_, trace_);
}

std::vector<std::uint16_t> ClipSubject::vram() const {
  const auto pixels = gpu_.vram().pixels();
  return {pixels.begin(), pixels.end()};
}

}  // namespace app
