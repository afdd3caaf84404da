#pragma once
// A finished picture: what a canvas resolves to, and what filters after the frame work on.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gpu::canvas {

/// Pixels r | g << 8 | b << 16 | ff000000h, rows from the top, no padding.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0xff000000) {}

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// The nearest pixel of the picture to (x, y).
  [[nodiscard]] std::uint32_t nearest(int x, int y) const {
    return pixels[index(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1))];
  }
  bool operator==(const Image&) const = default;
};

}  // namespace gpu::canvas
