#pragma once
// What stands where a scene may stand on the command line, or is dropped on the window: a scene of `otter
// list`, a scene file, a GPU dump, or the list in a saved RAM image. Told by what is in the file, never by
// its name where its bytes say it.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/commands/arguments.h"
#include "base/result.h"
#include "debug/recording.h"
#include "debug/timeline.h"
#include "dump/frames.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace app {

/// How a source is read: --head, --table, --vram-in make a RAM image one, --frame-by says where the frames of
/// a dump end. Empty: not given.
struct SourceOptions {
  std::string head, table, vram_in, frame_by;
};
/// Declares the four.
void add_source_options(Arguments& arguments, SourceOptions& options);
/// Declares --frame-by alone.
void add_frame_by(Arguments& arguments, std::string& frame_by);

/// Either a scene or a recording. A value: whoever opens it owns it.
struct Source {
  std::string name;  ///< as it was given
  std::optional<scene::Scene> scene;
  std::optional<debug::Recording> recording;
  dump::FrameBy frame_by = dump::FrameBy::display;

  [[nodiscard]] bool is_recording() const { return recording.has_value(); }
};

/// Opens what `name` means. Of a dump nothing but the beginning is read. Error (exit 2): one line that names
/// what was expected.
base::Result<Source> open_source(const std::string& name, const SourceOptions& options = {});

/// The timeline of a source that is a recording, its first frame read. `source.recording` is empty then.
/// Error (exit 2): no frame of it is whole, or the knobs ask for what it has not got (visibility sorted or
/// bsp, depths of buckets).
base::Result<std::unique_ptr<debug::Timeline>> open_timeline(Source& source, const scene::Knobs& knobs);

/// How a recording is drawn with these knobs.
debug::DrawOptions draw_options(const scene::Knobs& knobs);

/// The knobs that do something for a recording; those of them that VRAM cannot hold, in words.
inline constexpr std::array<std::string_view, 16> recording_knobs{
    "visibility", "depth",         "depth-mapping", "depth-test", "depth-reversed", "near",
    "far",        "without-depth", "position",      "texture",    "filter",         "colour",
    "antialias",  "aa-filter",     "aa-space",      "resolution"};
inline constexpr std::string_view canvas_knobs =
    "--position, --texture, --filter, --colour, --antialias, --resolution";
/// Whether a knob does anything for a recording; of visibility, ot and zbuffer.
bool applies_to_recordings(std::string_view knob);
/// Why the others do not, for people.
inline constexpr std::string_view why_not_for_recordings =
    "a recording holds packets as they were sent, not the world they came from";
/// What becomes of a recording's pixels: they stay in VRAM, or a canvas beside it may hold them.
enum class DrawnTo : std::uint8_t { vram, canvas };
/// One line on stderr that names the knobs which were set and do nothing. Nothing where there are none.
void warn_of_idle_knobs(const std::string& name, const scene::Knobs& knobs, DrawnTo drawn_to);

/// Says on stderr, in one line, what is wrong with the rest of a dump whose first frames are used.
void warn_of_fault(const debug::Timeline& timeline);

}  // namespace app
