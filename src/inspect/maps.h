#pragma once
// Pictures of a report: where it is wrong and why, how often each pixel was drawn, by whom, and what truth
// looks like. All have the size of the report's picture; the heat map and overdraw have a legend below.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/picture.h"
#include "inspect/report.h"

namespace inspect {

/// The colour that stands for a cause, in pictures and in the window.
base::Rgba colour_of(Cause cause);

/// Wrong pixels in their cause's colour over the dimmed picture, and a legend with the counts. `vram`: 1024 x
/// 512 pixels as the frame left them. A wrong pixel without a cause (visibility bsp) is white.
base::Picture heatmap(const Report& report, std::span<const std::uint16_t> vram);

/// The colours of overdraw: 0 times, 1 .. 7 times, 8 and more.
std::span<const base::Rgba> overdraw_colours();

/// How often each pixel was written, or would have been but for the depth test: black
/// 0, blue 1 .. red 8 and more.
base::Picture overdraw(const Report& report, const gpu::Trace& trace);

/// A colour per draw, that of the last writer; black: nobody. Neighbouring numbers have unlike colours.
base::Picture ids(const Report& report, const gpu::Trace& trace);

/// The picture as it should be: wrong pixels drawn again from their true owner and layers. What was drawn
/// without depth stays where it was in the list.
base::Picture truth_image(const Report& report, const gpu::Trace& trace, std::span<const std::uint16_t> vram);

/// 1/z of the true owner: white nearest, black none.
base::Picture depth_image(const Report& report, const gpu::Trace& trace);

/// Text in capitals, digits and "-.:%()," 3 x 5 pixels a character, times `scale`; returns the x behind it.
int draw_text(base::Picture& image, int x, int y, std::string_view text, base::Rgba colour, int scale);

}  // namespace inspect
