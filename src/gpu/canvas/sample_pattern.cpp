#include "gpu/canvas/sample_pattern.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <numeric>

namespace gpu::canvas {
namespace {

/// Centre of cell i of n, in canvas units around 0.
std::int64_t cell(int i, int n) {
  return floor_div((2 * i + 1) * (units_per_pixel / 2), n) - units_per_pixel / 2;
}

using Rooks = std::vector<int>;  // row of the sample in each column

/// How close the samples are to each other and to the neighbouring pixels': the energy of equal charges.
double energy(const Rooks& rooks) {
  const int n = static_cast<int>(rooks.size());
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int step = 1; step < n; ++step) {
      const auto other = static_cast<std::size_t>((i + step) % n);
      const int rows = std::abs(rooks[static_cast<std::size_t>(i)] - rooks[other]);
      const int x = std::min(step, n - step);
      const int y = std::min(rows, n - rows);
      sum += 1.0 / (x * x + y * y);
    }
  }
  return sum;
}

/// Column i to row i * a mod modulus, shifted so that rows are 0..n-1 (modulus n, or n + 1 without its zero).
Rooks lattice(int n, int a, int modulus) {
  const int first = modulus - n;
  Rooks rooks(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) rooks[static_cast<std::size_t>(i)] = (i + first) * a % modulus - first;
  return rooks;
}

std::int64_t radical_inverse(int index, int base, std::int64_t scale) {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;
  for (; index > 0; index /= base) {
    numerator = numerator * base + index % base;
    denominator *= base;
  }
  return numerator * scale / denominator;
}

}  // namespace

std::vector<Point> regular_grid(int n) {
  assert(n >= 1 && n <= 8);
  std::vector<Point> points;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) points.push_back({cell(x, n), cell(y, n)});
  }
  return points;
}

std::vector<Point> rotated_grid(int n) {
  assert(n >= 1 && n <= 64);
  Rooks best = lattice(n, 1, n);
  for (const int modulus : {n + 1, n}) {
    for (int a = 1; a < modulus; ++a) {
      if (std::gcd(a, modulus) != 1) continue;
      auto candidate = lattice(n, a, modulus);
      if (energy(candidate) < energy(best)) best = std::move(candidate);
    }
  }
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) points.push_back({cell(i, n), cell(best[static_cast<std::size_t>(i)], n)});
  return points;
}

std::vector<Point> random_samples(int n) {
  assert(n >= 1 && n <= 64);
  std::uint32_t state = 0x2545f491;
  const auto next = [&state] {  // xorshift32 [Marsaglia 2003]
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return static_cast<std::int64_t>(state >> 24) - units_per_pixel / 2;
  };
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const auto x = next();
    points.push_back({x, next()});
  }
  return points;
}

Point temporal_jitter(int index) {
  const int i = (index % jitter_length + jitter_length) % jitter_length + 1;
  return {radical_inverse(i, 2, units_per_pixel) - units_per_pixel / 2,
          radical_inverse(i, 3, units_per_pixel) - units_per_pixel / 2};
}

}  // namespace gpu::canvas
