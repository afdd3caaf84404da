// otter run: the window.

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/recorded.h"
#include "app/commands/without_depth.h"
#include "app/live.h"
#include "app/source.h"
#include "app/tape.h"
#include "app/viewer.h"
#include "app/window/sdl.h"
#include "app/window/settings.h"
#include "app/window/window.h"
#include "demos/demos.h"

namespace app {
namespace {

struct RunOptions {
  std::string scene, pace, camera, settings, shown, title;
  std::optional<int> live;
  SourceOptions source_options;
  std::vector<std::string> panels, named_knobs;
  WindowOptions window;
};

// What was remembered, then what the command line says.
base::Result<void> prepare(RunOptions& options) {
  auto& window = options.window;
  auto& first = window.first;
  window.settings = settings_file(options.settings, options.window.frames.has_value());
  const auto remembered = window.settings ? read_settings(*window.settings) : Settings{};
  begin_with(remembered, scene::Knobs(first.knobs), options.named_knobs, first);
  for (std::size_t i = 0; i < pace_words.size(); ++i) {
    if (options.pace == pace_words[i]) first.pace = static_cast<Pace>(i);
  }
  if (auto raised = raise_panels(options.panels, first.dock); !raised) return raised;
  if (options.camera.empty()) return {};
  const auto camera = parse_camera(options.camera);
  if (!camera) return tl::make_unexpected(camera.error());
  first.camera.from = *camera;
  return {};
}

// A file that is shown as often as it is chosen: it is read once, and recordings share their timeline.
base::Result<WindowScene> open_entry(const std::string& name, const SourceOptions& source_options,
                                     const scene::Knobs& knobs, const std::string& shown,
                                     std::int64_t frame) {
  auto source = open_source(name, source_options);
  if (!source) return tl::make_unexpected(source.error());
  if (source->scene) {
    const auto scene = std::make_shared<scene::Scene>(std::move(*source->scene));
    return WindowScene{name,
                       [scene](const scene::Knobs& now) {
                         return base::Result<std::unique_ptr<Subject>>(std::make_unique<Viewer>(*scene, now));
                       },
                       false};
  }
  scene::Knobs console;
  if (knobs.visibility == scene::Visibility::zbuffer) console.visibility = knobs.visibility;
  console.without_depth = foreign_without_depth;
  auto timeline = frame <= 1 ? open_timeline(*source, console)
                             : open_at_frame(*source, console, static_cast<std::uint64_t>(frame));
  if (!timeline) return tl::make_unexpected(timeline.error());
  (*timeline)->set_options({});  // the console; a z-buffer draws frame by frame
  const std::shared_ptr<debug::Timeline> shared = std::move(*timeline);
  const auto what = shown_named(shown);
  return WindowScene{
      name,
      [name, shared, what](const scene::Knobs& /*now*/) {
        return base::Result<std::unique_ptr<Subject>>(std::make_unique<Tape>(name, shared, what));
      },
      true};
}

// A program of another process, which ends when that does. Modes that it has not got are not remembered ones.
base::Result<int> run_live(RunOptions& options) {
  auto& window = options.window;
  auto& knobs = window.first.knobs;
  if (knobs.visibility != scene::Visibility::zbuffer) knobs.visibility = scene::Visibility::ot;
  const auto link = std::make_shared<LiveLink>(*options.live, [] {
    SDL_Event event{};
    event.type = SDL_USEREVENT;  // a window at rest looks again
    SDL_PushEvent(&event);
  });
  window.scenes.push_back({options.title.empty() ? "program" : options.title,
                           [link](const scene::Knobs& /*now*/) {
                             return base::Result<std::unique_ptr<Subject>>(std::make_unique<Live>(link));
                           },
                           true});
  window.first.live.is_live = true;
  set_visibility(window.first, knobs.visibility);
  return run_window(window);
}

// The demos, and before them a file if one was named; the one that was named is shown first.
base::Result<int> run(RunOptions& options) {
  auto& window = options.window;
  if (auto prepared = prepare(options); !prepared) return tl::make_unexpected(prepared.error());
  if (auto checked = scene::check_knobs(window.first.knobs); !checked)
    return tl::make_unexpected(checked.error());
  if (options.live) return run_live(options);
  if (!options.scene.empty() && demos::find(options.scene) == nullptr) {
    // Now, so that a bad file opens no window.
    auto entry = open_entry(options.scene, options.source_options, window.first.knobs, options.shown,
                            window.first.frame);
    if (!entry) return tl::make_unexpected(entry.error());
    // A remembered mode that recordings have not got must not keep one from being opened.
    const auto& named = options.named_knobs;
    auto& visibility = window.first.knobs.visibility;
    const bool is_named = std::find(named.begin(), named.end(), "visibility") != named.end();
    if (entry->is_recording && !is_named && visibility != scene::Visibility::zbuffer) {
      visibility = scene::Visibility::ot;
    }
    window.scenes.push_back(std::move(*entry));
  } else if (!options.source_options.head.empty()) {
    return base::fail("--head: expected a RAM image before it");
  }
  window.open = [shown = options.shown, knobs = window.first.knobs](const std::string& path) {
    return open_entry(path, {}, knobs, shown, 1);
  };
  for (const auto& demo : demos::all()) {
    if (demo.name == options.scene) window.first.scene = static_cast<int>(window.scenes.size());
    window.scenes.push_back({std::string(demo.name), [&demo](const scene::Knobs& knobs) {
                               return base::Result<std::unique_ptr<Subject>>(
                                   std::make_unique<Viewer>(demos::make(demo), knobs));
                             }});
  }
  window.first.scenes = static_cast<int>(window.scenes.size());
  set_visibility(window.first, window.first.knobs.visibility);
  return run_window(window);
}

}  // namespace

Action add_run(Arguments arguments) {
  const auto options = std::make_shared<RunOptions>();
  auto& window = options->window;
  arguments.positional(
      "scene", "SCENE|FILE", options->scene,
      "a scene of `otter list` [the first], a scene file, a GPU dump, or with --head a RAM image");
  add_source_options(arguments, options->source_options);
  arguments.choice("--pace", options->pace, {"vsync", "60", "50", "slow"},
                   "frames with the screen, or at a fixed rate [as last time, at first vsync]");
  arguments.number("--scale", "1..16", window.scale, 1, 16, "screen pixels for each pixel at first [3]");
  arguments.flag("--fullscreen", window.first.fullscreen, "fill the screen");
  arguments.flag("--split", window.first.split, "begin with both pictures, side by side");
  arguments.flag("--differences", window.first.differences, "begin with differing pixels marked");
  arguments.number("--frame", "N", window.first.frame, std::int64_t{0}, std::int64_t{1'000'000'000},
                   "begin with frame N, the state after N/60 s [0]");
  arguments.choice("--shown", options->shown, {"drawn", "display"},
                   "recording: what is drawn to, or what the display shows [the latter, unless the frame "
                   "draws beside it]");
  arguments.flag("--paused", window.first.paused, "begin at rest");
  arguments.text("--camera", "X,Y,Z,YAW,PITCH", options->camera,
                 "stand there instead: world units and degrees, 0,0 looks along -z");
  arguments.words("--panel", "NAME,...", options->panels,
                  "begin with these panels: knobs, inspect, cost ...");
  arguments.text("--settings", "PATH|none", options->settings,
                 "what is remembered between runs [~/.config/otter/window.json; none with --frames]");
  arguments.number("--live", "FD", options->live, 3, 1 << 20,
                   "a program in an emulator: the plugin's end of this socket sends its frames");
  arguments.text("--title", "TEXT", options->title, "with --live: what the program is called");
  arguments.number("--frames", "N", window.frames, 1, 1'000'000'000, "quit after N frames");
  arguments.text("--screenshot", "FILE", window.screenshot,
                 "with --frames: write the window's last frame there");
  arguments.knobs(window.first.knobs, {}, &options->named_knobs);
  arguments.footer([] { return key_help(); });
  return [options] { return run(*options); };
}

}  // namespace app
