#include "sdk/program_window.h"

#include <memory>
#include <utility>

#include "app/commands/without_depth.h"
#include "app/window/settings.h"
#include "app/window/window.h"
#include "base/write_file.h"
#include "sdk/include/psxpad.h"
#include "sdk/program_run.h"
#include "sdk/program_subject.h"

namespace sdk {
namespace {

// The window's keys and the SDK's header name the same bits.
constexpr bool agrees(std::string_view name, unsigned bit) {
  for (const auto& key : app::pad_keys) {
    if (key.name == name) return key.button == bit;
  }
  return false;
}
static_assert(agrees("up", PAD_UP) && agrees("right", PAD_RIGHT) && agrees("down", PAD_DOWN) &&
              agrees("left", PAD_LEFT) && agrees("triangle", PAD_TRIANGLE) && agrees("circle", PAD_CIRCLE) &&
              agrees("cross", PAD_CROSS) && agrees("square", PAD_SQUARE) && agrees("L1", PAD_L1) &&
              agrees("L2", PAD_L2) && agrees("R1", PAD_R1) && agrees("R2", PAD_R2) &&
              agrees("start", PAD_START) && agrees("select", PAD_SELECT));

}  // namespace

base::Result<int> show_in_window(const Settings& settings, const std::string& name) {
  app::WindowOptions options;
  auto& first = options.first;
  const auto& asked = settings.window;
  options.settings = app::settings_file(asked.settings, asked.quit_after.has_value());
  const auto remembered = options.settings ? app::read_settings(*options.settings) : app::Settings{};
  app::begin_with(remembered, settings.knobs, asked.named_knobs, first);
  if (first.knobs.visibility != scene::Visibility::zbuffer) first.knobs.visibility = scene::Visibility::ot;
  app::set_visibility(first, first.knobs.visibility);
  first.frame = asked.frame;
  first.paused = asked.is_paused;
  first.split = asked.is_split;
  if (auto opened = app::raise_panels(asked.panels, first.dock); !opened)
    return tl::make_unexpected(opened.error());
  options.scale = asked.scale;
  options.frames = asked.quit_after;
  options.screenshot = asked.screenshot;
  const auto run = std::make_shared<ProgramRun>(settings, name);
  options.scenes.push_back({name,
                            [run, shown = settings.shown](const scene::Knobs& /*now*/) {
                              return base::Result<std::unique_ptr<app::Subject>>(
                                  std::make_unique<ProgramSubject>(run, shown));
                            },
                            true});
  auto status = app::run_window(options);
  if (!status) return status;
  if (const auto ending = run->ending(); !ending.empty())
    std::fprintf(stderr, "%s: %s\n", name.c_str(), ending.c_str());
  if (!settings.pad_log.empty()) {
    if (auto done = base::write_file(settings.pad_log, run->pad_log() + "\n"); !done)
      return tl::make_unexpected(done.error());
  }
  return status;
}

}  // namespace sdk
