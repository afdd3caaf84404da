#include "cost/recorded.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "cost/axes.h"
#include "cost/metrics.h"
#include "cost/packet_edit.h"
#include "display/scanout.h"
#include "gpu/gpu.h"
#include "gpu/trace.h"
#include "inspect/report.h"
#include "scene/plan.h"

namespace cost {
namespace {

using Pieces = std::vector<RecordedFrame::Piece>;

/// The frame again and again, from the state before it, which is made outside the timed part.
class Stage {
 public:
  explicit Stage(const RecordedFrame& frame) : frame_(frame) { gpu_.set_depth(frame.depth); }

  /// Milliseconds by the clock; cpu_ms() then tells those of the processor.
  base::Result<double> draw(const Pieces& pieces) {
    if (const auto fault = gpu_.load(frame_.before)) return base::fail(frame_.name + ": " + fault->message);
    gpu_.reset_counters();
    const double begin = base::now_ms(), cpu_begin = base::cpu_ms();
    gpu_.begin_frame();
    for (const auto& piece : pieces) {
      if (!piece.is_control) gpu_.gp0(piece.words);
      if (piece.is_control)
        for (const auto word : piece.words) gpu_.gp1(word);
    }
    gpu_.end_frame();
    cpu_ms_ = base::cpu_ms() - cpu_begin;
    return base::now_ms() - begin;
  }
  [[nodiscard]] double cpu_ms() const { return cpu_ms_; }
  [[nodiscard]] gpu::Gpu& gpu() { return gpu_; }

 private:
  const RecordedFrame& frame_;
  gpu::Gpu gpu_;
  double cpu_ms_ = 0;
};

Pieces edited(const Pieces& pieces, std::size_t effect) {
  Pieces out = pieces;
  for (auto& piece : out)
    if (!piece.is_control && !piece.is_rest) piece.words = without(piece.words, effect);
  return out;
}

/// An effect, the frame without it, and by how much that was faster each time.
struct Without {
  Effect effect;
  Pieces pieces;
  bool has_depth = true;
  std::vector<double> differences;
};

Effect counted_in(const gpu::Trace& trace, std::string_view name, bool (*asks)(const gpu::Primitive&)) {
  Effect effect{std::string(name)};
  for (std::size_t n = 0; n < trace.draws.size(); ++n) {
    if (!asks(trace.draws[n])) continue;
    ++effect.primitives;
    effect.pixels += trace.written[n];
  }
  return effect;
}

std::vector<Without> variants_of(const RecordedFrame& frame, const gpu::Trace& trace) {
  std::vector<Without> variants;
  const auto effects = packet_effects();
  for (std::size_t n = 0; n < effects.size(); ++n) {
    auto effect = counted_in(trace, effects[n].name, effects[n].asks);
    if (effect.primitives != 0) variants.push_back({std::move(effect), edited(frame.pieces, n), true, {}});
  }
  if (frame.depth)
    variants.push_back({counted_in(trace, "visibility zbuffer",
                                   [](const gpu::Primitive& p) { return p.kind == gpu::Kind::polygon; }),
                        frame.pieces,
                        false,
                        {}});
  return variants;
}

}  // namespace

base::Result<EffectReport> find_effects(const RecordedFrame& frame, int rounds, const KeepGoing& keep_going) {
  constexpr int least = 9, most = 101;
  constexpr double budget_ms = 1500;
  EffectReport report;
  report.scene = frame.name;
  report.frame = frame.frame;
  report.width = frame.width;
  report.height = frame.height;
  Stage stage(frame);
  gpu::Trace trace;
  stage.gpu().set_trace(&trace);
  if (auto drawn = stage.draw(frame.pieces); !drawn) return tl::make_unexpected(drawn.error());
  stage.gpu().set_trace(nullptr);
  if (trace.is_full) return base::fail(frame.name + ": " + trace.limit_text());
  if (auto drawn = stage.draw(frame.pieces); !drawn) return tl::make_unexpected(drawn.error());
  report.kernels = kernels_that_ran(stage.gpu().counters());
  if (const auto bytes = stage.gpu().depth_bytes(); bytes != 0)
    report.buffers.push_back({"depth plane", bytes});
  if (const auto bytes = stage.gpu().queue_bytes(); bytes != 0)
    report.buffers.push_back({"queue of semi-transparent polygons", bytes});

  auto variants = variants_of(frame, trace);
  std::vector<double> wholes;
  RecordedFrame flat = frame;
  flat.depth.reset();
  Stage list_order(flat);
  const double begin = base::now_ms();
  const auto turns =
      static_cast<std::size_t>(rounds > 0 ? rounds : least) * std::max<std::size_t>(1, variants.size());
  std::size_t done = 0;
  const auto goes_on = [&] {
    report.is_complete = report.is_complete && (!keep_going || keep_going(std::min(done++, turns), turns));
    return report.is_complete;
  };
  for (int round = 0; round < (rounds > 0 ? rounds : most) && goes_on(); ++round) {
    if (rounds == 0 && round >= least && base::now_ms() - begin > budget_ms) break;
    if (variants.empty()) wholes.push_back(stage.draw(frame.pieces).value_or(0));
    for (Without& variant : variants) {
      if (!goes_on()) break;
      // Beside the whole frame, before and after it in turn: what a busy machine adds falls on both alike.
      const auto part = [&] {
        return (variant.has_depth ? stage : list_order).draw(variant.pieces).value_or(0);
      };
      const double first = round % 2 == 0 ? 0 : part();
      wholes.push_back(stage.draw(frame.pieces).value_or(0));
      variant.differences.push_back(wholes.back() - (round % 2 == 0 ? part() : first));
    }
  }
  if (!wholes.empty()) report.ms = median(wholes);
  for (Without& variant : variants) {
    if (variant.differences.empty()) continue;
    variant.effect.ms = median(variant.differences);
    variant.effect.spread = spread(variant.differences);
    report.effects.push_back(std::move(variant.effect));
  }
  return report;
}

namespace {

/// A setting of the visibility axis for a recording: its own order, or a z-buffer.
struct RecordedSetting {
  std::string name;
  scene::Knobs knobs;
};

std::vector<RecordedSetting> recorded_settings(const Axis& axis, const SweepOptions& options) {
  std::vector<RecordedSetting> settings{{"list order", console_knobs(options.given)}};
  for (const Setting& setting : axis.settings) {
    const auto knobs = with(options.given, setting);
    if (knobs.visibility == scene::Visibility::zbuffer && (setting.in_quick || !options.quick))
      settings.push_back({std::string(setting.name), knobs});
  }
  return settings;
}

struct Judged {
  Errors errors;
  std::uint32_t polygons_judged = 0;
  base::Picture picture;
};

/// Drawn once, watched.
base::Result<Judged> judge_recorded(const RecordedFrame& frame, Stage& stage) {
  gpu::Trace trace;
  trace.keep_history = true;
  stage.gpu().set_trace(&trace);
  const auto drawn = stage.draw(frame.pieces);
  stage.gpu().set_trace(nullptr);
  if (!drawn) return tl::make_unexpected(drawn.error());
  if (trace.is_full) return base::fail(frame.name + ": " + trace.limit_text());
  const auto order = stage.gpu().depth_plane() != nullptr ? inspect::Order::depth : inspect::Order::list;
  const auto report = inspect::inspect(trace, {.order = order, .scene = frame.name, .frame = frame.frame});
  Judged judged;
  judged.errors.pixels_drawn = report.pixels_drawn;
  judged.errors.wrong_pixels = report.wrong_pixels();
  judged.errors.causes = report.causes;
  judged.polygons_judged = report.polygons_judged;
  judged.picture = display::scan_out(stage.gpu().vram().pixels(), display::area_of(stage.gpu().display()));
  return judged;
}

}  // namespace

base::Result<SceneResult> sweep(const RecordedFrame& frame, const SweepOptions& options) {
  SceneResult result;
  result.scene = frame.name;
  result.frame = frame.frame;
  result.width = frame.width;
  result.height = frame.height;
  result.rounds = options.rounds;
  const auto stopped = [&] { return options.stop && options.stop(); };
  std::string idle;
  for (const Axis& axis : axes()) {
    const bool is_asked =
        options.axes.empty() || std::ranges::find(options.axes, &axis) != options.axes.end();
    if (is_asked && axis.measure != Measure::wrong_surface)
      idle.append(idle.empty() ? "" : ", ").append(axis.name);
  }
  if (!idle.empty())
    result.skipped.push_back(idle + ": a recording holds packets, not the world they came from");
  const Axis* const axis = find_axis("visibility");
  if (axis == nullptr ||
      (!options.axes.empty() && std::ranges::find(options.axes, axis) == options.axes.end()))
    return result;
  std::vector<std::unique_ptr<Stage>> stages;
  std::vector<RecordedFrame> frames;
  const auto settings = recorded_settings(*axis, options);
  frames.reserve(settings.size());
  std::string without_depth;
  for (const auto& [name, knobs] : settings) {
    frames.push_back(frame);
    frames.back().depth = scene::depth_options(knobs);
    auto stage = std::make_unique<Stage>(frames.back());
    auto judged = judge_recorded(frames.back(), *stage);
    if (!judged) return tl::make_unexpected(judged.error());
    if (frames.back().depth && judged->polygons_judged == 0) {
      without_depth.append(without_depth.empty() ? "" : ", ").append(name);
      continue;
    }
    Row row;
    row.axis = axis;
    row.setting = name;
    row.knobs = knobs;
    row.errors = judged->errors;
    row.held_bytes = stage->gpu().depth_bytes() + stage->gpu().queue_bytes();
    row.picture = std::move(judged->picture);
    row.is_console = result.rows.empty();
    result.rows.push_back(std::move(row));
    stages.push_back(std::move(stage));
  }
  if (!without_depth.empty())
    result.skipped.push_back(std::string(axis->name) + " " + without_depth +
                             ": no polygon of the frame carries depth");
  std::vector<std::vector<double>> times(stages.size()), cpu_times(stages.size()), ratios(stages.size());
  const std::size_t steps = stages.size() * static_cast<std::size_t>(options.rounds);
  std::size_t done = 0;
  const double begin = base::now_ms();
  for (int round = 0; round < options.rounds && !stopped(); ++round) {
    for (std::size_t n = 0; n < stages.size() && !stopped(); ++n) {
      times[n].push_back(stages[n]->draw(frame.pieces).value_or(0));
      cpu_times[n].push_back(stages[n]->cpu_ms());
      if (stages[0]->cpu_ms() > 0) ratios[n].push_back(stages[n]->cpu_ms() / stages[0]->cpu_ms());
      const double taken = (base::now_ms() - begin) / 1000 / static_cast<double>(++done);
      if (options.progress) options.progress(done, steps, taken * static_cast<double>(steps - done));
    }
  }
  result.complete = !stopped();
  result.reference = result.rows.back().picture;
  for (std::size_t n = 0; n < stages.size(); ++n) {
    Row& row = result.rows[n];
    if (times[n].empty()) continue;
    row.ms = row.stages.raster = median(times[n]);
    row.cpu_ms = median(cpu_times[n]);
    if (!ratios[n].empty()) row.ratio = median(ratios[n]);
    row.spread = spread(times[n]);
    row.difference = heat_map(row.picture, result.reference);
    row.errors.colour_rms = rms(row.picture, result.reference);
    row.errors.block_rms = block_rms(row.picture, result.reference);
    row.errors.psnr = psnr(row.errors.colour_rms);
    row.errors.ssim = ssim(row.picture, result.reference);
    result.rounds = std::min(result.rounds, static_cast<int>(times[n].size()));
  }
  std::erase_if(result.rows, [](const Row& row) { return row.ms <= 0; });
  mark_front(result.rows);
  return result;
}

}  // namespace cost
