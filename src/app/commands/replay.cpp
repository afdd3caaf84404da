// otter replay: a GPU dump into VRAM.

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/expect.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/recorded.h"
#include "app/commands/shown.h"
#include "app/commands/without_depth.h"
#include "app/source.h"
#include "base/message.h"
#include "base/write_file.h"
#include "debug/list.h"
#include "debug/timeline.h"
#include "display/png.h"
#include "display/vram_file.h"
#include "dump/dump_file.h"
#include "dump/frames.h"
#include "scene/plan.h"

namespace app {
namespace {

struct ReplayOptions {
  std::string dump, vram, output, readback, until, json, frame_by, shown;
  std::optional<std::uint64_t> frame;
  std::uint64_t repeat = 0;
  bool list = false;
  ExpectOptions expect;
  scene::Knobs knobs;

  /// --frame counts frames, as --frame-by display says; otherwise VSync packets.
  [[nodiscard]] bool counts_frames() const { return frame_by == dump::frame_by_names[0]; }
};

base::Result<void> check_options(const ReplayOptions& options) {
  if (!options.json.empty() && !options.list && !options.expect.is_asked())
    return base::fail("--json: expected --list, --expect or --expect-frames beside it");
  if (!options.json.empty() && options.list && options.expect.is_asked())
    return base::fail("--json: expected either --list or --expect beside it");
  if (!options.expect.expect.empty() && !options.expect.frames.empty())
    return base::fail("--expect-frames: expected no --expect beside it");
  if (asks_for_canvas(options.knobs)) {
    if (options.output.empty() || !options.until.empty())
      return base::fail(std::string(canvas_knobs) +
                        ": expected -o FILE and no --until beside it: they draw whole frames on a canvas");
    if (options.frame && !options.counts_frames())
      return base::fail(std::string(canvas_knobs) + ": expected --frame-by display beside --frame");
  }
  if (!options.expect.is_asked() && !(options.expect.mask.empty() && options.expect.difference.empty()))
    return base::fail("--mask, --difference: expected --expect or --expect-frames beside it");
  return {};
}

/// Where a replay ends, as --frame and --until say.
struct End {
  dump::ReplayOptions limits;
  debug::Number moment;
};

void make_earlier(debug::Number& moment, const debug::Number& other) {
  if (gpu::is_before(other, moment)) moment = other;
}

/// --until K counts drawing commands, --until F:K all of frame F.
base::Result<void> put_until(const ReplayOptions& options, debug::Timeline& timeline, End& end) {
  const auto& dump = timeline.dump();
  if (const auto number = debug::parse_number(options.until)) {
    if (number->frame < 1 || number->frame > timeline.frames() || number->command < 1 ||
        number->command > timeline.commands_in(number->frame)) {
      const bool has_frame = number->frame >= 1 && number->frame <= timeline.frames();
      return base::fail("--until " + options.until + ": " + options.dump + " has " +
                        (has_frame ? std::to_string(timeline.commands_in(number->frame)) +
                                         " commands in frame " + std::to_string(number->frame)
                                   : std::to_string(timeline.frames()) + " frames"));
    }
    const auto place = timeline.commands(number->frame)[number->command - 1].end;
    make_earlier(end.moment, *number);
    end.limits.end_packet = place.packet;
    end.limits.end_words = place.word;
    return {};
  }
  std::uint64_t drawing = 0;
  const auto [rest, error] =
      std::from_chars(options.until.data(), options.until.data() + options.until.size(), drawing);
  if (error != std::errc() || rest != options.until.data() + options.until.size() || drawing == 0)
    return base::fail("--until: expected the number of a drawing command, from 1, or F:K, got " +
                      options.until);
  if (drawing > dump.drawing_commands) {
    return base::fail("--until " + options.until + ": " + options.dump + " has " +
                      std::to_string(dump.drawing_commands) + " drawing commands");
  }
  end.limits.until = drawing;
  make_earlier(end.moment, *timeline.find_drawing(drawing));
  return {};
}

base::Result<End> end_of(const ReplayOptions& options, debug::Timeline& timeline) {
  const auto& dump = timeline.dump();
  const std::uint64_t most = options.counts_frames() ? timeline.frames() : dump.vsyncs;
  if (options.frame && *options.frame > most) {
    return base::fail("--frame " + std::to_string(*options.frame) + ": " + options.dump + " has " +
                      std::to_string(most) + (options.counts_frames() ? " frames" : " VSync packets"));
  }
  End end{.limits = {}, .moment = {timeline.frames(), debug::whole_frame}};
  if (options.frame && options.counts_frames()) {
    end.moment.frame = *options.frame;
    end.limits.end_packet = timeline.frame(*options.frame).end_packet;
  } else if (options.frame) {
    end.moment = timeline.at_vsync(*options.frame);
    end.limits.frame = options.frame;
  }
  if (options.until.empty()) return end;
  return put_until(options, timeline, end).map([&] { return end; });
}

base::Result<void> list(const ReplayOptions& options, debug::Timeline& timeline, const debug::Number& end) {
  if (options.json.empty()) {
    debug::list_text(timeline, end, [](const std::string& line) { std::puts(line.c_str()); });
    return {};
  }
  const auto write_to = [&](std::FILE* file) -> base::Result<void> {
    debug::list_json(timeline, options.dump, end,
                     [file](const std::string& text) { std::fwrite(text.data(), 1, text.size(), file); });
    return {};
  };
  return options.json == "-" ? write_to(stdout) : base::write_file(options.json, write_to);
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

/// What `gpu` shows; with knobs that VRAM cannot hold, the frame it ended with drawn anew.
base::Result<base::Picture> picture_of(const ReplayOptions& options, debug::Timeline& timeline,
                                       const gpu::Gpu& gpu) {
  const auto shown = shown_named(options.shown);
  if (asks_for_canvas(options.knobs)) {
    return recorded_picture(timeline, options.dump, options.frame.value_or(timeline.frames()), options.knobs,
                            shown, options.output);
  }
  if (shown == Shown::drawn) return picture_of_clip({}, gpu, shown_area(gpu, shown), options.knobs);
  return shown_picture(gpu, options.output);
}

base::Result<void> save(const ReplayOptions& options, debug::Timeline& timeline, const gpu::Gpu& gpu,
                        const std::vector<std::uint32_t>& readback) {
  if (!options.vram.empty()) {
    if (auto written = display::save_vram(options.vram, gpu.vram()); !written) return written;
  }
  if (!options.output.empty()) {
    const auto picture = picture_of(options, timeline, gpu);
    if (!picture) return tl::make_unexpected(picture.error());
    if (auto written = display::write_png(options.output, *picture); !written) return written;
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
  if (auto checked = check_options(options); !checked) return tl::make_unexpected(checked.error());
  if (auto checked = check_without_depth(options.dump, options.knobs, false); !checked)
    return tl::make_unexpected(checked.error());
  auto read = dump::read_dump(options.dump);
  if (!read) return tl::make_unexpected(read.error());
  debug::Timeline timeline(debug::Recording(std::move(*read)), draw_options(options.knobs));
  const auto& dump = timeline.dump();
  timeline.end_frames_by(dump::frame_by_named(options.frame_by));
  const auto end = end_of(options, timeline);
  if (!end) return tl::make_unexpected(end.error());
  if (dump.gpu_version == 3) {
    base::warn("otter replay", options.dump + ": made for 2 MB of VRAM, drawn with 1 MB");
  }
  if (options.list) {
    if (auto listed = list(options, timeline, end->moment); !listed)
      return tl::make_unexpected(listed.error());
  } else if (options.json != "-") {
    print_summary(options.dump, dump);
  }
  dump::ReplayOptions limits = end->limits;
  limits.frames = &timeline.frame_ends();
  std::vector<std::uint32_t> readback;
  gpu::Gpu gpu;
  gpu.set_depth(scene::depth_options(options.knobs));
  limits.readback = options.readback.empty() ? nullptr : &readback;
  const Interrupt interrupt;
  Progress progress("replay", dump.words.size());
  limits.keep_going = [&](std::uint64_t words) {
    progress.at(words);
    return !interrupt.was_asked();
  };
  const auto replayed = dump::replay(dump, gpu, limits);
  if (auto judged = judge_without_depth(options.dump, options.knobs, replayed); !judged)
    return tl::make_unexpected(judged.error());
  if (auto saved = save(options, timeline, gpu, readback); !saved) return tl::make_unexpected(saved.error());
  if (interrupt.was_asked()) {
    return base::fail("interrupted: what was drawn until then is written", base::Exit::interrupted);
  }
  limits.readback = nullptr;
  limits.keep_going = {};
  if (options.repeat > 0) {
    std::printf("ns_per_replay %llu\n", static_cast<unsigned long long>(
                                            best_nanoseconds(dump, limits, options.knobs, options.repeat)));
  }
  if (!options.expect.is_asked()) return 0;
  auto expect = options.expect;
  expect.json = options.json;
  return check_expected(expect, options.dump, timeline, end->moment, [&] { return !interrupt.was_asked(); })
      .map([](bool is_good) { return is_good ? 0 : static_cast<int>(base::Exit::failed); });
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
  arguments.choice(
      "--frame-by", options->frame_by, {"display", "vsync"},
      "what ends the frames of F:K and of a z-buffer [display], and what --frame counts [vsync]: "
      "the display shows another buffer, or a VSync");
  arguments.text("--until", "K|F:K", options->until,
                 "stop after the Kth drawing command, or after command K of frame F, both from 1");
  arguments.number("--repeat", "N", options->repeat, std::uint64_t{1}, std::uint64_t{1'000'000'000},
                   "replay N times more and print ns_per_replay, the fastest");
  arguments.flag("--list", options->list, "print every command in words, with its number F:K");
  arguments.text_or("--json", "FILE", options->json, "-",
                    "with --list or --expect: the report as JSON; no FILE or -: standard output");
  add_expect_options(arguments, options->expect);
  arguments.text("--readback", "FILE", options->readback, "write the words that the dump reads back");
  options->knobs.without_depth = foreign_without_depth;
  add_shown_option(arguments, options->shown);
  arguments.knobs(options->knobs, recording_knobs);
  return [options] { return replay(*options); };
}

}  // namespace app
