#include "app/source.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/commands/open_scene.h"
#include "app/commands/ram_image.h"
#include "app/commands/without_depth.h"
#include "app/tape.h"
#include "base/file_kind.h"
#include "base/message.h"
#include "demos/demos.h"
#include "ot/main_ram.h"
#include "scene/plan.h"

namespace app {
namespace {

bool has_size_of_ram(const std::string& name) {
  std::error_code error;
  const auto size = std::filesystem::file_size(name, error);
  return !error && (size == static_cast<std::uintmax_t>(ot::RamSize::mib2) ||
                    size == static_cast<std::uintmax_t>(ot::RamSize::mib8));
}

base::Result<Source> open_ram(const std::string& name, const SourceOptions& options) {
  auto image = read_ram_image(name, options.head, options.table);
  if (!image) return tl::make_unexpected(image.error());
  auto vram = read_vram(options.vram_in);
  if (!vram) return tl::make_unexpected(vram.error());
  auto recording = debug::Recording::of_list(std::move(*image), std::move(*vram));
  if (!recording) return base::fail(name + ": " + recording.error().text);
  return Source{name, std::nullopt, std::move(*recording)};
}

base::Result<void> check_no_ram_options(const std::string& name, const SourceOptions& options) {
  if (options.head.empty() && !(options.table.empty() && options.vram_in.empty()))
    return base::fail(name + ": --table and --vram-in go with the --head of a RAM image");
  return {};
}

}  // namespace

void add_source_options(Arguments& arguments, SourceOptions& options) {
  arguments.text("--head", "ADDR", options.head,
                 "the file is a RAM image: the first tag of the list, hexadecimal");
  arguments.text("--table", "ADDR,N", options.table,
                 "with --head: the ordering table, address of entry 0, number of entries");
  arguments.text("--vram-in", "FILE", options.vram_in, "with --head: 1 MiB of VRAM to draw into [black]");
  add_frame_by(arguments, options.frame_by);
}

void add_frame_by(Arguments& arguments, std::string& frame_by) {
  arguments.choice("--frame-by", frame_by, {"display", "vsync"},
                   "dump: a frame ends where the display shows another buffer, or at every VSync [display]");
}

base::Result<Source> open_source(const std::string& name, const SourceOptions& options) {
  if (auto checked = check_no_ram_options(name, options); !checked)
    return tl::make_unexpected(checked.error());
  if (!options.head.empty()) return open_ram(name, options);
  if (demos::find(name) == nullptr) {
    const auto kind = base::kind_of_file(name);
    if (kind && *kind == base::FileKind::dump) {
      auto recording = debug::Recording::open(name);
      if (!recording) return tl::make_unexpected(recording.error());
      return Source{name, std::nullopt, std::move(*recording), dump::frame_by_named(options.frame_by)};
    }
    if (kind && *kind == base::FileKind::unknown && has_size_of_ram(name))
      return base::fail(name + ": a RAM image, as its size says; expected --head ADDR beside it");
  }
  auto scene = open_scene(name);
  if (!scene) return tl::make_unexpected(scene.error());
  return Source{name, std::move(*scene), std::nullopt};
}

debug::DrawOptions draw_options(const scene::Knobs& knobs) {
  return {.depth = scene::depth_options(knobs),
          .depth_of_bucket = knobs.without_depth == scene::WithoutDepth::bucket};
}

base::Result<std::unique_ptr<debug::Timeline>> open_timeline(Source& source, const scene::Knobs& knobs) {
  if (knobs.visibility != scene::Visibility::ot && knobs.visibility != scene::Visibility::zbuffer)
    return base::fail("--visibility: " + source.name + " is drawn in its own order; expected ot or zbuffer");
  const bool has_buckets = source.recording->has_buckets();
  if (auto checked = check_without_depth(source.name, knobs, has_buckets); !checked)
    return tl::make_unexpected(checked.error());
  auto timeline = std::make_unique<debug::Timeline>(std::move(*source.recording), draw_options(knobs));
  source.recording.reset();
  timeline->end_frames_by(source.frame_by);
  if (auto read = timeline->read_first_frame(); !read) return tl::make_unexpected(read.error());
  return timeline;
}

bool applies_to_recordings(std::string_view knob) {
  return std::find(recording_knobs.begin(), recording_knobs.end(), knob) != recording_knobs.end();
}

void warn_of_idle_knobs(const std::string& name, const scene::Knobs& knobs, DrawnTo drawn_to) {
  const scene::Knobs standard;
  std::string idle, beyond;
  for (const auto& knob : scene::knob_table()) {
    if (knob.get(knobs) == knob.get(standard)) continue;
    auto alone = standard;
    knob.set(alone, knob.get(knobs));
    const bool needs_canvas = knob.name != "visibility" && asks_for_canvas(alone);
    if (applies_to_recordings(knob.name) && !(needs_canvas && drawn_to == DrawnTo::vram)) continue;
    auto& names = applies_to_recordings(knob.name) ? beyond : idle;
    names.append(names.empty() ? "--" : ", --").append(knob.name);
  }
  if (!idle.empty())
    base::warn("otter", name + ": " + idle + ": does nothing, " + std::string(why_not_for_recordings));
  if (!beyond.empty())
    base::warn("otter",
               name + ": " + beyond + ": does nothing here, VRAM itself is looked at; otter render draws it");
}

void warn_of_fault(const debug::Timeline& timeline) {
  if (timeline.fault().empty()) return;
  base::warn("otter", timeline.fault() + "; the " + std::to_string(timeline.frames()) +
                          " whole frames before it are used");
}

}  // namespace app
