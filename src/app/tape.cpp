#include "app/tape.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/commands/describe.h"
#include "app/source.h"
#include "gpu/canvas/canvas.h"
#include "gpu/depth.h"
#include "machine/present.h"
#include "scene/plan.h"
#include "scene/world.h"

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

// The accurate target that the knobs ask for; a recording's polygons may be of any kind.
std::optional<gpu::canvas::Options> canvas_of(const scene::Knobs& knobs) {
  auto followed = knobs;
  followed.fog = scene::Knobs().fog;  // of the world, which no packet tells
  return scene::canvas_options(followed, scene::World{}, 1);
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

/// Why a frame shows nothing; empty: it shows something. `drawn`: its drawing commands.
std::string empty_reason(const gpu::Gpu& gpu, const display::Area& area, std::uint64_t drawn) {
  if (area.width <= 0 || area.height <= 0) {
    return "nothing to show: the display area is empty (" + std::to_string(area.width) + " x " +
           std::to_string(area.height) + " pixels), GP1(06h) and GP1(07h) set it; F3 shows VRAM";
  }
  if (drawn != 0 || !gpu.display().is_off) return {};
  return "nothing to show: the display is off, and the frame draws nothing; F3 shows VRAM";
}

}  // namespace

Shown shown_named(std::string_view name) {
  return name == "drawn" ? Shown::drawn : name == "display" ? Shown::display : Shown::either;
}

bool asks_for_canvas(const scene::Knobs& knobs) { return canvas_of(knobs).has_value(); }

display::Area shown_area(const gpu::Gpu& gpu, Shown shown) {
  auto area = display::area_of(gpu.display());
  area.is_off = false;  // who debugs wants to see it all the same
  const auto& state = gpu.state();
  const int width = state.right() - state.left() + 1, height = state.bottom() - state.top() + 1;
  const bool is_beside =
      machine::draws_picture(gpu) && !overlap(area, state.left(), state.top(), width, height);
  if (shown == Shown::display || (shown == Shown::either && !is_beside)) return area;
  if (width <= 0 || height <= 0) return area;
  return {state.left(),
          state.top(),
          std::min(width, std::max(area.width, 1)),
          std::min(height, std::max(area.height, 1)),
          false,
          false};
}

base::Result<DrawnClip> draw_clip(const debug::Clip& clip, const scene::Knobs& knobs, gpu::Gpu& gpu,
                                  gpu::Trace* trace) {
  if (auto checked = check_visibility(knobs); !checked) return tl::make_unexpected(checked.error());
  const auto begin = Clock::now();
  const bool by_bucket = knobs.without_depth == scene::WithoutDepth::bucket && clip.buckets != 0;
  const auto canvas = canvas_of(knobs);
  DrawnClip drawn;
  base::Result<std::optional<machine::Corner>> placed;
  debug::PlayOptions options{.depth = canvas ? std::nullopt : scene::depth_options(knobs), .trace = trace};
  options.before = [&](std::size_t number) {
    const auto& item = clip.items[number];
    if (by_bucket && item.bucket < clip.buckets) {
      gpu.set_default_depth(gpu::depth_of_bucket(item.bucket, clip.buckets));
    }
    if (!canvas || drawn.canvas || !placed || !item.is_drawing()) return;
    placed = machine::place_canvas(gpu, *canvas);
    if (placed) drawn.canvas = *placed;
  };
  gpu.set_canvas(std::nullopt);
  drawn.end = debug::play(clip, gpu, options);
  gpu.set_default_depth(std::nullopt);
  if (!placed) return tl::make_unexpected(placed.error());
  drawn.stats.primitives = static_cast<std::uint32_t>(std::count_if(
      clip.items.begin(), clip.items.end(), [](const auto& item) { return item.is_drawing(); }));
  drawn.stats.faces = drawn.stats.primitives;
  drawn.stats.raster_ms = ms_since(begin);
  return drawn;
}

bool is_on_canvas(const DrawnClip& drawn, const gpu::Gpu& gpu, const display::Area& area) {
  if (!drawn.canvas) return false;
  const auto& size = gpu.canvas()->options();
  const int left = area.x - drawn.canvas->x, top = area.y - drawn.canvas->y;
  return left >= 0 && top >= 0 && left + area.width <= size.width && top + area.height <= size.height;
}

namespace {

/// `area` of the picture on the canvas, where it lies.
base::Picture part_of_canvas(const DrawnClip& drawn, const gpu::Gpu& gpu, const display::Area& area,
                             const scene::Knobs& knobs) {
  const auto& size = gpu.canvas()->options();
  const int left = area.x - drawn.canvas->x, top = area.y - drawn.canvas->y;
  auto whole = machine::Presenter().show(gpu, knobs);
  if (area.width == size.width && area.height == size.height) return whole;
  const int across = whole.width / size.width, down = whole.height / size.height;
  base::Picture part(area.width * across, area.height * down);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) part.at(x, y) = whole.at(left * across + x, top * down + y);
  return part;
}

}  // namespace

base::Picture picture_of_clip(const DrawnClip& drawn, const gpu::Gpu& gpu, const display::Area& area,
                              const scene::Knobs& knobs) {
  if (area.width <= 0 || area.height <= 0) return {320, 240};
  if (is_on_canvas(drawn, gpu, area)) return part_of_canvas(drawn, gpu, area, knobs);
  return machine::Presenter::show(display::scan_out(gpu.vram().pixels(), area), knobs);
}

std::vector<const scene::KnobInfo*> ClipDrawer::unwatched_knobs(const scene::Knobs& knobs) {
  std::vector<const scene::KnobInfo*> asking;
  for (const auto& knob : scene::knob_table()) {
    if (!applies_to_recordings(knob.name)) continue;
    scene::Knobs alone;
    knob.set(alone, knob.get(knobs));
    const auto canvas = canvas_of(alone);
    if (canvas && !canvas->can_be_watched()) asking.push_back(&knob);
  }
  return asking;
}

std::vector<std::uint16_t> ClipDrawer::vram() const {
  const auto pixels = gpu_.vram().pixels();
  std::vector<std::uint16_t> copy(pixels.begin(), pixels.end());
  const auto* canvas = gpu_.canvas();
  if (canvas != nullptr && canvas->options().can_be_watched()) canvas->put_into(copy);
  return copy;
}

base::Result<scene::FrameStats> ClipDrawer::show(const debug::Clip& clip, const scene::Knobs& knobs) {
  const auto drawn = draw_clip(clip, knobs, gpu_, trace_);
  if (!drawn) return tl::make_unexpected(drawn.error());
  show(*drawn, knobs);
  return drawn->stats;
}

void ClipDrawer::show(const DrawnClip& drawn, const scene::Knobs& knobs) {
  const auto area = shown_area(gpu_, shown_);
  why_empty_ = empty_reason(gpu_, area, drawn.stats.primitives);
  picture_ = picture_of_clip(drawn, gpu_, area, knobs);
}

std::string ClipDrawer::why_idle(const scene::KnobInfo& knob) const {
  return applies_to_recordings(knob.name) ? std::string() : std::string(why_not_for_recordings);
}

Tape::Tape(std::string name, std::shared_ptr<debug::Timeline> timeline, Shown shown)
    : ClipDrawer(shown), name_(std::move(name)), timeline_(std::move(timeline)) {}

std::uint64_t Tape::within(std::int64_t frame) const {
  const auto last = static_cast<std::int64_t>(std::max<std::uint64_t>(timeline_->frames(), 1));
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(frame, 1, last));
}

base::Result<scene::FrameStats> Tape::draw(std::int64_t frame, const scene::Knobs& knobs,
                                           const CameraOffset& /*camera*/) {
  const auto number = within(frame);
  DrawnClip drawn;
  auto& stats = drawn.stats;
  if (knobs.visibility == scene::Visibility::ot && !asks_for_canvas(knobs)) {
    gpu_.set_canvas(std::nullopt);
    const auto begin = Clock::now();
    trace_ != nullptr ? static_cast<void>(timeline_->watch(number, *trace_))
                      : static_cast<void>(timeline_->seek({.frame = number, .command = debug::whole_frame}));
    stats.raster_ms = ms_since(begin);
    debug::go_on_from(timeline_->gpu().save(), gpu_);
    for (const auto& command : timeline_->commands(number)) stats.primitives += command.drawing != 0 ? 1 : 0;
    stats.faces = stats.primitives;
  } else {
    auto clip = draw_clip(debug::clip_of(*timeline_, number), knobs, gpu_, trace_);
    if (!clip) return tl::make_unexpected(clip.error());
    drawn = *clip;
  }
  show(drawn, knobs);
  return stats;
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

base::Result<scene::FrameStats> ClipSubject::draw(std::int64_t /*frame*/, const scene::Knobs& knobs,
                                                  const CameraOffset& /*camera*/) {
  if (auto checked = check_applicable(knobs); !checked) return tl::make_unexpected(checked.error());
  const auto drawn = draw_clip(clip_, knobs, gpu_, trace_);
  if (!drawn) return tl::make_unexpected(drawn.error());
  return drawn->stats;
}

}  // namespace app
