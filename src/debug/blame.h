#pragma once
// Who wrote a pixel last, and what happened to it.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "debug/number.h"
#include "debug/timeline.h"
#include "gpu/primitive.h"

namespace debug {

struct Writer {
  Number number;
  gpu::Kind kind = gpu::Kind::polygon;
};

/// "polygon", "rectangle" ...
std::string_view name(gpu::Kind kind);

/// For each pixel (y * 1024 + x) the command that wrote it last, up to `moment`; nothing: nobody did, it is
/// what it was in the beginning. Frames are drawn again from the last one back, until all are found.
/// `keep_going` is asked before each: false leaves the others unknown.
std::vector<std::optional<Writer>> last_writers(Timeline& timeline, const Number& moment,
                                                std::span<const std::uint32_t> pixels,
                                                const std::function<bool()>& keep_going = {});

/// One line an event at a pixel in one frame, up to `moment`, in the order made:
///     "3:17 triangle wrote 001F over 0000"
std::vector<std::string> pixel_events(Timeline& timeline, const Number& moment, std::uint32_t pixel);

}  // namespace debug
