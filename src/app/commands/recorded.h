#pragma once
// A frame of a recording for those who measure it.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/source.h"
#include "base/result.h"
#include "cost/recorded.h"

namespace app {

/// Opens the timeline of a recording and reads as far as frame `asked`, from 1; without one the first. Says
/// what does not apply. Error (exit 2): there is no such frame.
base::Result<std::unique_ptr<debug::Timeline>> open_at_frame(Source& source, const scene::Knobs& knobs,
                                                             std::uint64_t frame);

/// Its words and the state before them.
cost::RecordedFrame recorded_frame(debug::Timeline& timeline, const std::string& name, std::uint64_t frame);

}  // namespace app
