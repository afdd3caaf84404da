#pragma once
// Where a pixel is sampled. Offsets are in canvas units (1/256 of a canvas pixel) from the pixel's sample
// point and lie in -128..127, so every pattern is centred on the point the console samples and converges to
// the area of the pixel around it.

#include <cstdint>
#include <vector>

#include "gpu/canvas/samples.h"

namespace gpu::canvas {

/// n x n samples on a square grid, row by row. 1 <= n <= 8.
std::vector<Point> regular_grid(int n);

/// n samples, no two in one row or column of an n x n grid, spread as evenly as a lattice allows (the next
/// pixels' samples considered); n = 4 is the rotated grid of graphics cards. 1 <= n <= 64.
std::vector<Point> rotated_grid(int n);

/// The middles of n cells of one size that tile the pixel, as square as n allows, row by row. 1 <= n <= 64.
std::vector<Point> cell_middles(int n);
/// One sample at random in each of these cells, no two in one of n columns or rows (multi-jittered sampling);
/// their mean is 0, 0. The same seed gives the same samples on every machine. 1 <= n <= 64.
std::vector<Point> random_samples(int n, std::uint32_t seed = 1);

/// How many patterns a canvas with a scatter_seed chooses from, and which one pixel x, y has.
inline constexpr std::uint32_t scatter_patterns = 64;
std::uint32_t scatter_pattern(int x, int y, std::uint32_t seed);

inline constexpr int jitter_length = 8;
/// Jitter `index` modulo jitter_length of temporal accumulation: a low-discrepancy sequence (Halton 2, 3),
/// moved so that its mean is 0, 0.
Point temporal_jitter(int index);

}  // namespace gpu::canvas
