#include "cost/metrics.h"

#include <doctest/doctest.h>

#include <vector>

#include "cost/sweep.h"

using base::Picture;
using base::Rgba;

TEST_SUITE("cost") {
  TEST_CASE("rms and PSNR of pictures that differ by 10 everywhere are 10 and 28.13 dB") {
    const Picture a(8, 8, Rgba{100, 100, 100});
    const Picture b(8, 8, Rgba{110, 90, 110});
    CHECK(cost::rms(a, b) == doctest::Approx(10));
    CHECK(cost::psnr(10) == doctest::Approx(28.1308).epsilon(1e-5));
    CHECK(cost::psnr(cost::rms(a, a)) == 99);
  }

  TEST_CASE("a checkerboard whose mean is the other picture's colour has no error of 4x4 means") {
    Picture dithered(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x)
        dithered.at(x, y) = ((x + y) & 1) != 0 ? Rgba{90, 90, 90} : Rgba{110, 110, 110};
    }
    const Picture flat(16, 16, Rgba{100, 100, 100});
    CHECK(cost::block_rms(dithered, flat) == doctest::Approx(0));
    CHECK(cost::rms(dithered, flat) == doctest::Approx(10));
  }

  TEST_CASE("SSIM is 1 of a picture with itself and falls with noise") {
    Picture a(32, 32);
    Picture b(32, 32);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const auto v = static_cast<std::uint8_t>(x * 7);
        a.at(x, y) = {v, v, v};
        const auto w = static_cast<std::uint8_t>(v ^ ((x * 5 + y * 3) & 31));
        b.at(x, y) = {w, w, w};
      }
    }
    CHECK(cost::ssim(a, a) == doctest::Approx(1));
    CHECK(cost::ssim(a, b) < 0.99);
  }

  TEST_CASE("a picture twice as large is shrunk round its sample points: quarter, half, quarter") {
    Picture large(8, 4, Rgba{0, 0, 0});
    for (int y = 0; y < 4; ++y) large.at(4, y) = {200, 200, 200};
    const auto small = cost::shrunk(large, 2);
    CHECK(small.width == 4);
    CHECK(small.at(1, 1).r == 0);
    CHECK(small.at(2, 1).r == 100);
    CHECK(small.at(3, 1).r == 0);
  }

  TEST_CASE("medians, percentiles and spread, by hand") {
    CHECK(cost::median({3, 1, 2}) == 2);
    CHECK(cost::median({4, 1, 2, 3}) == doctest::Approx(2.5));
    CHECK(cost::median({}) == 0);
    CHECK(cost::percentile({0, 10}, 0.95) == doctest::Approx(9.5));
    CHECK(cost::spread({1, 2, 3, 4, 5}) == doctest::Approx(2));
  }

  TEST_CASE("the Pareto front holds what nothing beats in both time and error") {
    const auto row = [](double ms, double error) {
      cost::Row r;
      r.direction = cost::Direction::cross;
      r.ms = ms;
      r.errors.colour_rms = error;
      return r;
    };
    std::vector<cost::Row> rows{row(1, 9), row(2, 5), row(3, 5), row(4, 1), row(5, 2)};
    cost::mark_front(rows);
    std::vector<bool> front;
    for (const auto& r : rows) front.push_back(r.on_front);
    CHECK(front == std::vector<bool>{true, true, false, true, false});
  }

  TEST_CASE("a sweep has a front of its own, by the error of its axis") {
    const auto row = [](const cost::Axis* axis, cost::Direction direction, double ms, double pixels) {
      cost::Row r;
      r.axis = axis;
      r.direction = direction;
      r.ms = ms;
      r.errors.geometric_px.mean = pixels;
      r.errors.colour_rms = 100 - pixels;  // of another axis
      return r;
    };
    const auto* position = cost::find_axis("position");
    std::vector<cost::Row> rows{
        row(position, cost::Direction::up, 1, 9), row(position, cost::Direction::up, 2, 9),
        row(position, cost::Direction::up, 3, 1), row(position, cost::Direction::down, 9, 9)};
    cost::mark_front(rows);
    CHECK(rows[0].is_best);
    CHECK_FALSE(rows[1].is_best);
    CHECK(rows[2].is_best);
    CHECK(rows[3].is_best);
  }

  TEST_CASE("settings of an axis and combinations stand on one front, by the distance from the reference") {
    const auto row = [](const cost::Axis* axis, cost::Direction direction, double ms, double distance) {
      cost::Row r;
      r.axis = axis;
      r.direction = direction;
      r.ms = ms;
      r.knobs.buckets = static_cast<int>(ms);  // no two alike
      r.errors.colour_rms = distance;
      return r;
    };
    const auto* texture = cost::find_axis("texture");
    std::vector<cost::Row> rows{row(nullptr, cost::Direction::cross, 4, 5),
                                row(texture, cost::Direction::up, 3, 4),  // beats the combination
                                row(texture, cost::Direction::down, 9, 1),
                                row(nullptr, cost::Direction::cross, 1, 8)};
    cost::mark_front(rows);
    CHECK_FALSE(rows[0].on_front);
    const auto front = cost::front_of(rows);
    REQUIRE(front.size() == 3);
    CHECK(front[0] == &rows[3]);
    CHECK(front[1] == &rows[1]);
    CHECK(front[2] == &rows[2]);
  }

  TEST_CASE("a heat map is black where pictures agree, white where a channel is as far as can be") {
    base::Picture a(3, 1);
    base::Picture b = a;
    b.at(1, 0) = {0, 255, 0};
    b.at(2, 0) = {2, 0, 1};
    const auto map = cost::heat_map(a, b);
    CHECK(map.at(0, 0) == base::Rgba{0, 0, 0});
    CHECK(map.at(1, 0) == cost::heat(255));
    CHECK(map.at(2, 0) == cost::heat(2));
    const auto brightness = [](int d) {
      const auto c = cost::heat(d);
      return 299 * c.r + 587 * c.g + 114 * c.b;
    };
    for (int d = 1; d < 256; ++d) CHECK(brightness(d) > brightness(d - 1));
    CHECK(cost::cropped(b, 1, 0, 2, 1).at(1, 0) == b.at(2, 0));
  }
}
