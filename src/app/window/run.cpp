// otter run: the window.

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/open_scene.h"
#include "app/window/window.h"
#include "demos/demos.h"

namespace app {
namespace {

struct RunOptions {
  std::string scene, pace = "vsync";
  WindowOptions window;
};

// The demos, and before them a file if one was named; the one that was named is shown first.
base::Result<int> run(RunOptions& options) {
  auto& window = options.window;
  if (auto checked = scene::check_knobs(window.first.knobs); !checked)
    return tl::make_unexpected(checked.error());
  if (!options.scene.empty() && demos::find(options.scene) == nullptr) {
    auto scene = open_scene(options.scene);  // now, so that a bad file opens no window
    if (!scene) return tl::make_unexpected(scene.error());
    const auto shared = std::make_shared<scene::Scene>(std::move(*scene));
    window.scenes.push_back({options.scene, [shared] { return base::Result<scene::Scene>(*shared); }});
  }
  for (const auto& demo : demos::all()) {
    if (demo.name == options.scene) window.first.scene = static_cast<int>(window.scenes.size());
    window.scenes.push_back(
        {std::string(demo.name), [&demo] { return base::Result<scene::Scene>(demos::make(demo)); }});
  }
  window.first.scenes = static_cast<int>(window.scenes.size());
  window.first.pace = options.pace == "60" ? Pace::hz60 : options.pace == "50" ? Pace::hz50 : Pace::vsync;
  set_visibility(window.first, window.first.knobs.visibility);
  return run_window(window);
}

}  // namespace

Action add_run(Arguments arguments) {
  const auto options = std::make_shared<RunOptions>();
  auto& window = options->window;
  arguments.positional("scene", "SCENE|FILE", options->scene,
                       "a scene of `otter list` [the first], or an .obj or .x3d file");
  arguments.choice("--pace", options->pace, {"vsync", "60", "50"},
                   "frames with the screen, or at a fixed rate [vsync]");
  arguments.number("--scale", "1..16", window.scale, 1, 16, "screen pixels for each pixel at first [3]");
  arguments.flag("--fullscreen", window.first.fullscreen, "fill the screen");
  arguments.flag("--split", window.first.split, "begin with both pictures, side by side");
  arguments.flag("--differences", window.first.differences, "begin with differing pixels marked");
  arguments.number("--frames", "N", window.frames, 1, 1'000'000'000, "quit after N frames");
  arguments.text("--screenshot", "FILE", window.screenshot,
                 "with --frames: write the window's last frame there");
  arguments.knobs(window.first.knobs);
  arguments.footer([] { return key_help(); });
  return [options] { return run(*options); };
}

}  // namespace app
