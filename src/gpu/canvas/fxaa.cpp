#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/canvas/resolve.h"

namespace gpu::canvas {
namespace {

/// Perceived brightness, 0..255 * 256.
int luma(base::Rgba p) { return p.r * 77 + p.g * 150 + p.b * 29; }

constexpr int least_contrast = 12 * 256;  // of 255 * 256: weaker edges are texture
constexpr int relative_contrast = 6;      // an edge is at least 1/6 of the brightest neighbour
constexpr int search_length = 8;          // pixels along an edge, each way

/// Brightness of every pixel, with a border that repeats the outermost ones, as wide as anything looks.
class Lumas {
 public:
  static constexpr int border = search_length + 2;

  explicit Lumas(const base::Picture& picture)
      : width_(picture.width),
        height_(picture.height),
        values_(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(height_ + 2 * border)) {
    for (int y = 0; y < height_; ++y) {
      std::int32_t* row = &values_[index(0, y)];
      const auto* pixels = &picture.at(0, y);
      std::transform(pixels, pixels + width_, row, luma);
      std::fill_n(row - border, border, row[0]);
      std::fill_n(row + width_, border, row[width_ - 1]);
    }
    for (int i = 1; i <= border; ++i) {
      std::copy_n(&values_[index(-border, 0)], stride(), &values_[index(-border, -i)]);
      std::copy_n(&values_[index(-border, height_ - 1)], stride(), &values_[index(-border, height_ - 1 + i)]);
    }
  }
  /// Up to `border` pixels outside the picture.
  [[nodiscard]] const std::int32_t* at(int x, int y) const { return &values_[index(x, y)]; }
  [[nodiscard]] int stride() const { return width_ + 2 * border; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + border) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(x + border);
  }
  int width_, height_;
  std::vector<std::int32_t> values_;
};

/// How far an edge runs from `here` in steps of `step` beside the neighbour `across` away, and whether it
/// ends towards the far side.
struct End {
  int distance;
  bool away;
};
End follow(const std::int32_t* here, int step, int across, int edge, int gradient) {
  for (int i = 1; i <= search_length; ++i) {
    here += step;
    const int mean = (here[0] + here[across]) / 2;
    if (std::abs(mean - edge) * 4 >= gradient) return {i, mean < edge};
  }
  return {search_length + 1, false};
}

base::Rgba mix(base::Rgba a, base::Rgba b, double weight) {
  const auto between = [weight](double from, double to) {
    return static_cast<std::uint8_t>(from + (to - from) * weight + 0.5);
  };
  return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b)};
}

base::Rgba smooth(const base::Picture& picture, const Lumas& lumas, int x, int y) {
  const std::int32_t* here_luma = lumas.at(x, y);
  const int stride = lumas.stride();
  const int c = here_luma[0];
  const int n = here_luma[-stride];
  const int s = here_luma[stride];
  const int w = here_luma[-1];
  const int e = here_luma[1];
  const auto [low, high] = std::minmax({c, n, s, w, e});
  const int contrast = high - low;

  const int nw = here_luma[-stride - 1];
  const int ne = here_luma[-stride + 1];
  const int sw = here_luma[stride - 1];
  const int se = here_luma[stride + 1];
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

  const int along_edge = horizontal ? 1 : stride;
  const int across = nx + ny * stride;
  const End left = follow(here_luma, -along_edge, across, edge, gradient);
  const End right = follow(here_luma, along_edge, across, edge, gradient);
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
  return mix(picture.at(x, y), picture.nearest(x + nx, y + ny), std::max(along, alone));
}

}  // namespace

base::Picture fxaa(const base::Picture& picture) {
  base::Picture result = picture;
  if (picture.pixels.empty()) return result;
  const Lumas lumas(picture);
  // Most pixels lie on no edge: finding that out is what the filter spends its time on.
  std::vector<std::uint8_t> is_edge(static_cast<std::size_t>(picture.width));
  for (int y = 0; y < picture.height; ++y) {
    const std::int32_t* above = lumas.at(0, y - 1);
    const std::int32_t* here = lumas.at(0, y);
    const std::int32_t* below = lumas.at(0, y + 1);
    for (int x = 0; x < picture.width; ++x) {
      const int across_low = std::min(here[x - 1], here[x + 1]);
      const int across_high = std::max(here[x - 1], here[x + 1]);
      const int low = std::min(std::min(here[x], across_low), std::min(above[x], below[x]));
      const int high = std::max(std::max(here[x], across_high), std::max(above[x], below[x]));
      is_edge[static_cast<std::size_t>(x)] =
          high - low >= std::max(least_contrast, high / relative_contrast) ? 1 : 0;
    }
    for (int x = 0; x < picture.width; ++x) {
      if (is_edge[static_cast<std::size_t>(x)] != 0) result.at(x, y) = smooth(picture, lumas, x, y);
    }
  }
  return result;
}

}  // namespace gpu::canvas
