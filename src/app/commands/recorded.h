#pragma once
// A frame of a recording for those who measure it.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/source.h"
#include "app/tape.h"
#include "base/picture.h"
#include "base/result.h"
#include "cost/recorded.h"

namespace app {

/// Opens the timeline of a recording and reads as far as frame `asked`, from 1; without one the first. Says
/// what does not apply. Error (exit 2): there is no such frame.
base::Result<std::unique_ptr<debug::Timeline>> open_at_frame(Source& source, const scene::Knobs& knobs,
                                                             std::uint64_t frame,
                                                             DrawnTo drawn_to = DrawnTo::vram);

/// The picture of a frame for the file `output`, on a canvas where the knobs ask for one. Without --shown
/// (Shown::either) it is the display area, or with a canvas the buffer that the frame draws. Polygons without
/// depth are judged. Error (exit 1): the area is empty; as judge_without_depth().
base::Result<base::Picture> recorded_picture(debug::Timeline& timeline, const std::string& source,
                                             std::uint64_t frame, const scene::Knobs& knobs, Shown shown,
                                             const std::string& output);

/// Declares --shown.
void add_shown_option(Arguments& arguments, std::string& shown);

/// Its words and the state before them.
cost::RecordedFrame recorded_frame(debug::Timeline& timeline, const std::string& name, std::uint64_t frame);

}  // namespace app
