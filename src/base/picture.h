#pragma once
// A picture as it leaves the machine: what scan-out makes, what a PNG holds, what the window shows.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace base {

struct Rgba {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Rgba&) const = default;
};
static_assert(sizeof(Rgba) == 4);  // a picture's pixels are uploaded to a texture as they lie

/// width * height pixels, rows from the top, columns from the left, no padding.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgba> pixels;

  Picture() = default;
  Picture(int w, int h, Rgba fill = {})
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  [[nodiscard]] Rgba& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Rgba& at(int x, int y) const { return pixels[index(x, y)]; }
  /// The nearest pixel of the picture to (x, y).
  [[nodiscard]] const Rgba& nearest(int x, int y) const {
    return at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  }
  bool operator==(const Picture&) const = default;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace base
