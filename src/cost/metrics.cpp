#include "cost/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cost {
namespace {

using base::Picture;
using base::Rgba;

std::array<double, 3> channels(Rgba p) {
  return {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
}

double brightness(Rgba p) { return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b; }

std::array<double, 3> block_mean(const Picture& picture, int x0, int y0, int size) {
  std::array<double, 3> sum{};
  int count = 0;
  for (int y = y0; y < std::min(y0 + size, picture.height); ++y) {
    for (int x = x0; x < std::min(x0 + size, picture.width); ++x, ++count) {
      const auto c = channels(picture.at(x, y));
      for (std::size_t i = 0; i < 3; ++i) sum[i] += c[i];
    }
  }
  for (auto& s : sum) s /= count;
  return sum;
}

}  // namespace

double rms(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto ca = channels(a.pixels[i]);
    const auto cb = channels(b.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) sum += (ca[c] - cb[c]) * (ca[c] - cb[c]);
  }
  return a.pixels.empty() ? 0 : std::sqrt(sum / (3 * static_cast<double>(a.pixels.size())));
}

double block_rms(const Picture& a, const Picture& b) {
  double sum = 0;
  int blocks = 0;
  for (int y = 0; y < a.height; y += 4) {
    for (int x = 0; x < a.width; x += 4, ++blocks) {
      const auto ca = block_mean(a, x, y, 4);
      const auto cb = block_mean(b, x, y, 4);
      for (std::size_t c = 0; c < 3; ++c) sum += (ca[c] - cb[c]) * (ca[c] - cb[c]);
    }
  }
  return blocks == 0 ? 0 : std::sqrt(sum / (3.0 * blocks));
}

double psnr(double rms_of_255) {
  constexpr double most = 99;
  return rms_of_255 <= 0 ? most : std::min(most, 20 * std::log10(255 / rms_of_255));
}

double ssim(const Picture& a, const Picture& b) {
  constexpr int window = 8;
  constexpr int step = 4;
  constexpr double c1 = 6.5025;   // (0.01 * 255)^2
  constexpr double c2 = 58.5225;  // (0.03 * 255)^2
  double total = 0;
  int windows = 0;
  for (int y0 = 0; y0 + window <= a.height; y0 += step) {
    for (int x0 = 0; x0 + window <= a.width; x0 += step, ++windows) {
      double sa = 0;
      double sb = 0;
      double saa = 0;
      double sbb = 0;
      double sab = 0;
      for (int y = y0; y < y0 + window; ++y) {
        for (int x = x0; x < x0 + window; ++x) {
          const double va = brightness(a.at(x, y));
          const double vb = brightness(b.at(x, y));
          sa += va;
          sb += vb;
          saa += va * va;
          sbb += vb * vb;
          sab += va * vb;
        }
      }
      constexpr double n = window * window;
      const double ma = sa / n;
      const double mb = sb / n;
      const double variance_a = saa / n - ma * ma;
      const double variance_b = sbb / n - mb * mb;
      const double covariance = sab / n - ma * mb;
      total += (2 * ma * mb + c1) * (2 * covariance + c2) /
               ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
    }
  }
  return windows == 0 ? 1 : total / windows;
}

/// A pixel reaches half a console pixel to each side of its sample point. Samples on that border belong to
/// two pixels and count half, so that the mean is centred on the point.
Picture shrunk(const Picture& picture, int factor) {
  if (factor == 1) return picture;
  Picture small(picture.width / factor, picture.height / factor);
  const int half = factor / 2;
  const auto weight = [half](int offset) { return std::abs(offset) == half ? 0.5 : 1.0; };
  const auto nearest = [&picture](int x, int y) {
    return channels(picture.at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1)));
  };
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      std::array<double, 3> sum{};
      for (int dy = -half; dy <= half; ++dy) {
        for (int dx = -half; dx <= half; ++dx) {
          const auto c = nearest(x * factor + dx, y * factor + dy);
          for (std::size_t i = 0; i < 3; ++i) sum[i] += c[i] * weight(dx) * weight(dy);
        }
      }
      const auto byte = [factor](double v) {
        return static_cast<std::uint8_t>(std::lround(v / (factor * factor)));
      };
      small.at(x, y) = {byte(sum[0]), byte(sum[1]), byte(sum[2])};
    }
  }
  return small;
}

Rgba heat(int difference) {
  struct Stop {
    double at;
    std::array<double, 3> rgb;
  };
  static constexpr std::array<Stop, 5> stops{{{0, {0, 0, 0}},
                                              {0.2, {70, 15, 110}},
                                              {0.45, {200, 50, 70}},
                                              {0.75, {250, 180, 30}},
                                              {1, {255, 255, 240}}}};
  const double t = std::sqrt(std::clamp(difference, 0, 255) / 255.0);
  std::size_t i = 1;
  while (i + 1 < stops.size() && t > stops[i].at) ++i;
  const Stop &from = stops[i - 1], &to = stops[i];
  const double share = (t - from.at) / (to.at - from.at);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(from.rgb[c] + (to.rgb[c] - from.rgb[c]) * share + 0.5);
  };
  return {channel(0), channel(1), channel(2)};
}

Picture heat_map(const Picture& a, const Picture& b) {
  Picture result(a.width, a.height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgba p = a.pixels[i];
    const Rgba q = b.pixels[i];
    result.pixels[i] = heat(std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}));
  }
  return result;
}

Picture cropped(const Picture& a, int x, int y, int width, int height) {
  Picture part(width, height);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) part.at(i, j) = a.at(x + i, y + j);
  }
  return part;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const auto high = std::min(low + 1, values.size() - 1);
  return values[low] + (values[high] - values[low]) * (at - static_cast<double>(low));
}

double median(std::vector<double> values) { return percentile(std::move(values), 0.5); }

double spread(const std::vector<double>& values) {
  return percentile(values, 0.75) - percentile(values, 0.25);
}

}  // namespace cost
