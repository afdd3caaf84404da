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

/// columns * rows = n, as near to a square as that allows.
struct Cells {
  int columns, rows;
  explicit Cells(int n) : columns(1), rows(n) {
    assert(n >= 1 && n <= 64);
    for (int divisor = 1; divisor * divisor <= n; ++divisor)
      if (n % divisor == 0) rows = divisor;
    columns = n / rows;
  }
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 0x9e3779b9U | 1) {}
  /// 0..n-1 in some order.
  std::vector<int> order_of(int n) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[next() % i]);
    return order;
  }
  /// Somewhere in part i of n of the pixel.
  std::int64_t within(int i, int n) {
    const std::int64_t begin = i * units_per_pixel / n, end = (i + 1) * units_per_pixel / n;
    return begin + static_cast<std::int64_t>(next()) % (end - begin) - units_per_pixel / 2;
  }

 private:
  std::uint32_t next() {  // xorshift32 [Marsaglia 2003]
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ >> 8;
  }
  std::uint32_t state_;
};

/// Moves all alike, and some by one more, until they add up to 0: a pattern that leans shifts the picture.
void move_to_the_middle(std::vector<std::int64_t>& values) {
  constexpr std::int64_t least = -units_per_pixel / 2, most = units_per_pixel / 2 - 1;
  const auto sum = [&values] { return std::accumulate(values.begin(), values.end(), std::int64_t{0}); };
  const auto count = static_cast<std::int64_t>(values.size());
  const std::int64_t mean = floor_div(2 * sum() + count, 2 * count);
  for (auto& value : values) value = std::clamp(value - mean, least, most);
  std::int64_t left = sum();
  for (std::size_t i = 0; left != 0; i = (i + 1) % values.size()) {
    const std::int64_t step = left > 0 ? -1 : 1;
    if (values[i] + step < least || values[i] + step > most) continue;
    values[i] += step;
    left += step;
  }
}

std::vector<Point> centred(std::vector<std::int64_t> xs, std::vector<std::int64_t> ys) {
  move_to_the_middle(xs);
  move_to_the_middle(ys);
  std::vector<Point> points;
  for (std::size_t i = 0; i < xs.size(); ++i) points.push_back({xs[i], ys[i]});
  return points;
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

std::vector<Point> cell_middles(int n) {
  const Cells cells(n);
  std::vector<Point> points;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column)
      points.push_back({cell(column, cells.columns), cell(row, cells.rows)});
  }
  return points;
}

std::vector<Point> random_samples(int n, std::uint32_t seed) {
  const Cells cells(n);
  Random random(seed);
  // Each column of cells hands out its narrow columns to its rows, each row its narrow rows to its columns.
  std::vector<std::vector<int>> narrow_columns, narrow_rows;
  for (int column = 0; column < cells.columns; ++column)
    narrow_columns.push_back(random.order_of(cells.rows));
  for (int row = 0; row < cells.rows; ++row) narrow_rows.push_back(random.order_of(cells.columns));
  std::vector<std::int64_t> xs, ys;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
      xs.push_back(random.within(column * cells.rows + narrow_columns[c][r], n));
      ys.push_back(random.within(row * cells.columns + narrow_rows[r][c], n));
    }
  }
  return centred(std::move(xs), std::move(ys));
}

std::uint32_t scatter_pattern(int x, int y, std::uint32_t seed) {
  // Mixed as in MurmurHash3 [Appleby, public domain].
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0xcc9e2d51U +
                    static_cast<std::uint32_t>(y) * 0x1b873593U + seed * 0xe6546b64U;
  h = (h ^ h >> 16) * 0x85ebca6bU;
  h = (h ^ h >> 13) * 0xc2b2ae35U;
  return (h ^ h >> 16) % scatter_patterns;
}

Point temporal_jitter(int index) {
  static const std::vector<Point> jitter = [] {
    std::vector<std::int64_t> xs, ys;
    for (int i = 1; i <= jitter_length; ++i) {
      xs.push_back(radical_inverse(i, 2, units_per_pixel) - units_per_pixel / 2);
      ys.push_back(radical_inverse(i, 3, units_per_pixel) - units_per_pixel / 2);
    }
    return centred(std::move(xs), std::move(ys));
  }();
  return jitter[static_cast<std::size_t>((index % jitter_length + jitter_length) % jitter_length)];
}

}  // namespace gpu::canvas
