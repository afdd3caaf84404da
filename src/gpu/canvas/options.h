#pragma once
// What a Canvas is asked to be. A default Options is a console frame buffer: one sample per pixel, integer
// positions, affine attributes, 15 bits, no depth.

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/canvas/samples.h"
#include "gpu/depth.h"

namespace gpu::canvas {

/// Texel filters. The mip levels are box-filtered from the texture page in VRAM as its polygon reads it.
enum class Filter : std::uint8_t {
  nearest,
  bilinear,
  mipmap,         ///< bilinear inside the nearest level
  mipmap_linear,  ///< bilinear inside two levels, mixed
};

/// What an average of samples is taken of.
enum class AverageOf : std::uint8_t {
  stored,  ///< the numbers in the frame buffer, as the console's blending does
  light,   ///< the light they stand for: decoded as sRGB, averaged, encoded again
};

/// How samples become pixels.
enum class Reconstruction : std::uint8_t {
  box,    ///< the pixel's own samples, all alike
  tent,   ///< falls to 0 one pixel away: samples of the eight neighbours count as well
  gauss,  ///< standard deviation half a pixel, cut off at 1.5 pixels
};

enum class Colour : std::uint8_t {
  bits15,  ///< 5 bits a channel; dithered where the draw state says so
  bits24,  ///< 8 bits a channel, never dithered
};

/// Depth cueing per pixel: colour = mix(colour, far_colour, f), f = far / (far - near) * (1 - near / z) in
/// 0..1, the hyperbolic ramp of the GTE's IR0. For polygons with depth.
struct Fog {
  std::uint8_t r = 0, g = 0, b = 0;
  double near_z = 0, far_z = 1;  ///< view-space units: no fog at near, only fog at far; 0 < near < far

  bool operator==(const Fog&) const = default;
};

struct Options {
  int width = 320, height = 240;  ///< of the region of VRAM that is drawn, in console pixels
  int scale = 1;                  ///< canvas pixels per console pixel and axis: 1, 2, 4, 8
  int fraction_bits = 0;          ///< leading bits of fx, fy that count: 0, 2, 4, 8
  bool perspective = false;       ///< u, v and colour linear in view space, for polygons with depth
  Filter filter = Filter::nearest;
  Colour colour = Colour::bits15;
  std::optional<DepthOptions> depth = {};
  std::optional<Fog> fog = {};
  /// Super-sampling: the frame is drawn once per layer, seen from the layer's offset in every pixel. {0, 0}
  /// alone is no super-sampling.
  std::vector<Point> layers{Point{}};
  /// Not 0: each pixel's samples are its own, at random (random_samples) in the cells round the layers'
  /// offsets, which must be cell_middles.
  std::uint32_t scatter_seed = 0;
  /// Multi-sampling: coverage, depth and colour per sample, shaded once per pixel. Empty: off. Never with
  /// more than one layer. At most 8.
  std::vector<Point> samples = {};
  /// Keep, for sample 0 of each pixel of layer 0, who wrote it last and with which texture coordinates.
  bool trace = false;
  /// Temporal accumulation: every frame samples its pixels at the next jitter. Never with layers or samples.
  bool temporal = false;

  /// One sample for each pixel of VRAM, at the pixel's own sample point: writes can be noted as pixels of
  /// VRAM.
  [[nodiscard]] bool can_be_watched() const {
    return scale == 1 && layers.size() == 1 && layers[0] == Point{} && samples.empty() && !temporal;
  }
  bool operator==(const Options&) const = default;
};

}  // namespace gpu::canvas
