// otter record: a scene into a GPU dump.

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/open_scene.h"
#include "app/commands/progress.h"
#include "app/commands/recording.h"
#include "base/message.h"
#include "dump/dump_file.h"

namespace app {
namespace {

struct RecordOptions {
  std::string scene, output, format = "standard";
  std::uint32_t frames = 1;
  bool annotate = false;
  scene::Knobs knobs;
};

// A piece of a split polygon is its parent within limits, which packets cannot say.
void report(const SnapCost& cost) {
  std::printf("%llu pieces of split polygons were recorded as triangles of their own; ",
              static_cast<unsigned long long>(cost.pieces));
  if (cost.pixels == 0) {
    std::puts("the recording shows what the live frames show");
    return;
  }
  std::printf("%llu pixels differ from the live frames, by %u of 31 at most (most in frame %u: %llu)\n",
              static_cast<unsigned long long>(cost.pixels), cost.largest, cost.worst_frame,
              static_cast<unsigned long long>(cost.worst_pixels));
}

base::Result<int> record_scene(const RecordOptions& options) {
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  const auto scene = open_scene(options.scene);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto annotate = options.annotate ? scene::Annotate::always : scene::Annotate::when_needed;
  const auto format = options.format == "v1" ? dump::DumpFormat::v1 : dump::DumpFormat::standard;
  SnapCost snapped;
  std::uint64_t words = 0;
  std::uint32_t done = 0;
  const Interrupt interrupt;
  auto saved = dump::write_dump(options.output, format, [&](dump::DumpWriter& writer) -> base::Result<void> {
    Progress progress("record", options.frames);
    const auto recorded = record(*scene, options.frames, options.knobs, annotate, writer, [&] {
      progress.step();
      ++done;
      return !interrupt.was_asked();
    });
    if (!recorded) return tl::make_unexpected(recorded.error());
    snapped = *recorded;
    words = writer.words();
    return {};
  });
  if (!saved) return tl::make_unexpected(saved.error());
  std::printf("%s: %s, %u frames, %llu words\n", base::printable(options.output).c_str(),
              base::printable(scene->name).c_str(), done, static_cast<unsigned long long>(words));
  if (options.knobs.visibility == scene::Visibility::bsp) report(snapped);
  if (done < options.frames) {
    return base::fail("interrupted: the dump holds " + std::to_string(done) + " frames of " +
                          std::to_string(options.frames),
                      base::Exit::interrupted);
  }
  return 0;
}

}  // namespace

Action add_record(Arguments arguments) {
  const auto options = std::make_shared<RecordOptions>();
  arguments.positional("scene", "SCENE|FILE", options->scene, "a scene of `otter list`, or a file",
                       Presence::required);
  arguments.text("-o,--output", "FILE", options->output,
                 "the dump to write; packed if its name ends in .zst or .xz", Presence::required);
  arguments.number("--frames", "N", options->frames, std::uint32_t{1}, std::uint32_t{1'000'000},
                   "record frames 0..N-1 [1]");
  arguments.choice("--format", options->format, {"standard", "v1"},
                   "standard: v1r1, aligned; v1: the older form [standard]");
  arguments.flag("--annotate", options->annotate,
                 "write depths, so that the dump replays through the z-buffer, too");
  arguments.knobs(options->knobs);
  return [options] { return record_scene(*options); };
}

}  // namespace app
