// The filters of finished pictures against references in double, written from their formulas and without a
// look at how the canvas does it.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "canvas_scene.h"
#include "gpu/canvas/mip.h"
#include "gpu/canvas/resolve.h"
#include "gpu/canvas/sample_pattern.h"
#include "gpu/vram.h"

using canvas_test::Random;
namespace canvas = gpu::canvas;

namespace {

using Rgb = std::array<double, 3>;

Rgb rgb(base::Rgba p) {
  return {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
}
Rgb rgb(canvas::Pixel p) {
  return {static_cast<double>(p & 255), static_cast<double>(p >> 8 & 255),
          static_cast<double>(p >> 16 & 255)};
}
base::Rgba pixel(int r, int g, int b) {
  return {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
}
base::Picture grey(int width, int height, int level) { return {width, height, pixel(level, level, level)}; }

/// FXAA as resolve.h and Lottes describe it, one pixel at a time, in double. Even channels make every mean of
/// two brightnesses whole, so that no comparison hangs on a rounding.
class ReferenceFxaa {
 public:
  explicit ReferenceFxaa(const base::Picture& image) : image_(image) {}

  [[nodiscard]] Rgb at(int x, int y) const {
    const double c = luma(x, y);
    const double n = luma(x, y - 1), s = luma(x, y + 1), w = luma(x - 1, y), e = luma(x + 1, y);
    const double brightest = std::max({c, n, s, w, e}), contrast = brightest - std::min({c, n, s, w, e});
    const Rgb here = colour(x, y);
    if (contrast < std::max(12.0, std::floor(brightest * 256 / 6) / 256)) return here;

    const double nw = luma(x - 1, y - 1), ne = luma(x + 1, y - 1), sw = luma(x - 1, y + 1),
                 se = luma(x + 1, y + 1);
    const double vertical_change =
        std::abs(nw + sw - 2 * w) + 2 * std::abs(n + s - 2 * c) + std::abs(ne + se - 2 * e);
    const double horizontal_change =
        std::abs(nw + ne - 2 * n) + 2 * std::abs(w + e - 2 * c) + std::abs(sw + se - 2 * s);
    const bool is_row = vertical_change >= horizontal_change;  // the edge runs along a row
    const double before = is_row ? n : w, after = is_row ? s : e;
    const int side = std::abs(before - c) >= std::abs(after - c) ? -1 : 1;
    const double other = side < 0 ? before : after, middle = (other + c) / 2;
    const double step = std::max(1.0 / 256, std::abs(other - c));

    // Along the edge both ways, until the mean of the two rows (columns) has left the edge's by a quarter
    // step.
    std::array<int, 2> length{};
    std::array<bool, 2> is_darker{};
    for (int way = 0; way < 2; ++way) {
      int i = 1;
      for (; i <= 8; ++i) {
        const int d = way == 0 ? -i : i;
        const double mean = is_row ? (luma(x + d, y) + luma(x + d, y + side)) / 2
                                   : (luma(x, y + d) + luma(x + side, y + d)) / 2;
        if (4 * std::abs(mean - middle) < step) continue;
        is_darker[static_cast<std::size_t>(way)] = mean < middle;
        break;
      }
      length[static_cast<std::size_t>(way)] = i;
    }
    const std::size_t near = length[0] < length[1] ? 0 : 1;
    double share = 0;
    if (length[near] <= 8 && is_darker[near] != (c < middle)) {
      share = std::max(0.0, 0.5 - (length[near] - 0.5) / (length[0] + length[1] - 1));
    }
    const double mean = (2 * (n + s + w + e) + nw + ne + sw + se) / 12;
    const double t = std::min(1.0, std::abs(mean - c) / contrast), curve = t * t * (3 - 2 * t);
    share = std::max(share, curve * curve / 2);
    const Rgb there = is_row ? colour(x, y + side) : colour(x + side, y);
    Rgb out{};
    for (std::size_t i = 0; i < 3; ++i) out[i] = here[i] + (there[i] - here[i]) * share;
    return out;
  }

 private:
  [[nodiscard]] Rgb colour(int x, int y) const {
    return rgb(image_.at(std::clamp(x, 0, image_.width - 1), std::clamp(y, 0, image_.height - 1)));
  }
  [[nodiscard]] double luma(int x, int y) const {
    const auto [r, g, b] = colour(x, y);
    return (77 * r + 150 * g + 29 * b) / 256;
  }
  const base::Picture& image_;
};

void check_fxaa(const base::Picture& image) {
  const auto filtered = canvas::fxaa(image);
  const ReferenceFxaa reference(image);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb wanted = reference.at(x, y), got = rgb(filtered.at(x, y));
      for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(x);
        CAPTURE(y);
        REQUIRE(std::abs(wanted[c] - got[c]) <= 0.5 + 1e-9);
      }
    }
  }
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("FXAA is what its description says, on steps of every slope and contrast") {
    for (const int run : {1, 2, 3, 5, 7, 8, 9, 12, 30}) {
      for (const int level : {12, 14, 40, 254}) {
        for (const bool is_steep : {false, true}) {
          base::Picture image = grey(48, 48, 0);
          for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
              const int along = is_steep ? y : x, across = is_steep ? x : y;
              if (across > 20 + along / run) image.at(x, y) = pixel(level, level, level);
            }
          }
          check_fxaa(image);
        }
      }
    }
  }

  TEST_CASE("FXAA is what its description says, on random blocks, single pixels and noise") {
    Random random(77);
    for (int round = 0; round < 12; ++round) {
      base::Picture image = grey(40, 30, 60);
      const int size = 1 + round % 4;
      for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
          Random here(static_cast<std::uint64_t>((y / size) * 64 + x / size + round * 4096));
          const int spread = round < 6 ? 127 : 12;
          image.at(x, y) =
              pixel(2 * here.between(0, spread), 2 * here.between(0, spread), 2 * here.between(0, spread));
        }
      }
      check_fxaa(image);
    }
    base::Picture lonely = grey(9, 9, 100);
    lonely.at(4, 4) = pixel(200, 200, 200);
    check_fxaa(lonely);
    // One pixel out of nine alike: the mean of the eight is theirs, so half of it is blended away.
    CHECK(rgb(canvas::fxaa(lonely).at(4, 4))[0] == doctest::Approx(150).epsilon(0.005));
  }

  TEST_CASE("FXAA leaves contrasts below 12 of 255, and below a sixth of the brightest, as they are") {
    const auto changes = [](int dark, int bright) {
      base::Picture image = grey(12, 12, dark);
      image.at(6, 6) = pixel(bright, bright, bright);
      return canvas::fxaa(image).pixels != image.pixels;
    };
    CHECK_FALSE(changes(0, 10));
    CHECK(changes(0, 14));
    CHECK_FALSE(changes(200, 238));  // 38 of 238: less than a sixth
    CHECK(changes(200, 242));        // 42 of 242
  }

  TEST_CASE(
      "Gauss weights are exp(-d^2 / (2 s^2)) with s half a pixel, of all samples nearer than 1.5 pixels") {
    for (const int n : {1, 2, 4}) {  // sample points that are whole units
      canvas::Options options;
      options.layers = canvas::regular_grid(n);
      const auto taps = canvas::filter_taps(options, canvas::Reconstruction::gauss);
      double total = 0;
      const auto weight = [](double d) { return std::abs(d) < 1.5 ? std::exp(-2 * d * d) : 0.0; };
      const auto sample = [n](int i) { return (2 * i + 1) / (2.0 * n) - 0.5; };
      const auto wanted = [&](int i, int j, int dx, int dy) {
        return weight(dx + sample(i)) * weight(dy + sample(j));
      };
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) total += wanted(i, j, dx, dy);
          }
        }
      }
      std::size_t with_weight = 0;
      for (const canvas::Tap& tap : taps) {
        const int i = static_cast<int>(tap.layer) % n, j = static_cast<int>(tap.layer) / n;
        CHECK(std::abs(tap.weight - 65536 * wanted(i, j, tap.dx, tap.dy) / total) <= 1.0);
        ++with_weight;
      }
      // Of the nine pixels' samples none is 1.5 away or more, and all but the very corners weigh something.
      CHECK(with_weight > 9U * static_cast<std::size_t>(n * n) * 3 / 4);
    }
  }

  TEST_CASE("Tent weights are 1 - |d|, box weights are those of the pixel's own samples") {
    canvas::Options options;
    options.layers = canvas::regular_grid(2);  // at -1/4 and +1/4
    const auto sum_of = [&](canvas::Reconstruction filter, int dx, int dy) {
      std::uint32_t sum = 0;
      for (const auto& tap : canvas::filter_taps(options, filter)) {
        if (tap.dx == dx && tap.dy == dy) sum += tap.weight;
      }
      return sum / 65536.0;
    };
    CHECK(sum_of(canvas::Reconstruction::box, 0, 0) == 1);
    // In one dimension: 3/4 + 3/4 of the pixel itself, 1/4 of each side, of 2 in all.
    CHECK(sum_of(canvas::Reconstruction::tent, 0, 0) == doctest::Approx(0.75 * 0.75).epsilon(1e-4));
    CHECK(sum_of(canvas::Reconstruction::tent, 1, 0) == doctest::Approx(0.125 * 0.75).epsilon(1e-4));
    CHECK(sum_of(canvas::Reconstruction::tent, -1, 1) == doctest::Approx(0.125 * 0.125).epsilon(1e-3));
  }

  TEST_CASE("Accumulation is the running mean of eight frames, and the whole history before that") {
    // Between black and white neighbours nothing is cut off: the middle pixel follows the formula alone.
    const auto frame = [](int middle) {
      base::Picture image = grey(3, 3, 0);
      image.at(0, 0) = pixel(255, 255, 255);
      image.at(1, 1) = pixel(middle, 255 - middle, 7);
      return image;
    };
    canvas::Accumulator accumulator;
    Random random(3);
    Rgb history{};
    for (int n = 1; n <= 40; ++n) {
      const int middle = n % 11 < 5 ? 255 - n : random.between(0, 255);
      const auto image = frame(middle);
      const Rgb now = rgb(image.at(1, 1));
      for (std::size_t c = 0; c < 3; ++c)
        history[c] = n == 1 ? now[c] : history[c] + (now[c] - history[c]) / std::min(n, 8);
      const Rgb shown = rgb(accumulator.add(image).at(1, 1));
      // 8.8 fixed point: each frame loses less than 1/256, which fades with the memory; the rest is rounding.
      for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(shown[c] - history[c]) <= 0.5 + 8.0 / 256);
    }
  }

  TEST_CASE("Accumulated values are rounded to the nearest, so that the mean of many is not too dark") {
    double error = 0;
    int count = 0;
    for (int a = 0; a < 256; a += 5) {
      for (int b = 0; b < 256; b += 7) {
        canvas::Accumulator accumulator;
        for (const int middle : {a, b}) {
          base::Picture image = grey(3, 3, 0);
          image.at(0, 0) = pixel(255, 255, 255);
          image.at(1, 1) = pixel(middle, middle, middle);
          const auto& shown = accumulator.add(image);
          if (middle == b) error += rgb(shown.at(1, 1))[0] - (a + b) / 2.0;
        }
        ++count;
      }
    }
    CHECK(std::abs(error / count) < 0.3);  // halves go up: 1/4 on the mean; cut off it would be -1/4
    CHECK(error > 0);
  }

  TEST_CASE("A picture of another size, and forget(), begin an accumulation anew") {
    canvas::Accumulator accumulator;
    for (int n = 0; n < 10; ++n) (void)accumulator.add(grey(4, 4, 200));
    CHECK(accumulator.add(grey(5, 4, 10)).pixels == grey(5, 4, 10).pixels);
    const auto spotted = [](int level) {
      base::Picture image = grey(3, 3, 0);
      image.pixels[0] = pixel(255, 255, 255);
      image.at(1, 1) = pixel(level, level, level);
      return image;
    };
    for (int n = 0; n < 10; ++n) (void)accumulator.add(spotted(250));
    CHECK(accumulator.add(spotted(10)).pixels != spotted(10).pixels);
    for (int n = 0; n < 10; ++n) (void)accumulator.add(spotted(250));
    accumulator.forget();
    CHECK(accumulator.add(spotted(10)).pixels == spotted(10).pixels);
    CHECK(accumulator.bytes() == 9 * 3 * 2);
  }

  TEST_CASE(
      "Each mip level holds the means of the solid texels, solid where two are, half-transparent where most "
      "are") {
    gpu::Vram vram;
    Random random(5);
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const auto word = static_cast<std::uint16_t>(random.word());
        vram.at(x, y) = random.between(0, 3) == 0 ? std::uint16_t{0} : word;
      }
    }
    canvas::TextureView view;
    view.vram = &vram;
    const canvas::MipChain chain(view, gpu::TexelFormat::direct15);
    for (int level = 1; level < canvas::MipChain::levels; ++level) {
      const int size = 256 >> level;
      for (int v = 0; v < size; v += level < 3 ? 7 : 1) {
        for (int u = 0; u < size; ++u) {
          double solid = 0, half = 0;
          Rgb sum{};
          for (int k = 0; k < 4; ++k) {
            const auto below = chain.at(level - 1, 2 * u + k % 2, 2 * v + k / 2);
            if ((below & canvas::texel_solid) == 0) continue;
            ++solid;
            half += (below & canvas::texel_semi) != 0 ? 1 : 0;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb(below)[c];
          }
          const auto got = chain.at(level, u, v);
          REQUIRE(((got & canvas::texel_solid) != 0) == (solid >= 2));
          if (solid < 2) continue;
          REQUIRE(((got & canvas::texel_semi) != 0) == (half > solid / 2));
          for (std::size_t c = 0; c < 3; ++c) REQUIRE(rgb(got)[c] == std::floor(sum[c] / solid + 0.5));
        }
      }
    }
  }

  TEST_CASE("A rotated grid has one sample in each row and column, as far apart as any lattice of its size") {
    // Distances on a torus, since the pattern repeats in every pixel.
    const auto closeness = [](const std::vector<int>& row) {
      const int n = static_cast<int>(row.size());
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          if (i == j) continue;
          const double x = std::min(std::abs(i - j), n - std::abs(i - j));
          const double dy = std::abs(row[static_cast<std::size_t>(i)] - row[static_cast<std::size_t>(j)]);
          const double y = std::min(dy, n - dy);
          sum += 1 / (x * x + y * y);
        }
      }
      return sum;
    };
    for (int n = 2; n <= 16; ++n) {
      const auto points = canvas::rotated_grid(n);
      std::vector<int> rows;
      for (const auto& p : points)
        rows.push_back(static_cast<int>((p.y + canvas::units_per_pixel / 2) * n / canvas::units_per_pixel));
      CHECK(std::set<int>(rows.begin(), rows.end()).size() == static_cast<std::size_t>(n));
      for (const int modulus : {n, n + 1}) {
        for (int a = 1; a < modulus; ++a) {
          std::vector<int> lattice;
          for (int i = 0; i < n; ++i) lattice.push_back((i + modulus - n) * a % modulus - (modulus - n));
          if (std::set<int>(lattice.begin(), lattice.end()).size() != static_cast<std::size_t>(n)) continue;
          CAPTURE(n);
          CHECK(closeness(rows) <= closeness(lattice) + 1e-9);
        }
      }
    }
  }

  TEST_CASE("light of a stored byte is the sRGB curve, and comes back to the same byte") {
    CHECK(canvas::to_light(0) == 0);
    CHECK(canvas::to_light(255) == 65535);
    CHECK(canvas::to_light(10) == 199);     // 10 / 255 / 12.92
    CHECK(canvas::to_light(188) == 32957);  // ((188 / 255 + 0.055) / 1.055)^2.4 = 0.50289
    for (std::uint32_t byte = 0; byte < 256; ++byte)
      CHECK(canvas::from_light(canvas::to_light(byte)) == byte);
    CHECK(canvas::from_light(32768) == 188);  // half the light of white
  }

  TEST_CASE("half of a pixel white is 128 of what is stored, and 188 in light") {
    for (const auto colour : {canvas::Colour::bits15, canvas::Colour::bits24}) {
      canvas::Options options{.width = 16, .height = 16};
      options.colour = colour;
      options.layers = canvas::regular_grid(2);
      canvas_test::Studio studio(options);
      studio.draw({0x02000000, 0, 16 | 16 << 16});
      // Left of an edge through the middle of column 8: its two left samples.
      studio.draw(canvas_test::polygon(0x20, {{-100 * 256, -100 * 256, 0xffffff},
                                              {8 * 256, -100 * 256, 0xffffff},
                                              {8 * 256, 300 * 256, 0xffffff}}));
      const auto box = canvas::Reconstruction::box;
      const auto red = [&](canvas::AverageOf average) {
        const auto image = canvas::resolve(studio.canvas, box, average);
        return static_cast<int>(image.at(8, 8).r);
      };
      CHECK(red(canvas::AverageOf::stored) == 128);
      CHECK(red(canvas::AverageOf::light) == 188);
    }
  }

  TEST_CASE("temporal accumulation averages light where it is asked to") {
    canvas::Accumulator accumulator;
    const base::Rgba black{0, 0, 0}, white{255, 255, 255};
    base::Picture dark(2, 1, black), bright(2, 1, white);
    dark.at(1, 0) = white;
    bright.at(1, 0) = black;
    accumulator.add(dark, canvas::AverageOf::light);
    CHECK(accumulator.add(bright, canvas::AverageOf::light).at(0, 0).r == 188);
    canvas::Accumulator stored;
    stored.add(dark);
    CHECK(stored.add(bright).at(0, 0).r == 128);
  }
}
