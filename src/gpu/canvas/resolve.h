#pragma once
// From the samples of a frame to its pixels: the filter afterwards.
//
// Means are taken of the stored values, which is what the console's blending does too, or of the light that
// they stand for when it is asked for.

#include <cstdint>
#include <vector>

#include "base/picture.h"
#include "gpu/canvas/canvas.h"

namespace gpu::canvas {

/// Weight of one sample of the pixel (dx, dy) away, dx, dy in -1..1, in 65536ths; all
/// weights of a filter sum to 65536.
struct Tap {
  std::size_t layer = 0, sample = 0;
  int dx = 0, dy = 0;
  std::uint32_t weight = 0;
};

/// The taps of a filter over the samples of a canvas; those of weight 0 are left out.
std::vector<Tap> filter_taps(const Options& options, Reconstruction filter);

/// The picture: width() x height() pixels, 8 bits a channel; 5 bits become 8 as v << 3 | v >> 2.
base::Picture resolve(const Canvas& canvas, Reconstruction filter, AverageOf average = AverageOf::stored);

/// The light of a stored byte as 0..65535, by the sRGB curve [IEC 61966-2-1], and the byte whose light is
/// nearest. from_light(to_light(b)) is b.
std::uint32_t to_light(std::uint32_t byte);
std::uint32_t from_light(std::uint32_t light);

/// Fast approximate anti-aliasing of a finished picture: where luma shows an edge, pixels are
/// moved along their neighbour by the share of the edge's length that they stand at. [Lottes 2009,
/// FXAA; written from the description]
base::Picture fxaa(const base::Picture& picture);

/// Temporal accumulation: the mean of the last frames, each drawn from another jitter. What is
/// left of earlier frames is limited to the colours round each pixel of the newest one, so
/// that what moved leaves no ghost.
class Accumulator {
 public:
  /// Takes the next frame and returns the accumulated picture. A picture of another size starts anew.
  const base::Picture& add(const base::Picture& frame, AverageOf average = AverageOf::stored);
  void forget() { frames_ = 0; }
  [[nodiscard]] std::uint64_t bytes() const { return history_.size() * sizeof(std::uint16_t); }

 private:
  std::vector<std::uint16_t> history_;  // three a pixel: 8.8, or light
  AverageOf average_ = AverageOf::stored;
  base::Picture shown_;
  int frames_ = 0;
};

}  // namespace gpu::canvas
