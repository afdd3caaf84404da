// The z-buffer where precision runs out, and the orders that must not matter.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <vector>

#include "gpu/columns.h"
#include "gpu/gpu.h"
#include "gte/commands.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"
#include "ot/walker.h"
#include "scene/angle.h"
#include "stability/measure.h"
#include "stability/send.h"
#include "stability/triangulation.h"

using gpu::DepthFormat;
using gpu::DepthMapping;
using gpu::DepthOptions;
using gpu::Gpu;
using stability::Measure;
using stability::Random;
using stability::send;

namespace {

struct Corner {
  int x = 0, y = 0;
  std::uint32_t z = 0;  // 20.12
};
using Triangle = std::array<Corner, 3>;

void draw(Gpu& gpu, const Triangle& t, ot::Rgb colour = {255, 255, 255}) {
  ot::DepthAnnotation depth;
  ot::Polygon p;
  p.rgb[0] = colour;
  for (std::size_t v = 0; v < 3; ++v) {
    p.xy[v] = {static_cast<std::int16_t>(t[v].x), static_cast<std::int16_t>(t[v].y)};
    depth.z[v] = t[v].z;
  }
  send(gpu, depth);
  send(gpu, p);
}

std::unique_ptr<Gpu> with_depth(const DepthOptions& options) {
  auto gpu = std::make_unique<Gpu>();
  send(*gpu, ot::DrawArea{});
  gpu->set_depth(options);
  gpu->begin_frame();
  return gpu;
}

/// View-space z at a pixel: 1/z is affine on the screen. Long double, whose 64 bits leave the comparison
/// exact to far below a step of 32 bits; where long double is double, the bound below still holds.
double z_at(const Triangle& t, int x, int y) {
  using real = long double;
  const auto cross = [](real ax, real ay, real bx, real by) { return ax * by - ay * bx; };
  const real area = cross(t[1].x - t[0].x, t[1].y - t[0].y, t[2].x - t[0].x, t[2].y - t[0].y);
  const real w1 = cross(x - t[0].x, y - t[0].y, t[2].x - t[0].x, t[2].y - t[0].y) / area;
  const real w2 = cross(t[1].x - t[0].x, t[1].y - t[0].y, x - t[0].x, y - t[0].y) / area;
  const auto z = [&](std::size_t v) { return static_cast<real>(t[v].z) / 4096; };
  return static_cast<double>(1 / ((1 - w1 - w2) / z(0) + w1 / z(1) + w2 / z(2)));
}

/// Stored depth as a number that grows by one from one representable depth to the next.
double steps(std::uint32_t stored) { return stored; }

/// How far stored depths of a rectangle are apart when it is cut along one diagonal and along the other.
/// Corners: top left at 0, 0, top right, bottom left, bottom right.
double between_diagonals(const DepthOptions& options, const std::array<Corner, 4>& c) {
  const auto one = with_depth(options), two = with_depth(options);
  draw(*one, {c[0], c[1], c[2]});
  draw(*one, {c[1], c[3], c[2]});
  draw(*two, {c[0], c[1], c[3]});
  draw(*two, {c[0], c[3], c[2]});
  double worst = 0;
  for (int y = 0; y < c[3].y; ++y) {
    for (int x = 0; x < c[3].x; ++x) {
      worst = std::max(
          worst, std::abs(steps(one->depth_plane()->stored(x, y)) - steps(two->depth_plane()->stored(x, y))));
    }
  }
  return worst;
}

std::vector<DepthOptions> formats() {
  std::vector<DepthOptions> all;
  for (const auto format :
       {DepthFormat::bits16, DepthFormat::bits24, DepthFormat::bits32, DepthFormat::float32}) {
    for (const auto mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
      for (const bool reversed : {false, true}) {
        all.push_back({.format = format, .mapping = mapping, .reversed = reversed});
      }
    }
  }
  return all;
}

/// Stored depth per unit of 1/z: d = far / (far - near) (1 - near / z), in steps.
double steps_per_nearness(const DepthOptions& options) {
  return options.far_z * options.near_z / (options.far_z - options.near_z) * gpu::depth_scale(options.format);
}

/// Steps that rounding z to 20.12, half of 1/4096 at most, moves a corner by.
double moved_by_rounding(const DepthOptions& options, double nearness) {
  return steps_per_nearness(options) * nearness * nearness / 8192;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Depth stepped along 1,023 pixels equals depth computed at each") {
    Measure integer{"6. Depth",
                    "spans of up to 1,023 pixels, 16, 24 and 32 bits, both mappings, reversed too",
                    "error that grows along a span",
                    "within 1 step of the exact value",
                    "steps",
                    1};
    Measure floating{"6. Depth",
                     "the same in float, hyperbolic and linear",
                     "error that grows along a span",
                     "within 2^-20 of the exact value, 4 units in the last place near 1",
                     "of 1.0",
                     1.0 / (1 << 20)};
    Random random(60);
    for (const auto& options : formats()) {
      for (int i = 0; i < 6; ++i) {
        const auto depth = [&] { return static_cast<std::uint32_t>(random.between(20, 60'000)) << 12; };
        const Triangle t{
            {{0, 0, depth()}, {1023, random.between(0, 30), depth()}, {random.between(0, 9), 60, depth()}}};
        const auto gpu = with_depth(options);
        draw(*gpu, t);
        double worst = 0;
        std::uint64_t pixels = 0;
        gpu::for_each_covered_row(
            {{{t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}}}, [&](int y, int left, int right) {
              for (int x = left; x < right; ++x, ++pixels) {
                const auto expected = gpu::stored_depth(options, z_at(t, x, y));
                const auto stored = gpu->depth_plane()->stored(x, y);
                if (options.format == DepthFormat::float32) {
                  worst = std::max(worst, std::abs(static_cast<double>(std::bit_cast<float>(expected)) -
                                                   static_cast<double>(std::bit_cast<float>(stored))));
                } else {
                  worst = std::max(worst, std::abs(steps(expected) - steps(stored)));
                }
              }
            });
        (options.format == DepthFormat::float32 ? floating : integer).see(worst, pixels);
      }
    }
  }

  TEST_CASE("A plane triangulated two ways has the same depths") {
    Measure exact{"6. Depth",
                  "rectangles of one view-space z, cut along either diagonal",
                  "depth that depends on the mesh",
                  "equal depths",
                  "steps",
                  0};
    Measure sloped{"6. Depth",
                   "sloped rectangles whose 1/z is affine, cut along either diagonal, 24 bits",
                   "decals that flicker with the mesh",
                   "1 step, and what rounding z to 20.12 moves",
                   "of the bound",
                   1};
    Random random(61);
    for (int i = 0; i < 60; ++i) {
      const bool flat = i % 2 == 0;
      const double a = 1.0 / random.between(50, 4000),
                   dx = flat ? 0 : a * random.between(-300, 300) / 300'000.0,
                   dy = flat ? 0 : a * random.between(-300, 300) / 300'000.0;
      const int width = random.between(8, 300), height = random.between(8, 230);
      double rounding = 0;
      const auto corner = [&](int x, int y) {
        const double nearness = a + dx * x + dy * y;
        rounding = std::max(rounding, moved_by_rounding({}, nearness));
        return Corner{x, y, scene::round_saturated<std::uint32_t>(4096 / nearness)};
      };
      const Corner p = corner(0, 0), q = corner(width, 0), r = corner(0, height), s = corner(width, height);
      const double worst = between_diagonals({}, {p, q, r, s});
      const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
      if (flat) {
        exact.see(worst, pixels);
      } else {
        sloped.see(worst / (1 + 2 * rounding), pixels);
      }
    }
  }

  TEST_CASE(
      "A plane whose corners are snapped to pixels has depths within gradient x snap, however it is cut") {
    Measure apart{
        "6. Depth",
        "sloped rectangles, corners projected to fractions of a pixel and snapped to whole ones, cut "
        "along either diagonal, 16 and 24 bits",
        "depths that depend on the mesh by more than the snapping explains",
        "gradient x 1 pixel on each axis, 1 step, and what rounding z to 20.12 moves",
        "of the bound",
        1};
    Random random(62);
    for (int i = 0; i < 80; ++i) {
      const DepthOptions options{.format = i % 2 == 0 ? DepthFormat::bits16 : DepthFormat::bits24};
      // 1/z, affine on the screen; the depths lie between 200 and 8,000.
      const double a = 1.0 / random.between(400, 4000), dx = a * random.between(-300, 300) / 600'000.0,
                   dy = a * random.between(-300, 300) / 500'000.0;
      double rounding = 0;
      const auto corner = [&](int x, int y) {
        const double at_x = x + random.between(-127, 127) / 256.0,
                     at_y = y + random.between(-127, 127) / 256.0;
        const double nearness = a + dx * at_x + dy * at_y;
        rounding = std::max(rounding, moved_by_rounding(options, nearness));
        return Corner{x, y, scene::round_saturated<std::uint32_t>(4096 / nearness)};
      };
      const int width = random.between(8, 300), height = random.between(8, 230);
      const Corner p = corner(0, 0), q = corner(width, 0), r = corner(0, height), s = corner(width, height);
      const double worst = between_diagonals(options, {p, q, r, s});
      const double bound = steps_per_nearness(options) * (std::abs(dx) + std::abs(dy)) + 1 + 2 * rounding;
      apart.see(worst / bound, static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height));
    }
  }

  TEST_CASE("Depths of zero, at near, at far and as large as a word can be stay between their corners'") {
    Measure outside{"6. Depth",
                    "triangles with every combination of the depths 0, 2^-12, just below near, near, 1,000, "
                    "far, just beyond far and 2^20 - 2^-12, every format; the same with fractions, which "
                    "carry some samples out of their triangle",
                    "a division by zero, a conversion that overflows, depths that wrap",
                    "within 1 step (float: 2^-20) of the range of the corners' stored depths; with "
                    "fractions, a number that the format has",
                    "pixels",
                    0};
    const auto units = [](double z) { return static_cast<std::uint32_t>(z * 4096); };
    const std::array<std::uint32_t, 8> depths{
        0, 1, units(16) - 1, units(16), units(1000), units(65535), units(65535) + 1, 0xffffffff};
    for (const auto& options : formats()) {
      const auto gpu = with_depth(options);
      unsigned cell = 0;  // a place of its own for each triangle: to clear all of VRAM takes longer
      const auto value = [&](std::uint32_t stored) {
        return options.format == DepthFormat::float32 ? static_cast<double>(std::bit_cast<float>(stored))
                                                      : steps(stored);
      };
      const double slack = options.format == DepthFormat::float32 ? 1.0 / (1 << 20) : 1;
      for (unsigned code = 0; code < 8 * 8 * 8; ++code) {
        const std::array<std::uint32_t, 3> z{depths[code % 8], depths[code / 8 % 8], depths[code / 64]};
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto corner : z) {
          const double at = value(gpu::stored_depth(options, corner / 4096.0));
          low = std::min(low, at);
          high = std::max(high, at);
        }
        for (const bool fractions : {false, true}) {
          const int left = static_cast<int>(cell % 21) * 48, top = static_cast<int>(cell / 21) * 32;
          if (cell++ == 0) gpu->begin_frame();
          if (cell == 21 * 16) cell = 0;
          ot::DepthAnnotation annotation;
          annotation.z = {z[0], z[1], z[2]};
          annotation.has_fractions = fractions;
          if (fractions) annotation.fx = annotation.fy = {0, 255, 3, 0};
          send(*gpu, annotation);
          ot::Polygon p;
          const auto at_cell = [&](int x, int y) {
            return ot::Xy{static_cast<std::int16_t>(left + x), static_cast<std::int16_t>(top + y)};
          };
          p.xy = {at_cell(2, 1), at_cell(40, 3), at_cell(5, 30)};
          send(*gpu, p);
          int bad = 0;
          std::uint64_t pixels = 0;
          for (int y = top; y < top + 32; ++y) {
            for (int x = left; x < left + 48; ++x) {
              if (gpu->depth_plane()->is_empty(x, y)) continue;
              ++pixels;
              const double at = value(gpu->depth_plane()->stored(x, y));
              bad += fractions ? !(at >= 0 && at <= gpu::depth_scale(options.format))
                               : !(at >= low - slack && at <= high + slack);
            }
          }
          outside.see(bad, pixels);
        }
      }
    }
  }

  TEST_CASE("A decal on the surface's own vertices never flickers over a camera path") {
    Measure own{"6. Depth",
                "decal with the surface's vertices, lequal, 1,000 camera positions, 16 bits",
                "a decal that flickers",
                "no pixel of the surface shows through",
                "pixels",
                0};
    Measure biased{"6. Depth",
                   "decal with vertices of its own inside the surface, 24 bits: least bias that never fails, "
                   "250 positions",
                   "a decal that sinks in",
                   "a bias of at most 8 units of view-space z is enough",
                   "units",
                   8};
    const auto project = [](int step, std::array<std::array<int, 3>, 4> world) {
      gte::Registers r;
      const double turns = 0.05 + step / 9000.0;
      const double c = scene::cos_turns(turns), s = scene::sin_turns(turns);
      const double rotation[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
          r.rt[i][j].raw = scene::round_saturated<std::int16_t>(rotation[i][j] * 4096);
      }
      r.tr = {-20 + step / 20, step / 40, 900 - step / 3};
      r.h = 320;
      r.ofx.raw = 160 << 16;
      r.ofy.raw = 120 << 16;
      std::array<Corner, 4> out{};
      for (std::size_t v = 0; v < 4; ++v) {
        r.v[0] = {static_cast<std::int16_t>(world[v][0]), static_cast<std::int16_t>(world[v][1]),
                  static_cast<std::int16_t>(world[v][2]), 0};
        gte::rtps(r);
        REQUIRE((r.flag & gte::flag::error) == 0);
        // The sum before >> 12: view-space z with its 12 fraction bits.
        const std::int64_t z = (std::int64_t{r.tr[2]} << 12) + std::int64_t{r.rt[2][0].raw} * world[v][0] +
                               std::int64_t{r.rt[2][1].raw} * world[v][1] +
                               std::int64_t{r.rt[2][2].raw} * world[v][2];
        out[v] = {r.sxy[2].x, r.sxy[2].y, static_cast<std::uint32_t>(z)};
      }
      return out;
    };
    const auto draw_quad = [](Gpu& gpu, const std::array<Corner, 4>& v, ot::Rgb colour) {
      draw(gpu, {v[0], v[1], v[2]}, colour);
      draw(gpu, {v[1], v[3], v[2]}, colour);
    };
    constexpr std::array<std::array<int, 3>, 4> wall{
        {{-150, -100, 0}, {150, -100, 0}, {-150, 100, 0}, {150, 100, 0}}};
    constexpr std::array<std::array<int, 3>, 4> poster{
        {{-61, -43, 0}, {77, -43, 0}, {-61, 59, 0}, {77, 59, 0}}};
    const DepthOptions coarse{.format = DepthFormat::bits16, .test = gpu::DepthTest::lequal};
    for (int step = 0; step < 1000; ++step) {
      const auto gpu = with_depth(coarse);
      const auto v = project(step, wall);
      draw_quad(*gpu, v, {255, 0, 0});
      draw_quad(*gpu, v, {0, 255, 0});
      own.see(static_cast<double>(std::ranges::count(gpu->vram().pixels(), std::uint16_t{0x001f})));
    }
    double least = 0;
    for (int step = 0; step < 1000; step += 4) {
      const auto v = project(step, wall), d = project(step, poster);
      for (;; least += 0.25) {
        const auto bias = static_cast<std::uint32_t>(least * 4096);
        const auto alone = with_depth({}), both = with_depth({.test = gpu::DepthTest::lequal});
        auto nearer = d;
        for (auto& corner : nearer) corner.z -= bias;
        draw_quad(*alone, nearer, {0, 255, 0});
        draw_quad(*both, v, {255, 0, 0});
        draw_quad(*both, nearer, {0, 255, 0});
        const auto green = [](const Gpu& gpu) {
          return std::ranges::count(gpu.vram().pixels(), std::uint16_t{0x03e0});
        };
        if (green(*alone) == green(*both) || least > 100) break;
      }
      biased.see(least);
    }
  }

  TEST_CASE("Stored depths tell apart what theory says they can") {
    Measure error{
        "6. Depth",
        "least z difference that changes the stored depth, 16 and 24 bits, near 1 and 16, far 65,535",
        "a mapping that wastes its bits",
        "z^2 (far - near) / (far near (2^bits - 1)), to 1 %, and (far - near) / (2^bits - 1) linear",
        "of the theory's value",
        0.01};
    for (const auto format : {DepthFormat::bits16, DepthFormat::bits24}) {
      for (const auto mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
        for (const double near_z : {1.0, 16.0}) {
          const DepthOptions o{.format = format, .mapping = mapping, .near_z = near_z, .far_z = 65535};
          for (const double z : {20.0, 100.0, 1000.0, 5000.0}) {
            const double theory =
                mapping == DepthMapping::linear
                    ? (o.far_z - near_z) / gpu::depth_scale(format)
                    : z * z * (o.far_z - near_z) / (o.far_z * near_z * gpu::depth_scale(format));
            if (theory > z / 50) continue;  // the spacing itself changes too much over one step
            // Over about 1 % of z, count the steps: width / steps is the spacing there.
            const double width = std::max(z / 100, 200 * theory);
            if (width > z / 4) continue;
            const double low = gpu::stored_depth(o, z - width / 2),
                         high = gpu::stored_depth(o, z + width / 2);
            const double expected = mapping == DepthMapping::linear
                                        ? width / theory
                                        : width * z * z / ((z - width / 2) * (z + width / 2)) / theory;
            error.see(std::abs((high - low) / expected - 1) - 1 / expected);
          }
        }
      }
    }
  }

  TEST_CASE("Permuting opaque triangles of different depths leaves a z-buffered frame as it was") {
    Measure different{"8. Order",
                      "60 random triangles, each at its own z, in 12 orders, every depth format",
                      "a picture that depends on the order of submission",
                      "the same frame",
                      "pixels",
                      0};
    Random random(80);
    for (const auto& options : formats()) {
      std::vector<std::pair<Triangle, ot::Rgb>> scene;
      for (int i = 0; i < 60; ++i) {
        // Ratios of 1.08 between neighbouring depths: far more than a step of the coarsest format.
        const auto z = static_cast<std::uint32_t>(20 * std::pow(1.08, i) * 4096);
        Triangle t{};
        for (auto& corner : t) corner = {random.between(-50, 370), random.between(-50, 290), z};
        scene.push_back({t, {static_cast<std::uint8_t>(i * 4), static_cast<std::uint8_t>(255 - i * 4), 128}});
      }
      std::vector<std::uint16_t> first;
      for (int order = 0; order < 12; ++order) {
        for (std::size_t i = scene.size() - 1; i > 0; --i)
          std::swap(scene[i], scene[random.word() % (i + 1)]);
        const auto gpu = with_depth(options);
        for (const auto& [t, colour] : scene) draw(*gpu, t, colour);
        (void)gpu->end_frame();
        const auto pixels = gpu->vram().pixels();
        if (order == 0) first.assign(pixels.begin(), pixels.end());
        int wrong = 0;
        for (std::size_t i = 0; i < first.size(); ++i) wrong += pixels[i] != first[i];
        different.see(wrong);
      }
    }
  }

  TEST_CASE("Equal buckets are drawn last in, first out, or first in, first out when asked") {
    Measure wrong{"8. Order",
                  "packets into random buckets, both orders",
                  "ties that fall as they like",
                  "the order of insertion, reversed on the console",
                  "packets",
                  0};
    Random random(81);
    for (const auto order : {ot::Order::lifo, ot::Order::fifo}) {
      ot::MainRam ram(ot::RamSize::mib2);
      ot::OrderingTable table(ram, 0, 16, order);
      table.clear();
      ot::PacketArena arena(ram, 64, ram.size_bytes());
      std::vector<std::vector<std::uint32_t>> expected(16);
      for (std::uint32_t i = 0; i < 5000; ++i) {
        const auto node = arena.push(std::array{i});
        REQUIRE(node);
        const auto bucket = static_cast<std::uint32_t>(random.word() % 16);
        table.insert(bucket, *node);
        expected[bucket].push_back(i);
      }
      std::vector<std::uint32_t> sent, wanted;
      const auto result =
          ot::walk(ram, table.head(), [&](std::uint32_t, std::span<const std::uint32_t> payload) {
            sent.insert(sent.end(), payload.begin(), payload.end());
          });
      REQUIRE(result);
      for (std::size_t b = 16; b-- > 0;) {
        if (order == ot::Order::lifo) std::ranges::reverse(expected[b]);
        wanted.insert(wanted.end(), expected[b].begin(), expected[b].end());
      }
      wrong.see(sent == wanted ? 0 : 1, 5000);
    }
  }
}
