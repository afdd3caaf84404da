// otter effects: which effects a frame calls for, and the price of each.

#include "cost/effects.h"

#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/open_scene.h"
#include "app/commands/progress.h"
#include "base/write_file.h"

namespace app {
namespace {

struct EffectsOptions {
  std::string scene, json;
  std::uint32_t frame = 0;
  scene::Knobs knobs;
};

base::Result<int> run_effects(const EffectsOptions& options) {
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  const auto scene = open_scene(options.scene);
  if (!scene) return tl::make_unexpected(scene.error());
  const Interrupt interrupt;
  Progress progress("effects", 1000);
  const auto report =
      cost::find_effects(*scene, options.frame, options.knobs, 0, [&](std::size_t done, std::size_t all) {
        progress.at(done * 1000 / all);
        return !interrupt.was_asked();
      });
  if (!report) return tl::make_unexpected(report.error());
  if (!options.json.empty() && options.json != "-") {
    if (auto written = base::write_file(options.json, cost::to_json(*report)); !written) {
      return tl::make_unexpected(written.error());
    }
  }
  const auto text = options.json == "-" ? cost::to_json(*report) : cost::to_text(*report);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    return base::fail("standard output: cannot be written", base::Exit::failed);
  }
  if (!report->is_complete) {
    return base::fail("interrupted: the report holds what was measured until then", base::Exit::interrupted);
  }
  return 0;
}

}  // namespace

Action add_effects(Arguments arguments) {
  const auto options = std::make_shared<EffectsOptions>();
  arguments.positional("scene", "SCENE|FILE", options->scene, "a scene of `otter list`, or a file",
                       Presence::required);
  arguments.number("--frame", "N", options->frame, std::uint32_t{0}, std::uint32_t{1'000'000'000},
                   "frame N shows the scene after N/60 s [0]");
  arguments.text("--json", "FILE", options->json, "write the report as JSON; - is standard output");
  arguments.knobs(options->knobs);
  return [options] { return run_effects(*options); };
}

}  // namespace app
