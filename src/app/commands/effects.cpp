// otter effects: which effects a frame calls for, and the price of each.

#include "cost/effects.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/recorded.h"
#include "app/source.h"
#include "base/write_file.h"

namespace app {
namespace {

struct EffectsOptions {
  std::string scene, json;
  std::optional<std::uint64_t> frame;
  SourceOptions source_options;
  scene::Knobs knobs;
};

base::Result<cost::EffectReport> effects_of(Source& source, const EffectsOptions& options,
                                            const cost::KeepGoing& keep_going) {
  if (!source.is_recording())
    return cost::find_effects(*source.scene, static_cast<std::uint32_t>(options.frame.value_or(0)),
                              options.knobs, 0, keep_going);
  const std::uint64_t frame = options.frame.value_or(1);
  const auto timeline = open_at_frame(source, options.knobs, frame);
  if (!timeline) return tl::make_unexpected(timeline.error());
  return cost::find_effects(recorded_frame(**timeline, options.scene, frame), 0, keep_going);
}

base::Result<int> run_effects(const EffectsOptions& options) {
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  auto source = open_source(options.scene, options.source_options);
  if (!source) return tl::make_unexpected(source.error());
  const Interrupt interrupt;
  Progress progress("effects", 1000);
  const auto report = effects_of(*source, options, [&](std::size_t done, std::size_t all) {
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
  arguments.positional("scene", "SCENE|FILE", options->scene,
                       "a scene of `otter list`, a scene file, a GPU dump, or a RAM image with --head",
                       Presence::required);
  arguments.number("--frame", "N", options->frame, std::uint64_t{0}, std::uint64_t{1'000'000'000},
                   "of a scene the state after N/60 s [0], of a recording from 1 [1]");
  arguments.text("--json", "FILE", options->json, "write the report as JSON; - is standard output");
  add_source_options(arguments, options->source_options);
  arguments.knobs(options->knobs);
  return [options] { return run_effects(*options); };
}

}  // namespace app
