#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/canvas/resolve.h"

namespace gpu::canvas {
namespace {

/// Perceived brightness, 0..255 * 256.
int luma(std::uint32_t p) {
  return static_cast<int>((p & 255) * 77 + (p >> 8 & 255) * 150 + (p >> 16 & 255) * 29);
}

class Lumas {
 public:
  explicit Lumas(const Image& image) : image_(image), values_(image.pixels.size()) {
    std::ranges::transform(image.pixels, values_.begin(), luma);
  }
  [[nodiscard]] int at(int x, int y) const {
    return values_[image_.index(std::clamp(x, 0, image_.width - 1), std::clamp(y, 0, image_.height - 1))];
  }

 private:
  const Image& image_;
  std::vector<int> values_;
};

constexpr int least_contrast = 8 * 256;  // of 255 * 256: weaker edges are texture
constexpr int relative_contrast = 8;     // an edge is at least 1/8 of the brightest neighbour
constexpr int search_length = 12;        // pixels along an edge, each way

/// How far an edge runs from (x, y) in the direction (sx, sy) beside the neighbour at (nx, ny), and whether
/// it ends towards the far side.
struct End {
  int distance;
  bool away;
};
End follow(const Lumas& lumas, int x, int y, int sx, int sy, int nx, int ny, int edge, int gradient) {
  for (int i = 1; i <= search_length; ++i) {
    const int px = x + sx * i;
    const int py = y + sy * i;
    const int mean = (lumas.at(px, py) + lumas.at(px + nx, py + ny)) / 2;
    if (std::abs(mean - edge) * 4 >= gradient) return {i, mean < edge};
  }
  return {search_length + 1, false};
}

std::uint32_t mix(std::uint32_t a, std::uint32_t b, double weight) {
  std::uint32_t result = 0xff000000;
  for (unsigned shift = 0; shift < 24; shift += 8) {
    const double va = a >> shift & 255;
    const double vb = b >> shift & 255;
    result |= static_cast<std::uint32_t>(va + (vb - va) * weight + 0.5) << shift;
  }
  return result;
}

std::uint32_t smooth(const Image& image, const Lumas& lumas, int x, int y) {
  const int c = lumas.at(x, y);
  const int n = lumas.at(x, y - 1);
  const int s = lumas.at(x, y + 1);
  const int w = lumas.at(x - 1, y);
  const int e = lumas.at(x + 1, y);
  const auto [low, high] = std::minmax({c, n, s, w, e});
  const int contrast = high - low;
  const std::uint32_t here = image.pixels[image.index(x, y)];
  if (contrast < std::max(least_contrast, high / relative_contrast)) return here;

  const int nw = lumas.at(x - 1, y - 1);
  const int ne = lumas.at(x + 1, y - 1);
  const int sw = lumas.at(x - 1, y + 1);
  const int se = lumas.at(x + 1, y + 1);
  const int across_rows = std::abs(nw - 2 * w + sw) + 2 * std::abs(n - 2 * c + s) + std::abs(ne - 2 * e + se);
  const int across_columns =
      std::abs(nw - 2 * n + ne) + 2 * std::abs(w - 2 * c + e) + std::abs(sw - 2 * s + se);
  const bool horizontal = across_rows >= across_columns;

  // The neighbour across the edge: where the step is steeper.
  const int before = horizontal ? n : w;
  const int after = horizontal ? s : e;
  const bool backwards = std::abs(before - c) >= std::abs(after - c);
  const int step = backwards ? -1 : 1;
  const int nx = horizontal ? 0 : step;
  const int ny = horizontal ? step : 0;
  const int beyond = backwards ? before : after;
  const int gradient = std::max(1, std::abs(beyond - c));
  const int edge = (beyond + c) / 2;

  const int sx = horizontal ? 1 : 0;
  const int sy = horizontal ? 0 : 1;
  const End left = follow(lumas, x, y, -sx, -sy, nx, ny, edge, gradient);
  const End right = follow(lumas, x, y, sx, sy, nx, ny, edge, gradient);
  const End& nearer = left.distance < right.distance ? left : right;
  const int length = left.distance + right.distance - 1;
  // Only the side of the step that the edge leans over moves, by at most half a pixel at its end.
  const bool leans = nearer.away != (c < edge) && nearer.distance <= search_length;
  const double along = leans ? std::max(0.0, 0.5 - (nearer.distance - 0.5) / length) : 0;

  // Single pixels that stand out of all eight neighbours are blended by how much they do.
  const double mean = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12;
  const double lonely = std::clamp(std::abs(mean - c) / contrast, 0.0, 1.0);
  const double smoothed = lonely * lonely * (3 - 2 * lonely);
  const double alone = smoothed * smoothed * 0.5;
  return mix(here, image.nearest(x + nx, y + ny), std::max(along, alone));
}

}  // namespace

Image fxaa(const Image& image) {
  Image result(image.width, image.height);
  const Lumas lumas(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) result.pixels[image.index(x, y)] = smooth(image, lumas, x, y);
  }
  return result;
}

}  // namespace gpu::canvas
