#pragma once
// Pictures of a report: where it is wrong and why, how often each pixel was drawn, by whom, and what truth
// looks like. All have the size of the report's picture; the heat map and overdraw have a legend below.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "inspect/report.h"

namespace inspect {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// Rows from the top, no padding.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image(int w, int h, Rgb fill = {})
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  [[nodiscard]] Rgb& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  [[nodiscard]] const Rgb& at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

/// The colour that stands for a cause, in pictures and in the window.
Rgb colour_of(Cause cause);

/// Wrong pixels in their cause's colour over the dimmed picture, and a legend with the counts. `vram`: 1024 x
/// 512 pixels as the frame left them. A wrong pixel without a cause (visibility bsp) is white.
Image heatmap(const Report& report, std::span<const std::uint16_t> vram);

/// How often each pixel was written, or would have been but for the depth test: black
/// 0, blue 1 .. red 8 and more.
Image overdraw(const Report& report, const gpu::Trace& trace);

/// A colour per draw, that of the last writer; black: nobody. Neighbouring numbers have unlike colours.
Image ids(const Report& report, const gpu::Trace& trace);

/// The picture as it should be: wrong pixels drawn again from their true owner and layers. What was drawn
/// without depth stays where it was in the list.
Image truth_image(const Report& report, const gpu::Trace& trace, std::span<const std::uint16_t> vram);

/// 1/z of the true owner: white nearest, black none.
Image depth_image(const Report& report, const gpu::Trace& trace);

/// Text in capitals, digits and "-.:%()," 3 x 5 pixels a character, times `scale`; returns the x behind it.
int draw_text(Image& image, int x, int y, std::string_view text, Rgb colour, int scale);

}  // namespace inspect
