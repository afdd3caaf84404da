// otter render: a frame into a PNG, without a window.

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/open_scene.h"
#include "app/commands/progress.h"
#include "app/commands/recorded.h"
#include "app/commands/without_depth.h"
#include "app/source.h"
#include "app/viewer.h"
#include "base/message.h"
#include "demos/demos.h"
#include "display/png.h"

namespace app {
namespace {

struct RenderOptions {
  std::string scene, output, directory = "out", camera, shown;
  bool all = false;
  std::optional<std::uint64_t> frame;
  SourceOptions source_options;
  scene::Knobs knobs;
  CameraOffset view;  // what `camera` says

  [[nodiscard]] std::int64_t scene_frame() const { return static_cast<std::int64_t>(frame.value_or(0)); }
};

// Draws one frame, writes it, and says in one line what was drawn.
base::Result<void> render_one(scene::Scene scene, const RenderOptions& options,
                              const std::filesystem::path& output) {
  const std::string name = scene.name;
  Viewer machine(std::move(scene), options.knobs);
  for (const auto& line : machine.report()) base::warn("otter: " + name, line);
  std::optional<Interrupt> interrupt;  // nothing but the search of bsp looks whether it was asked
  std::optional<Progress> search;
  if (options.knobs.visibility == scene::Visibility::bsp) {
    interrupt.emplace();
    search.emplace("order", 1000);
    machine.set_keep_going([&search](double done) {
      search->at(static_cast<std::size_t>(done * 1000));
      return !Interrupt::was_asked();
    });
  }
  const auto stats = machine.draw(options.scene_frame(), options.knobs, options.view);
  if (!stats) return tl::make_unexpected(stats.error());
  const auto picture = machine.picture();
  if (auto written = display::write_png(output, picture); !written) return written;
  std::printf("%s: %s frame %lld, %dx%d, %u primitives; GTE %.2f ms, OT %.2f ms, raster %.2f ms\n",
              base::printable(output.string()).c_str(), base::printable(name).c_str(),
              static_cast<long long>(options.scene_frame()), picture.width, picture.height, stats->primitives,
              stats->gte_ms, stats->ot_ms, stats->raster_ms);
  if (stats->was_stopped) {
    return base::fail("interrupted: " + output.string() + " shows an order that is not finished",
                      base::Exit::interrupted);
  }
  return {};
}

// The same for a frame of a dump, or the list of a RAM image.
base::Result<void> render_recording(Source source, const RenderOptions& options) {
  auto knobs = options.knobs;
  if (knobs.without_depth == scene::Knobs().without_depth) knobs.without_depth = foreign_without_depth;
  const std::uint64_t frame = options.frame.value_or(1);
  const auto timeline = open_at_frame(source, knobs, frame, DrawnTo::canvas);
  if (!timeline) return tl::make_unexpected(timeline.error());
  const auto picture =
      recorded_picture(**timeline, options.scene, frame, knobs, shown_named(options.shown), options.output);
  if (!picture) return tl::make_unexpected(picture.error());
  if (auto written = display::write_png(options.output, *picture); !written) return written;
  std::printf("%s: %s frame %llu, %dx%d, %llu commands\n", base::printable(options.output).c_str(),
              base::printable(options.scene).c_str(), static_cast<unsigned long long>(frame), picture->width,
              picture->height, static_cast<unsigned long long>((*timeline)->commands_in(frame)));
  return {};
}

base::Result<int> render_all(const RenderOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(options.directory, error);
  if (error) {
    return base::fail("--directory " + options.directory + ": cannot be made: " + error.message(),
                      base::Exit::failed);
  }
  const auto begin = std::chrono::steady_clock::now();
  Progress progress("render", demos::all().size());
  for (const auto& demo : demos::all()) {
    const auto output = std::filesystem::path(options.directory) / (std::string(demo.name) + ".png");
    if (auto done = render_one(demos::make(demo), options, output); !done)
      return tl::make_unexpected(done.error());
    progress.step();
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::printf("%zu scenes rendered in %.1f s\n", demos::all().size(), taken.count());
  return 0;
}

base::Result<int> render(RenderOptions& options) {
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  if (!options.camera.empty()) {
    const auto camera = parse_camera(options.camera);
    if (!camera) return tl::make_unexpected(camera.error());
    options.view.from = *camera;
  }
  if (options.all) {
    if (!options.scene.empty()) return base::fail("--all: expected no scene beside it, got " + options.scene);
    if (!options.output.empty()) return base::fail("--all: expected --directory DIR, not --output FILE");
    return render_all(options);
  }
  if (options.scene.empty())
    return base::fail("expected SCENE or FILE, or --all; the scenes are " + scene_names());
  if (options.output.empty())
    return base::fail("--output: expected the PNG file to write, as -o " + options.scene + ".png");
  auto source = open_source(options.scene, options.source_options);
  if (!source) return tl::make_unexpected(source.error());
  if (source->is_recording() && !options.camera.empty())
    return base::fail("--camera: " + options.scene + " is a recording, whose views are drawn already");
  const auto done = source->is_recording() ? render_recording(std::move(*source), options)
                                           : render_one(std::move(*source->scene), options, options.output);
  if (!done) return tl::make_unexpected(done.error());
  return 0;
}

}  // namespace

Action add_render(Arguments arguments) {
  const auto options = std::make_shared<RenderOptions>();
  arguments.positional(
      "scene", "SCENE|FILE", options->scene,
      "a scene of `otter list`, an .obj or .x3d file, a GPU dump, or a RAM image with --head");
  arguments.text("-o,--output", "FILE", options->output, "the PNG file to write");
  arguments.number("--frame", "N", options->frame, std::uint64_t{0}, std::uint64_t{1'000'000'000},
                   "of a scene the state after N/60 s [0], of a recording from 1 [1]");
  arguments.text("--camera", "X,Y,Z,YAW,PITCH", options->camera,
                 "stand there instead: world units and degrees, 0,0 looks along -z");
  arguments.flag("--all", options->all, "render every scene of `otter list`");
  arguments.text("-d,--directory", "DIR", options->directory, "with --all: where to write SCENE.png [out]");
  add_shown_option(arguments, options->shown);
  add_source_options(arguments, options->source_options);
  arguments.knobs(options->knobs);
  return [options] { return render(*options); };
}

}  // namespace app
