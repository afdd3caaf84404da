// The numbers of a report against their definitions, written anew in double.

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "cost/errors.h"
#include "cost/finding.h"
#include "cost/metrics.h"
#include "cost/text.h"

using base::Picture;
using base::Rgba;

namespace {

Picture noise(int width, int height, std::uint32_t seed, int low, int high) {
  std::mt19937 random(seed);
  Picture picture(width, height);
  for (Rgba& p : picture.pixels) {
    const auto channel = [&] {
      return static_cast<std::uint8_t>(low +
                                       static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    p = {channel(), channel(), channel(), 255};
  }
  return picture;
}

/// SSIM as published: means, variances and covariance about them, with C1 = (0.01 L)^2 and C2 = (0.03 L)^2,
/// of the brightness 0.299 r + 0.587 g + 0.114 b, in windows of 8 x 8 every 4 pixels. [Wang, Bovik, Sheikh,
/// Simoncelli 2004]
double reference_ssim(const Picture& a, const Picture& b) {
  const auto y = [](Rgba p) { return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b; };
  double sum = 0;
  int windows = 0;
  for (int top = 0; top + 8 <= a.height; top += 4) {
    for (int left = 0; left + 8 <= a.width; left += 4) {
      std::vector<double> p, q;
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i) {
          p.push_back(y(a.at(left + i, top + j)));
          q.push_back(y(b.at(left + i, top + j)));
        }
      }
      double mean_p = 0, mean_q = 0, var_p = 0, var_q = 0, cov = 0;
      for (std::size_t k = 0; k < 64; ++k) {
        mean_p += p[k] / 64;
        mean_q += q[k] / 64;
      }
      for (std::size_t k = 0; k < 64; ++k) {
        var_p += (p[k] - mean_p) * (p[k] - mean_p) / 64;
        var_q += (q[k] - mean_q) * (q[k] - mean_q) / 64;
        cov += (p[k] - mean_p) * (q[k] - mean_q) / 64;
      }
      const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2);
      const double luminance = (2 * mean_p * mean_q + c1) / (mean_p * mean_p + mean_q * mean_q + c1);
      const double structure = (2 * cov + c2) / (var_p + var_q + c2);
      sum += luminance * structure;
      ++windows;
    }
  }
  return sum / windows;
}

cost::Row row(const cost::Axis* axis, cost::Direction direction, const std::string& setting, double ms,
              double error, bool is_console) {
  cost::Row r;
  r.axis = axis;
  r.direction = direction;
  r.setting = setting;
  r.ms = r.ratio = ms;
  r.errors.texel.mean = error;
  r.is_console = is_console;
  return r;
}

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE("SSIM is the published formula, on noise of every strength and on dark pictures") {
    for (const auto& row : {std::pair{0, 255}, {100, 140}, {0, 6}, {250, 255}}) {
      const auto low = row.first;
      const auto high = row.second;
      for (std::uint32_t seed = 1; seed < 4; ++seed) {
        const auto a = noise(24, 20, seed, low, high), b = noise(24, 20, seed + 10, low, high);
        CHECK(cost::ssim(a, b) == doctest::Approx(reference_ssim(a, b)).epsilon(1e-9));
      }
    }
    // Two flat pictures have no structure: what is left is (2 m n + C1) / (m^2 + n^2 + C1).
    const Picture dark(8, 8, Rgba{2, 2, 2}), less_dark(8, 8, Rgba{6, 6, 6});
    CHECK(cost::ssim(dark, less_dark) == doctest::Approx((24 + 6.5025) / (40 + 6.5025)));
  }

  TEST_CASE("A shrunk picture holds at each point the mean of the square round it, borders counted half") {
    const auto large = noise(16, 8, 5, 0, 255);
    for (const int factor : {2, 4}) {
      const auto small = cost::shrunk(large, factor);
      REQUIRE(small.width == 16 / factor);
      for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
          // The integral of a picture of unit squares centred on whole points over [x - 1/2, x + 1/2] *
          // factor.
          double sum = 0;
          for (int j = -8; j <= 8; ++j) {
            for (int i = -8; i <= 8; ++i) {
              const auto overlap = [factor](int d) {
                return std::max(0.0, std::min(d + 0.5, factor / 2.0) - std::max(d - 0.5, -factor / 2.0));
              };
              const int px = std::clamp(x * factor + i, 0, 15), py = std::clamp(y * factor + j, 0, 7);
              sum += overlap(i) * overlap(j) * large.at(px, py).g;
            }
          }
          CHECK(std::abs(sum / (factor * factor) - small.at(x, y).g) <= 0.5 + 1e-9);
        }
      }
    }
  }

  TEST_CASE(
      "Deciding a whole pixel by its middle leaves an edge error of a quarter; 64 samples leave little") {
    // By its middle a pixel is decided as its larger half. An upright edge that lies anywhere covers c = 0..1
    // evenly: the root mean square of min(c, 1 - c) is 1/sqrt(12) = 0.289. A diagonal one covers s^2/2, s =
    // 0..1 from the corner to the middle: sqrt(1/20) = 0.224. Other slopes lie between.
    scene::Knobs knobs;
    knobs.position = scene::Position::fine;
    const double none = cost::edge_error(knobs);
    CHECK(none > 0.224);
    CHECK(none < 0.289);
    REQUIRE(scene::set_knob(knobs, "antialias", "ssaa-8x8"));
    REQUIRE(scene::set_knob(knobs, "aa-filter", "box"));
    CHECK(cost::edge_error(knobs) < 0.05);
  }

  TEST_CASE("An error within a twentieth of the best is as good: the cheaper setting is chosen") {
    const auto* axis = cost::find_axis("texture");
    REQUIRE(axis->measure == cost::Measure::texel);
    const auto chosen_with = [&](double error_of_cheap) {
      cost::SceneResult result;
      for (const auto direction : {cost::Direction::up, cost::Direction::down}) {
        result.rows.push_back(row(axis, direction, "console", 1, 10, true));
        result.rows.push_back(row(axis, direction, "cheap", 2, error_of_cheap, false));
        result.rows.push_back(row(axis, direction, "best", 3, 1, false));
      }
      const auto found = cost::finding(result, *axis);
      REQUIRE(found);
      CHECK(found->error_from == 10);
      return found->chosen->setting;
    };
    CHECK(chosen_with(1.04) == "cheap");
    CHECK(chosen_with(1.06) == "best");
  }

  TEST_CASE("Where the console's own error is within a twentieth of the best, nothing improves on it") {
    const auto* axis = cost::find_axis("texture");
    for (const auto& given : {std::pair{1.04, false}, {1.06, true}}) {
      const auto error = given.first;
      const auto improves = given.second;
      cost::SceneResult result;
      for (const auto direction : {cost::Direction::up, cost::Direction::down}) {
        result.rows.push_back(row(axis, direction, "console", 1, error, true));
        result.rows.push_back(row(axis, direction, "best", 3, 1, false));
      }
      const auto found = cost::finding(result, *axis);
      REQUIRE(found);
      CHECK(found->improves() == improves);
    }
  }

  TEST_CASE("Numbers have three digits, bytes their unit") {
    for (const auto& row : std::vector<std::pair<double, std::string>>{{0, "0"},
                                                                       {1234.5, "1234"},
                                                                       {100, "100"},
                                                                       {99.94, "99.9"},
                                                                       {10, "10.0"},
                                                                       {9.994, "9.99"},
                                                                       {1, "1.00"},
                                                                       {0.9994, "0.999"},
                                                                       {0.1, "0.100"},
                                                                       {0.0994, "0.0994"},
                                                                       {0.01, "0.0100"},
                                                                       {0.00994, "0.00994"},
                                                                       {-12.34, "-12.3"}}) {
      const auto value = row.first;
      const auto& text = row.second;
      CHECK(cost::number(value) == text);
    }
    CHECK(cost::number(NAN) == "0");
    CHECK(cost::bytes(9999) == "9999 B");
    CHECK(cost::bytes(10000) == "10.0 kB");
    CHECK(cost::bytes(999'000) == "999 kB");
    CHECK(cost::bytes(1'000'000) == "1.00 MB");
    CHECK(cost::short_number(0.25) == "0.25");
    CHECK(cost::escaped("<a & \"b\">") == "&lt;a &amp; &quot;b&quot;&gt;");
  }
}
