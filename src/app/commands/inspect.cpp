// otter inspect: which pixels are wrong, why, and between whom.

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/without_depth.h"
#include "app/order_of.h"
#include "app/source.h"
#include "app/viewer.h"
#include "base/write_file.h"
#include "debug/timeline.h"
#include "display/png.h"
#include "dump/frames.h"
#include "inspect/history.h"
#include "inspect/json.h"
#include "inspect/lint.h"
#include "inspect/maps.h"
#include "inspect/report.h"

namespace app {
namespace {

struct InspectOptions {
  std::string source, frame, frames, pixel, camera, json, heatmap, overdraw, ids, truth, depth_map;
  std::int64_t max = -1;
  SourceOptions source_options;
  scene::Knobs knobs;

  [[nodiscard]] bool wants_picture() const {
    return !heatmap.empty() || !overdraw.empty() || !ids.empty() || !truth.empty() || !depth_map.empty();
  }
};

struct FrameRange {
  std::uint32_t first = 0, last = 0;
};
constexpr std::uint32_t highest_number = 1'000'000'000;

// One frame drawn and watched: what the report and the pictures are made from.
struct Watched {
  inspect::Report report;
  std::vector<std::uint16_t> vram;
  bool is_complete = true;  // false: Ctrl-C cut it short
};

// Where frames come from: a scene, or a dump.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual base::Result<Watched> frame(std::uint32_t number, gpu::Trace& trace) = 0;
  [[nodiscard]] virtual FrameRange frames() const = 0;
};

class SceneSource : public FrameSource {
 public:
  SceneSource(scene::Scene scene, const scene::Knobs& knobs, CameraOffset view)
      : name_(scene.name), knobs_(knobs), view_(view), machine_(std::move(scene), knobs) {}

  base::Result<Watched> frame(std::uint32_t number, gpu::Trace& trace) override {
    if (const auto unwatched = machine_.unwatched_knobs(knobs_); !unwatched.empty()) {
      return base::fail(
          "--" + std::string(unwatched[0]->name) +
          ": truth is judged at the console's own pixels; expected --resolution 1 and an --antialias "
          "that samples each once (none, fxaa)");
    }
    machine_.watch(&trace);
    machine_.set_keep_going([](double) { return !Interrupt::was_asked(); });
    const auto stats = machine_.draw(number, knobs_, view_);
    machine_.watch(nullptr);
    if (!stats) return tl::make_unexpected(stats.error());
    if (trace.is_full)
      return base::fail(name_ + ": frame " + std::to_string(number) + ": " + trace.limit_text());
    Watched watched{
        inspect::inspect(trace, {.order = order_of(knobs_.visibility), .scene = name_, .frame = number}),
        machine_.vram(), !stats->was_stopped};
    add_lint(*stats, watched.report);
    return watched;
  }
  [[nodiscard]] FrameRange frames() const override { return {0, highest_number}; }

 private:
  void add_lint(const scene::FrameStats& stats, inspect::Report& report) const {
    for (std::size_t reason = 0; reason < scene::drop_reasons; ++reason) {
      if (stats.dropped[reason] == 0) continue;
      report.lint.push_back(
          {"dropped", scene::drop_names[reason],
           std::to_string(stats.dropped[reason]) + " of " + std::to_string(stats.faces) +
               " faces were left out before drawing: " + scene::drop_reasons_in_words[reason]});
    }
    const auto length = knobs_.visibility == scene::Visibility::sorted
                            ? scene::sort_keys
                            : static_cast<std::uint32_t>(knobs_.buckets);
    const auto& out = stats.out_of_range;
    for (auto& item : inspect::lint_buckets({out.below, out.at, out.above}, length)) {
      report.lint.push_back(std::move(item));
    }
    if (stats.splits != 0) {
      report.lint.push_back(
          {"splits", "", std::to_string(stats.splits) + " cuts were made to find an order"});
    }
  }

  std::string name_;
  scene::Knobs knobs_;
  CameraOffset view_;
  Viewer machine_;
};

class RecordingSource : public FrameSource {
 public:
  // What a recording and the history of one of its frames may take together.
  static constexpr std::int64_t most_of_both = std::int64_t{400} << 20,
                                least_of_trace = std::int64_t{128} << 20;

  RecordingSource(std::string name, std::unique_ptr<debug::Timeline> timeline, const scene::Knobs& knobs)
      : name_(std::move(name)), timeline_(std::move(timeline)), knobs_(knobs) {}

  base::Result<Watched> frame(std::uint32_t number, gpu::Trace& trace) override {
    trace.allowance = std::max(most_of_both - timeline_->dump().held_bytes(), least_of_trace);
    const auto watched_frame = timeline_->watch(number, trace);
    if (trace.is_full)
      return base::fail(name_ + ": frame " + std::to_string(number) + ": " + trace.limit_text());
    if (auto judged = judge_without_depth(name_, knobs_, {watched_frame.end, number}); !judged)
      return tl::make_unexpected(judged.error());
    const auto vram = timeline_->gpu().vram().pixels();
    Watched watched{
        inspect::inspect(trace, {.order = order_of(knobs_.visibility), .scene = name_, .frame = number}),
        {vram.begin(), vram.end()},
        !Interrupt::was_asked()};
    add_lint(watched.report.lint);
    return watched;
  }
  [[nodiscard]] FrameRange frames() const override {
    return {1, static_cast<std::uint32_t>(std::min<std::uint64_t>(timeline_->frames(), highest_number))};
  }

 private:
  void add_lint(std::vector<inspect::LintItem>& lint) const {
    lint.push_back(
        {"dropped", "", "not available: what a program leaves out before drawing is not in a recording"});
    const auto& image = timeline_->recording().image();
    if (!image) {
      if (!timeline_->recording().has_buckets())
        lint.push_back({"buckets", "", "not available: a dump holds no ordering table"});
      lint.push_back({"links", "", "not available: a dump holds no list, only the words it sent"});
      return;
    }
    std::ranges::move(inspect::lint_list(image->ram, image->head, image->table), std::back_inserter(lint));
  }

  std::string name_;
  std::unique_ptr<debug::Timeline> timeline_;
  scene::Knobs knobs_;
};

std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > highest_number) return std::nullopt;
  return value;
}

base::Result<FrameRange> asked_frames(const InspectOptions& options, std::uint32_t first) {
  if (!options.frames.empty()) {
    if (!options.frame.empty()) return base::fail("--frames: expected no --frame beside it");
    const auto dots = options.frames.find("..");
    const auto a = number(std::string_view(options.frames).substr(0, dots));
    const auto b =
        dots == std::string::npos ? std::nullopt : number(std::string_view(options.frames).substr(dots + 2));
    if (!a || !b || *b < *a) return base::fail("--frames: expected A..B with A <= B, got " + options.frames);
    if (*b != *a && (options.wants_picture() || !options.pixel.empty())) {
      return base::fail("--frames: a picture or --pixel needs a single frame, got " + options.frames);
    }
    return FrameRange{*a, *b};
  }
  if (options.frame.empty()) return FrameRange{first, first};
  const auto only = number(options.frame);
  if (!only) return base::fail("--frame: expected a number, got " + options.frame);
  return FrameRange{*only, *only};
}

base::Result<FrameRange> frames_of(const InspectOptions& options, const FrameRange& available) {
  auto asked = asked_frames(options, available.first);
  if (asked && (asked->first < available.first || asked->last > available.last)) {
    const auto missing = asked->first < available.first ? asked->first : asked->last;
    return base::fail(options.source + ": --frame " + std::to_string(missing) + ": expected " +
                      std::to_string(available.first) + ".." + std::to_string(available.last) +
                      ", the frames of it");
  }
  return asked;
}

struct Position {
  int x, y;
};

base::Result<std::optional<Position>> pixel_of(const InspectOptions& options) {
  if (options.pixel.empty()) return std::nullopt;
  const auto comma = options.pixel.find(',');
  const auto x = number(std::string_view(options.pixel).substr(0, comma));
  const auto y =
      comma == std::string::npos ? std::nullopt : number(std::string_view(options.pixel).substr(comma + 1));
  const auto column = x.value_or(1024), row = y.value_or(512);
  if (column > 1023 || row > 511)
    return base::fail("--pixel: expected X,Y in the picture, got " + options.pixel);
  return Position{static_cast<int>(column), static_cast<int>(row)};
}

base::Result<std::unique_ptr<FrameSource>> open(const InspectOptions& options) {
  auto source = open_source(options.source, options.source_options);
  if (!source) return tl::make_unexpected(source.error());
  if (!source->is_recording()) {
    CameraOffset view;
    if (!options.camera.empty()) {
      const auto camera = parse_camera(options.camera);
      if (!camera) return tl::make_unexpected(camera.error());
      view.from = *camera;
    }
    return std::make_unique<SceneSource>(std::move(*source->scene), options.knobs, view);
  }
  if (!options.camera.empty())
    return base::fail("--camera: " + options.source + " is a recording, whose views are drawn already");
  warn_of_idle_knobs(options.source, options.knobs, DrawnTo::vram);
  auto timeline = open_timeline(*source, options.knobs);
  if (!timeline) return tl::make_unexpected(timeline.error());
  if (auto read = (*timeline)->read_all(); !read) return tl::make_unexpected(read.error());
  warn_of_fault(**timeline);
  return std::make_unique<RecordingSource>(options.source, std::move(*timeline), options.knobs);
}

base::Result<void> write_pictures(const InspectOptions& options, const Watched& watched,
                                  const gpu::Trace& trace) {
  const auto& report = watched.report;
  const auto write = [](const std::string& path, auto&& make) {
    return path.empty() ? base::Result<void>{} : display::write_png(path, make());
  };
  return write(options.heatmap, [&] { return inspect::heatmap(report, watched.vram); })
      .and_then([&] { return write(options.overdraw, [&] { return inspect::overdraw(report, trace); }); })
      .and_then([&] { return write(options.ids, [&] { return inspect::ids(report, trace); }); })
      .and_then([&] {
        return write(options.truth, [&] { return inspect::truth_image(report, trace, watched.vram); });
      })
      .and_then(
          [&] { return write(options.depth_map, [&] { return inspect::depth_image(report, trace); }); });
}

// Before anything is printed or written.
base::Result<void> check_inside(const inspect::Rectangle& picture, Position at) {
  if (at.x < picture.width && at.y < picture.height) return {};
  return base::fail("--pixel: expected X,Y inside " + std::to_string(picture.width) + "x" +
                    std::to_string(picture.height) + ", got " + std::to_string(at.x) + "," +
                    std::to_string(at.y));
}

base::Result<void> write_json(const std::string& path, inspect::FramesJson& json) {
  if (path != "-") {
    return base::write_file(path, [&](std::FILE* file) -> base::Result<void> {
      json.write(file);
      return {};
    });
  }
  json.write(stdout);
  return {};
}

base::Result<int> run(const InspectOptions& options) {
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  const auto pixel = pixel_of(options);
  if (!pixel) return tl::make_unexpected(pixel.error());
  const auto source = open(options);
  if (!source) return tl::make_unexpected(source.error());
  const auto frames = frames_of(options, (*source)->frames());
  if (!frames) return tl::make_unexpected(frames.error());

  gpu::Trace trace;
  trace.keep_history = true;
  inspect::Sums sums;
  std::optional<inspect::FramesJson> json;
  if (!options.json.empty()) json.emplace();
  const bool prints = options.json != "-";
  const auto wanted = std::uint64_t{frames->last} - frames->first + 1;
  Progress progress("inspect", wanted);
  const Interrupt interrupt;
  for (std::uint32_t n = frames->first; n <= frames->last; ++n) {
    trace.clear();
    auto watched = (*source)->frame(n, trace);
    if (!watched) return tl::make_unexpected(watched.error());
    if (!watched->is_complete) break;
    if (*pixel) {
      if (auto inside = check_inside(watched->report.picture, **pixel); !inside)
        return tl::make_unexpected(inside.error());
    }
    sums.add(watched->report);
    if (json && !json->add(watched->report)) {
      return base::fail(std::string("--json: a temporary file cannot be written: ") + std::strerror(errno),
                        base::Exit::failed);
    }
    if (auto done = write_pictures(options, *watched, trace); !done) return tl::make_unexpected(done.error());
    if (prints) std::fputs(inspect::to_text(watched->report).c_str(), stdout);
    if (*pixel && prints) {
      for (const auto& line : inspect::pixel_history(watched->report, trace, (*pixel)->x, (*pixel)->y))
        std::puts(line.c_str());
    }
    progress.step();
    if (interrupt.was_asked()) break;
  }
  if (prints && wanted > 1) std::fputs(inspect::to_text(sums).c_str(), stdout);
  if (json) {
    if (auto done = write_json(options.json, *json); !done) return tl::make_unexpected(done.error());
  }
  if (sums.frames < wanted) {
    return base::fail("interrupted: the report holds " + std::to_string(sums.frames) + " frames of " +
                          std::to_string(wanted),
                      base::Exit::interrupted);
  }
  if (options.max >= 0 && sums.wrong_pixels > static_cast<std::uint64_t>(options.max)) {
    return base::fail("--max " + std::to_string(options.max) + ": " + std::to_string(sums.wrong_pixels) +
                          " pixels are wrong",
                      base::Exit::failed);
  }
  return 0;
}

}  // namespace

Action add_inspect(Arguments arguments) {
  const auto options = std::make_shared<InspectOptions>();
  const auto file = [&](const char* name, std::string& path, const char* help) {
    arguments.text(name, "FILE", path, help);
  };
  arguments.positional(
      "source", "SCENE|FILE", options->source,
      "a scene of `otter list`, an .obj or .x3d file, a GPU dump, or a RAM image with --head",
      Presence::required);
  arguments.text("--frame", "N", options->frame, "of a scene from 0 [0], of a recording from 1 [1]");
  arguments.text("--frames", "A..B", options->frames, "several frames, both ends included");
  file("--json", options->json, "the report as JSON; - is standard output, and nothing else on it");
  file("--heatmap", options->heatmap, "PNG: wrong pixels in the colours of their causes");
  file("--overdraw", options->overdraw, "PNG: how often each pixel was drawn");
  file("--ids", options->ids, "PNG: a colour per primitive that is seen");
  file("--truth", options->truth, "PNG: the picture as it should be");
  file("--depth-map", options->depth_map, "PNG: 1/z of the true owners");
  arguments.text("--camera", "X,Y,Z,YAW,PITCH", options->camera,
                 "scene: stand there instead: world units and degrees, 0,0 looks along -z");
  arguments.text("--pixel", "X,Y", options->pixel, "tell the history of a pixel of the picture");
  arguments.number("--max", "N", options->max, std::int64_t{0}, std::int64_t{1} << 40,
                   "exit with 1 if more pixels are wrong");
  add_source_options(arguments, options->source_options);
  options->knobs.without_depth = foreign_without_depth;  // scenes have depths
  arguments.knobs(options->knobs);
  return [options] { return run(*options); };
}

}  // namespace app
