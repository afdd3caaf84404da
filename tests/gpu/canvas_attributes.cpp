// Depth, texture coordinates, filters and fog against references computed in float64 from the corners.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "canvas_scene.h"
#include "gpu/canvas/resolve.h"
#include "gpu/canvas/sample_pattern.h"
#include "gpu/depth.h"

using namespace canvas_test;
namespace canvas = gpu::canvas;

namespace {

constexpr int width = 320, height = 240;

/// A floor that runs away from the eye, as a projection makes it: texture v along the depth.
struct Floor {
  double half_width = 300, eye_height = 120, near = 280, far = 2000, focal = 260;
  int u_max = 255, v_max = 255;

  [[nodiscard]] Corner project(double s, double t, int units) const {
    const double z = near + (far - near) * t;
    const double x = width / 2.0 + focal * (s - 0.5) * 2 * half_width / z;
    const double y = height / 2.0 + focal * eye_height / z;
    const auto snap = [&](double p) { return static_cast<int>(std::floor(p * units)) * (256 / units); };
    return {snap(x),
            snap(y),
            0x808080,
            static_cast<int>(std::lround(s * u_max)),
            static_cast<int>(std::lround(t * v_max)),
            static_cast<std::uint32_t>(z * 4096)};
  }
  /// Texture coordinates at a point of the screen.
  [[nodiscard]] std::array<double, 2> uv(double x, double y) const {
    const double z = focal * eye_height / (y - height / 2.0);
    const double s = (x - width / 2.0) * z / focal / (2 * half_width) + 0.5;
    return {s * u_max, (z - near) / (far - near) * v_max};
  }
  /// Words for n x n quads; `units` per pixel.
  [[nodiscard]] std::vector<std::uint32_t> words(int n, int units) const {
    std::vector<std::uint32_t> list;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto corner = [&](int di, int dj) {
          return project(static_cast<double>(i + di) / n, static_cast<double>(j + dj) / n, units);
        };
        const auto quad =
            polygon(0x2d, {corner(0, 1), corner(1, 1), corner(0, 0), corner(1, 0)}, 0x4000, 0x110);
        list.insert(list.end(), quad.begin(), quad.end());
      }
    }
    return list;
  }
};

struct TexelError {
  double mean = 0, greatest = 0;
  double over_bound = 0;  ///< the greatest share of what moving a corner by one unit moves the texture here
};

/// Distance in texels between what the canvas used and the exact projection, over the floor's pixels.
TexelError texel_error(const Floor& floor, bool perspective, int pieces, int units) {
  Studio studio(
      {.width = width, .height = height, .fraction_bits = 8, .perspective = perspective, .trace = true});
  std::ranges::fill(studio.gpu.vram().pixels(), std::uint16_t{0x1111});
  studio.draw(floor.words(pieces, units));
  TexelError error;
  int pixels = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      if (studio.canvas.ids()[at] == 0) continue;
      const auto word = studio.canvas.texcoords()[at];
      const auto [u, v] = floor.uv(x, y);
      const double du = (static_cast<double>(word & 0xffff) - 128) / 256 - u;
      const double dv = (static_cast<double>(word >> 16) - 128) / 256 - v;
      const double distance = std::sqrt(du * du + dv * dv);
      error.mean += distance;
      error.greatest = std::max(error.greatest, distance);
      ++pixels;
      // Corners are cut to the grid, x and y each by up to one unit; texels are kept in 256ths.
      const auto [right_u, right_v] = floor.uv(x + 1, y);
      const auto [down_u, down_v] = floor.uv(x, y + 1);
      const double per_pixel = std::hypot(right_u - u, right_v - v) + std::hypot(down_u - u, down_v - v);
      error.over_bound = std::max(error.over_bound, distance / (per_pixel / units + 2.0 / 256));
    }
  }
  REQUIRE(pixels > 10000);
  error.mean /= pixels;
  return error;
}

double mean_square_error(const base::Picture& a, const base::Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (const auto channel : {&base::Rgba::r, &base::Rgba::g, &base::Rgba::b}) {
      const double d = a.pixels[i].*channel - b.pixels[i].*channel;
      sum += d * d;
    }
  }
  return sum / (3 * static_cast<double>(a.pixels.size()));
}

}  // namespace

TEST_SUITE("canvas") {
  TEST_CASE("perspective-correct texture coordinates with 1/256-pixel positions are right to 1/16 texel") {
    const Floor floor;
    const auto correct = texel_error(floor, true, 1, 256);
    CHECK(correct.greatest < 1.0 / 16);
    CHECK(correct.over_bound < 1);
    const auto affine = texel_error(floor, false, 1, 256);
    CHECK(affine.mean > 100 * correct.mean);
    MESSAGE("floor, mean error in texels: affine ", affine.mean, ", perspective-correct ", correct.mean,
            ", greatest ", correct.greatest, ", of its bound ", correct.over_bound);
  }

  TEST_CASE(
      "each level of subdivision halves the affine error at least, down to the floor of 8-bit u, v and "
      "integer x, y") {
    const Floor floor;
    const double limit =
        texel_error(floor, true, 16, 1).mean;  // what whole pixels and whole texels alone leave
    double last = texel_error(floor, false, 1, 1).mean;
    for (const int n : {2, 4, 8, 16}) {
      const double error = texel_error(floor, false, n, 1).mean;
      MESSAGE("floor in ", n, " x ", n, " pieces: mean error ", error, " texels, floor ", limit);
      CHECK((error <= last / 2 || error < 1.5 * limit));
      last = error;
    }
  }

  TEST_CASE("stored depths are those of 1/z interpolated in float64, in every format and mapping") {
    using gpu::DepthFormat;
    for (const auto format :
         {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
      for (const auto mapping : {gpu::DepthMapping::hyperbolic, gpu::DepthMapping::linear}) {
        for (const bool reversed : {false, true}) {
          const gpu::DepthOptions options{format, mapping, gpu::DepthTest::less, reversed, 16, 4000};
          const gpu::DepthConstants code(options);
          const auto key = [&](double inverse_z) { return code.key(code.stored(code.quantity(inverse_z))); };
          for (double z = 8; z < 8000; z *= 1.37) {
            CAPTURE(z);
            CHECK(gpu::depth_of_key(options, key(1 / z)) == gpu::stored_depth(options, z));
          }
          CHECK(key(0) >= key(1 / 3999.0));  // infinitely far
          CHECK(key(1e9) == key(1 / 16.0));  // nearer than near saturates
          CHECK(key(std::nan("")) <= gpu::DepthPlane::farthest);
        }
      }
    }
  }

  // Both round the same real number; only where it lies within the last bits of 1/z of a half may they part.
  TEST_CASE("32-bit hyperbolic keys of a canvas are those of a z-buffer, but on the very halves") {
    const gpu::DepthOptions options{.format = gpu::DepthFormat::bits32};
    const gpu::DepthConstants code(options);
    int differ = 0, halves = 0;
    std::uint32_t random = 1;
    for (int i = 0; i < 200'000; ++i) {
      random = random * 1664525 + 1013904223;
      const double z = 16 + (random >> 8) / 16777216.0 * 60'000;
      const long double exact = 65535.0L * (z - 16.0L) / (z * (65535.0L - 16.0L)) * 4294967295.0L;
      if (std::abs(exact - std::floor(exact) - 0.5L) < 1e-5L) {
        ++halves;
        continue;
      }
      const std::uint32_t key = code.key(code.stored(code.quantity(1 / z)));
      differ += key != gpu::depth_key(options, gpu::stored_depth(options, z)) ? 1 : 0;
      differ += key != static_cast<std::uint32_t>(std::floor(exact + 0.5L)) ? 1 : 0;
    }
    CHECK(differ == 0);
    CHECK(halves < 20);
  }

  TEST_CASE("of crossing planes the nearer wins at every sample, whatever the order") {
    const auto plane = [](double z_left, double z_right, std::uint32_t colour) {
      const auto depth = [](double z) { return static_cast<std::uint32_t>(z * 4096); };
      return polygon(0x28, {Corner{0, 0, colour, 0, 0, depth(z_left)},
                            Corner{320 * 256, 0, colour, 0, 0, depth(z_right)},
                            Corner{0, 240 * 256, colour, 0, 0, depth(z_left)},
                            Corner{320 * 256, 240 * 256, colour, 0, 0, depth(z_right)}});
    };
    for (const bool swapped : {false, true}) {
      canvas::Options options{.colour = canvas::Colour::bits24};
      options.depth = gpu::DepthOptions{};
      options.samples = canvas::rotated_grid(4);
      Studio studio(options);
      const auto red = plane(100, 1000, 0x0000ff);
      const auto green = plane(1000, 100, 0x00ff00);
      studio.draw(swapped ? green : red);
      studio.draw(swapped ? red : green);
      studio.gpu.end_frame();
      for (int y = 1; y < 240; y += 13) {
        for (int x = 0; x < 320; ++x) {
          for (std::size_t s = 0; s < 4; ++s) {
            const double at = x + static_cast<double>(options.samples[s].x) / 256;
            if (at < 0 || std::abs(at - 160) < 1.0 / 512) continue;
            const auto colour = studio.canvas.layer(0)[static_cast<std::size_t>(y * 320 + x) * 4 + s];
            REQUIRE(colour == (at < 160 ? 0x0000ffU : 0x00ff00U));
          }
        }
      }
    }
  }

  TEST_CASE(
      "semi-transparent polygons are blended far to near over the nearest opaque one, in any order of the "
      "list") {
    struct Sheet {
      double z;
      bool lets_light_through;
      std::uint32_t colour;
    };
    std::vector<Sheet> sheets{
        {100, true, 0x000040}, {300, true, 0x004000}, {500, false, 0x808080}, {700, true, 0xffffff}};
    std::ranges::sort(sheets, {}, &Sheet::z);
    do {
      canvas::Options options{.colour = canvas::Colour::bits24};
      options.depth = gpu::DepthOptions{};
      Studio studio(options);
      for (const auto& sheet : sheets) {
        const auto z = static_cast<std::uint32_t>(sheet.z * 4096);
        const auto c = sheet.colour;
        studio.draw(polygon(sheet.lets_light_through ? 0x2a : 0x28,
                            {Corner{0, 0, c, 0, 0, z}, Corner{320 * 256, 0, c, 0, 0, z},
                             Corner{0, 240 * 256, c, 0, 0, z}, Corner{320 * 256, 240 * 256, c, 0, 0, z}}));
      }
      studio.gpu.end_frame();
      // (B + F) / 2: grey 80h, then 004000h, then 000040h; the sheet at 700 is hidden.
      CHECK(studio.canvas.layer(0)[5000] == 0x203040);
    } while (std::ranges::next_permutation(sheets, {}, &Sheet::z).found);
  }

  TEST_CASE("mip maps bring a receding checkerboard nearer to the 64-sample reference than nearest texels") {
    const Floor floor{.half_width = 600, .far = 9000};
    const auto render = [&](canvas::Filter filter, std::vector<canvas::Point> layers) {
      canvas::Options options{.width = width,
                              .height = height,
                              .fraction_bits = 8,
                              .perspective = true,
                              .filter = filter,
                              .colour = canvas::Colour::bits24};
      options.layers = std::move(layers);
      Studio studio(options);
      for (int v = 0; v < 256; ++v) {
        for (int u = 0; u < 256; ++u) {
          studio.gpu.vram().at(u, 256 + v) = ((u >> 1 ^ v >> 1) & 1) != 0 ? 0x7fff : 0x0421;
        }
      }
      studio.draw(floor.words(1, 256));
      return canvas::resolve(studio.canvas, canvas::Reconstruction::box);
    };
    const auto reference = render(canvas::Filter::nearest, canvas::regular_grid(8));
    const double nearest = mean_square_error(render(canvas::Filter::nearest, {{}}), reference);
    const double mipmap = mean_square_error(render(canvas::Filter::mipmap, {{}}), reference);
    const double linear = mean_square_error(render(canvas::Filter::mipmap_linear, {{}}), reference);
    MESSAGE("mean square error: nearest ", nearest, ", mipmap ", mipmap, ", mipmap-linear ", linear);
    CHECK(mipmap < nearest / 4);
    CHECK(linear < nearest / 4);
  }

  TEST_CASE(
      "bilinear at whole texels is the texel, halfway the mean, and never leaves the polygon's own texels") {
    canvas::Options options{.width = 16,
                            .height = 16,
                            .fraction_bits = 8,
                            .filter = canvas::Filter::bilinear,
                            .colour = canvas::Colour::bits24};
    Studio studio(options);
    for (int u = 0; u < 256; ++u) {
      for (int v = 0; v < 256; ++v)
        studio.gpu.vram().at(u, 256 + v) = static_cast<std::uint16_t>(u < 4 ? 1 + 8 * u : 0x7c00);
    }
    // u = 0, 1/2, 1, ...: texels 1, 9, 17, 25 in red, widened to 8, 74, 140, 206.
    studio.draw(polygon(0x2d,
                        {Corner{0, 0, 0, 0, 0}, Corner{6 * 256, 0, 0, 3, 0}, Corner{0, 4 * 256, 0, 0, 2},
                         Corner{6 * 256, 4 * 256, 0, 3, 2}},
                        0, 0x110));
    const std::vector<std::uint32_t> expected{8, 41, 74, 107, 140, 173};
    for (std::size_t x = 0; x < expected.size(); ++x) CHECK(studio.canvas.layer(0)[x] == expected[x]);
  }

  TEST_CASE("fog per pixel follows the ramp of the depth cue, near to far") {
    canvas::Options options{.colour = canvas::Colour::bits24};
    options.fog = canvas::Fog{255, 255, 255, 100, 1000};
    Studio studio(options);
    const auto depth = [](double z) { return static_cast<std::uint32_t>(z * 4096); };
    studio.draw(polygon(0x28, {Corner{0, 0, 0, 0, 0, depth(50)}, Corner{320 * 256, 0, 0, 0, 0, depth(2000)},
                               Corner{0, 240 * 256, 0, 0, 0, depth(50)},
                               Corner{320 * 256, 240 * 256, 0, 0, 0, depth(2000)}}));
    for (int x = 0; x < 320; ++x) {
      const double inverse = (1.0 / 50) + (1.0 / 2000 - 1.0 / 50) * x / 320;
      const double f = std::clamp(1000.0 / 900 * (1 - 100 * inverse), 0.0, 1.0);
      CHECK(std::abs(static_cast<double>(studio.canvas.layer(0)[static_cast<std::size_t>(x)] & 255) -
                     255 * f) <= 1);
    }
  }

  TEST_CASE("a frame that asks for nothing allocates one frame buffer and runs the plain kernel alone") {
    Studio studio({.width = 64, .height = 64});
    studio.draw(polygon(0x20, {Corner{0, 0, 0xff}, Corner{60 * 256, 0, 0xff}, Corner{0, 60 * 256, 0xff}}));
    const auto buffers = studio.canvas.buffers();
    REQUIRE(buffers.size() == 1);
    CHECK(buffers[0].name == "canvas colour");
    CHECK(buffers[0].bytes == 64 * 64 * 4);
    CHECK(buffers[0].bytes == canvas::Canvas::frame_bytes(studio.canvas.options()));
    const auto& runs = studio.canvas.counters().runs;
    CHECK(runs[canvas::Mode{}.index()] == 60);
    CHECK(std::ranges::count_if(runs, [](std::uint64_t n) { return n != 0; }) == 1);
  }
}
