#pragma once
// Where a pixel is sampled. Offsets are in canvas units (1/256 of a canvas pixel) from the pixel's sample
// point and lie in -128..127, so every pattern is centred on the point the console samples and converges to
// the area of the pixel around it.

#include <array>
#include <vector>

#include "gpu/canvas/samples.h"

namespace gpu::canvas {

/// n x n samples on a square grid, row by row. 1 <= n <= 8.
std::vector<Point> regular_grid(int n);

/// n samples, no two in one row or column of an n x n grid, spread as evenly as a lattice allows (the next
/// pixels' samples considered); n = 4 is the rotated grid of graphics cards. 1 <= n <= 64.
std::vector<Point> rotated_grid(int n);

/// n samples drawn evenly from the pixel; the same ones on every machine. 1 <= n <= 64.
std::vector<Point> random_samples(int n);

inline constexpr int jitter_length = 8;
/// Jitter `index` modulo jitter_length of temporal accumulation: a low-discrepancy sequence (Halton 2, 3).
Point temporal_jitter(int index);

}  // namespace gpu::canvas
