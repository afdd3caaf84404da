// otter replay: a GPU dump into VRAM.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/without_depth.h"
#include "base/message.h"
#include "base/write_file.h"
#include "display/png.h"
#include "display/scanout.h"
#include "display/vram_file.h"
#include "dump/dump_file.h"
#include "dump/frames.h"
#include "scene/plan.h"

namespace app {
namespace {

struct ReplayOptions {
  std::string dump, vram, output, readback, frame_by;
  std::optional<std::uint64_t> frame, until;
  std::uint64_t repeat = 0;
  bool list = false;
  scene::Knobs knobs;

  /// --frame counts frames; false: VSync packets.
  [[nodiscard]] bool counts_frames() const { return frame_by == dump::frame_by_names[0]; }
};

base::Result<void> check(const ReplayOptions& options, const dump::Dump& dump, const dump::Frames& frames) {
  const bool by_display = options.counts_frames();
  const std::uint64_t most = by_display ? frames.count() : dump.vsyncs;
  if (options.frame && *options.frame > most) {
    return base::fail("--frame " + std::to_string(*options.frame) + ": " + options.dump + " has " +
                      std::to_string(most) + (by_display ? " frames" : " VSync packets"));
  }
  if (options.until && *options.until > dump.drawing_commands) {
    return base::fail("--until " + std::to_string(*options.until) + ": " + options.dump + " has " +
                      std::to_string(dump.drawing_commands) + " drawing commands");
  }
  return {};
}

/// The fastest of `rounds` replays, each from the initial state, which is made outside the timed part.
std::uint64_t best_nanoseconds(const dump::Dump& dump, const dump::ReplayOptions& limits,
                               const scene::Knobs& knobs, std::uint64_t rounds) {
  using Clock = std::chrono::steady_clock;
  auto best = Clock::duration::max();
  for (std::uint64_t n = 0; n < rounds; ++n) {
    gpu::Gpu gpu;
    gpu.set_depth(scene::depth_options(knobs));
    const auto begin = Clock::now();
    dump::replay(dump, gpu, limits);
    best = std::min(best, Clock::now() - begin);
  }
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(best).count());
}

base::Result<void> save(const ReplayOptions& options, const gpu::Gpu& gpu,
                        const std::vector<std::uint32_t>& readback) {
  if (!options.vram.empty()) {
    if (auto written = display::save_vram(options.vram, gpu.vram()); !written) return written;
  }
  if (!options.output.empty()) {
    const display::Area area = display::area_of(gpu.display());
    if (area.width <= 0 || area.height <= 0) {
      return base::fail(options.output + ": the dump leaves an empty display area (" +
                            std::to_string(area.width) + " x " + std::to_string(area.height) +
                            " pixels), expected GP1(06h) and GP1(07h) with a range; --vram has the rest",
                        base::Exit::failed);
    }
    const auto picture = display::scan_out(gpu.vram().pixels(), area);
    if (auto written = display::write_png(options.output, picture); !written) return written;
  }
  if (options.readback.empty()) return {};
  return base::write_file(options.readback, [&](std::FILE* file) -> base::Result<void> {
    for (const auto word : readback) {
      for (int shift = 0; shift < 32; shift += 8) std::putc(static_cast<int>(word >> shift & 0xff), file);
    }
    return {};
  });
}

void print_summary(const std::string& name, const dump::Dump& dump) {
  std::printf("%s: %s, %llu packets, %llu VSyncs, %llu drawing commands\n", base::printable(name).c_str(),
              dump.format == dump::DumpFormat::v1 ? "v1" : "v1r1",
              static_cast<unsigned long long>(dump.packets.size() + dump.empty_packets),
              static_cast<unsigned long long>(dump.vsyncs),
              static_cast<unsigned long long>(dump.drawing_commands));
}

base::Result<int> replay(const ReplayOptions& options) {
  const auto visibility = options.knobs.visibility;
  if (visibility != scene::Visibility::ot && visibility != scene::Visibility::zbuffer) {
    return base::fail("--visibility: a dump can be drawn by ot, in its own order, or by zbuffer");
  }
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  if (auto checked = check_without_depth(options.dump, options.knobs, false); !checked)
    return tl::make_unexpected(checked.error());
  auto dump = dump::read_dump(options.dump);
  if (!dump) return tl::make_unexpected(dump.error());
  const bool by_vsync = options.frame_by == dump::frame_by_names[1];
  const dump::Frames frames(*dump, by_vsync ? dump::FrameBy::vsync : dump::FrameBy::display);
  if (auto checked = check(options, *dump, frames); !checked) return tl::make_unexpected(checked.error());
  if (dump->gpu_version == 3) {
    base::warn("otter replay", options.dump + ": made for 2 MB of VRAM, drawn with 1 MB");
  }

  dump::ReplayOptions limits{.until = options.until, .frames = &frames};
  if (options.frame && options.counts_frames()) {
    limits.end_packet = frames.end(*options.frame);
  } else {
    limits.frame = options.frame;
  }
  if (options.list) {
    dump::list_dump(*dump, limits, [](const std::string& line) { std::puts(line.c_str()); });
  } else {
    print_summary(options.dump, *dump);
  }
  std::vector<std::uint32_t> readback;
  gpu::Gpu gpu;
  gpu.set_depth(scene::depth_options(options.knobs));
  limits.readback = options.readback.empty() ? nullptr : &readback;
  const Interrupt interrupt;
  Progress progress("replay", dump->words.size());
  limits.keep_going = [&](std::uint64_t words) {
    progress.at(words);
    return !interrupt.was_asked();
  };
  const auto end = dump::replay(*dump, gpu, limits);
  if (auto judged = judge_without_depth(options.dump, options.knobs, end); !judged)
    return tl::make_unexpected(judged.error());
  if (auto saved = save(options, gpu, readback); !saved) return tl::make_unexpected(saved.error());
  if (interrupt.was_asked()) {
    return base::fail("interrupted: what was drawn until then is written", base::Exit::interrupted);
  }
  limits.readback = nullptr;
  limits.keep_going = {};
  if (options.repeat > 0) {
    std::printf("ns_per_replay %llu\n", static_cast<unsigned long long>(
                                            best_nanoseconds(*dump, limits, options.knobs, options.repeat)));
  }
  return 0;
}

}  // namespace

Action add_replay(Arguments arguments) {
  const auto options = std::make_shared<ReplayOptions>();
  constexpr std::uint64_t most = std::uint64_t{1} << 40;
  arguments.positional("dump", "DUMP", options->dump,
                       "a GPU dump (v1r1 or v1), plain or packed as .zst or .xz", Presence::required);
  arguments.text("--vram", "FILE", options->vram,
                 "write all of VRAM: FILE.png, or 1 MiB of little-endian halfwords");
  arguments.text("-o,--output", "FILE", options->output, "write the display area as a PNG");
  arguments.number("--frame", "N", options->frame, std::uint64_t{1}, most,
                   "stop at the Nth VSync packet, from 1; with --frame-by display, after the Nth frame");
  arguments.choice("--frame-by", options->frame_by, {"display", "vsync"},
                   "what --frame counts [vsync], and where the frames of a z-buffer end [display]: where the "
                   "display shows another buffer, or at every VSync");
  arguments.number("--until", "K", options->until, std::uint64_t{1}, most,
                   "stop after the Kth drawing command, from 1");
  arguments.number("--repeat", "N", options->repeat, std::uint64_t{1}, std::uint64_t{1'000'000'000},
                   "replay N times more and print ns_per_replay, the fastest");
  arguments.flag("--list", options->list, "print every command in words");
  arguments.text("--readback", "FILE", options->readback, "write the words that the dump reads back");
  options->knobs.without_depth = foreign_without_depth;
  arguments.knobs(options->knobs, {"visibility", "depth", "depth-mapping", "depth-test", "depth-reversed",
                                   "near", "far", "without-depth"});
  return [options] { return replay(*options); };
}

}  // namespace app
