// The geometry engine where its numbers run out, and fixed point where it drifts.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "gte/commands.h"
#include "gte/divide.h"
#include "scene/angle.h"
#include "stability/measure.h"
#include "stability/triangulation.h"

using gte::Registers;
using stability::Measure;
using stability::Random;

namespace {

constexpr std::uint16_t h = 320;

Registers camera(std::int32_t z) {
  Registers r;
  for (std::size_t i = 0; i < 3; ++i) r.rt[i][i].raw = 0x1000;
  r.tr[2] = z;
  r.h = h;
  return r;
}

std::int16_t any_16(Random& random) { return static_cast<std::int16_t>(random.word()); }

/// Registers from the corners of their ranges as often as from their middle.
Registers extreme(Random& random) {
  constexpr std::array<std::int32_t, 9> corners{0,          1,         -1,     0x7fff, -0x8000,
                                                0x7fffffff, INT32_MIN, 0x1000, -0x1000};
  const auto wide = [&] {
    return random.word() % 2 == 0 ? corners[random.word() % corners.size()]
                                  : static_cast<std::int32_t>(random.word());
  };
  const auto narrow = [&] {
    return random.word() % 2 == 0 ? static_cast<std::int16_t>(corners[random.word() % corners.size()])
                                  : any_16(random);
  };
  Registers r;
  for (auto* matrix : {&r.rt, &r.llm, &r.lcm}) {
    for (auto& row : *matrix) {
      for (auto& element : row) element.raw = narrow();
    }
  }
  for (auto& v : r.v) v = {narrow(), narrow(), narrow(), 0};
  for (std::size_t i = 0; i < 3; ++i) {
    r.tr[i] = wide();
    r.bk[i].raw = wide();
    r.fc[i].raw = wide();
    r.rgb[i] = {static_cast<std::uint8_t>(random.word()), static_cast<std::uint8_t>(random.word()),
                static_cast<std::uint8_t>(random.word()), 0};
    r.sxy[i] = {narrow(), narrow()};
  }
  for (auto& ir : r.ir) ir = narrow();
  for (auto& mac : r.mac) mac = wide();
  for (auto& sz : r.sz) sz = static_cast<std::uint16_t>(narrow());
  r.rgbc = r.rgb[0];
  r.ofx.raw = wide();
  r.ofy.raw = wide();
  r.h = static_cast<std::uint16_t>(narrow());
  r.dqa.raw = narrow();
  r.dqb.raw = wide();
  r.zsf3.raw = narrow();
  r.zsf4.raw = narrow();
  return r;
}

using Columns = std::array<std::array<std::int16_t, 3>, 3>;

double length(const std::array<std::int16_t, 3>& v) {
  return std::sqrt(1.0 * v[0] * v[0] + 1.0 * v[1] * v[1] + 1.0 * v[2] * v[2]) / 4096;
}

/// Registers whose RT turns by 1/1024 round z.
Registers small_step() {
  Registers r;
  const double c = scene::cos_turns(1 / 1024.0), s = scene::sin_turns(1 / 1024.0);
  const double exact[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      r.rt[i][j].raw = scene::round_saturated<std::int16_t>(exact[i][j] * 4096);
  }
  return r;
}

/// Gram-Schmidt in double, rounded back to 1.3.12.
void make_orthonormal(Columns& m) {
  std::array<std::array<double, 3>, 3> v{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 3; ++i) v[c][i] = m[c][i];
    for (std::size_t before = 0; before < c; ++before) {
      const double along = v[c][0] * v[before][0] + v[c][1] * v[before][1] + v[c][2] * v[before][2];
      for (std::size_t i = 0; i < 3; ++i) v[c][i] -= along * v[before][i];
    }
    const double size = std::sqrt(v[c][0] * v[c][0] + v[c][1] * v[c][1] + v[c][2] * v[c][2]);
    for (std::size_t i = 0; i < 3; ++i) {
      v[c][i] /= size;
      m[c][i] = scene::round_saturated<std::int16_t>(v[c][i] * 4096);
    }
  }
}

/// The largest distance of H / SZ3 from the rounded quotient over all depths; 1e9 where it is not within
/// -3..+2, or where an overflow is not told.
double division_error(std::uint32_t plane) {
  double worst = 0;
  for (std::uint32_t z = 0; z < 0x10000; ++z) {
    const auto q = gte::divide(static_cast<std::uint16_t>(plane), static_cast<std::uint16_t>(z));
    if (q.overflow != (plane >= 2 * z) || (q.overflow && q.value != 0x1ffff)) return 1e9;
    if (q.overflow) continue;
    const auto exact = static_cast<std::int64_t>((std::uint64_t{plane} * 0x20000 / z + 1) / 2);
    const auto difference = static_cast<std::int64_t>(q.value) - std::min<std::int64_t>(exact, 0x1ffff);
    if (difference < -3 || difference > 2) return 1e9;
    worst = std::max(worst, std::abs(static_cast<double>(difference)));
  }
  return worst;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("The quotient of RTPS stays within -3..+2 of the exact one") {
    // All 65,536 depths by every 61st H; the case below takes every H.
    Measure error{"4. GTE",
                  "H / SZ3 over all depths and 1,075 projection planes",
                  "a table entry or a rounding off by one",
                  "within -3..+2 of the rounded quotient, 1FFFFh and a flag from H = 2 SZ3 on",
                  "units of 2^-16",
                  3};
    for (std::uint32_t plane = 0; plane < 0x10000; plane += 61) error.see(division_error(plane), 0x10000);
  }

  TEST_CASE("long: the quotient stays within -3..+2 of the exact one for all 2^32 inputs" * doctest::skip()) {
    double worst = 0;
    for (std::uint32_t plane = 0; plane < 0x10000; ++plane) worst = std::max(worst, division_error(plane));
    CHECK(worst == 3);
  }

  TEST_CASE("A vertex that comes nearer never moves towards the centre while FLAG is clear") {
    Measure back{"4. GTE",
                 "vertices at fixed X, Y and every Z from 65,535 down",
                 "a jump inwards as Z falls",
                 "the distance from the centre never decreases",
                 "pixels",
                 0};
    Random random(4);
    for (int i = 0; i < 200; ++i) {
      auto r = camera(0);
      r.v[0] = {static_cast<std::int16_t>(random.between(-4000, 4000)),
                static_cast<std::int16_t>(random.between(-4000, 4000)), 0, 0};
      std::array<int, 2> before{};
      double worst = 0;
      std::uint64_t tried = 0;
      // Above 32,767 IR3 saturates and says so in bit 22, which is no error.
      for (std::int32_t z = 0xffff; z > 0; --z) {
        r.tr[2] = z;
        gte::rtps(r);
        if ((r.flag & gte::flag::error) != 0) break;
        // Screen coordinates round down, so a negative one moves away from 0 by itself: compare as they are.
        const std::array now{r.v[0].x < 0 ? -r.sxy[2].x : r.sxy[2].x,
                             r.v[0].y < 0 ? -r.sxy[2].y : r.sxy[2].y};
        for (std::size_t axis = 0; axis < 2; ++axis)
          worst = std::max<double>(worst, before[axis] - now[axis]);
        before = now;
        ++tried;
      }
      back.see(worst, tried);
    }
  }

  TEST_CASE("A vertex behind or on the eye is flagged, never scattered") {
    Measure unflagged{"4. GTE",
                      "vertices with SZ 0, negative Z, and Z up to H/2",
                      "a vertex behind the eye that looks sound",
                      "division overflow in FLAG, quotient 1FFFFh",
                      "vertices",
                      0};
    Random random(5);
    for (int i = 0; i < 100'000; ++i) {
      auto r = camera(random.between(-40'000, h / 2));
      r.v[0] = {any_16(random), any_16(random), 0, 0};
      gte::rtps(r);
      const bool ok = (r.flag & gte::flag::divide_overflow) != 0 && (r.flag & gte::flag::error) != 0 &&
                      (r.tr[2] >= 0 || (r.flag & gte::flag::sz3_or_otz_saturated) != 0);
      unflagged.see(ok ? 0 : 1);
    }
  }

  TEST_CASE("No command on any registers leaves its ranges") {
    // UndefinedBehaviorSanitizer watches the same inputs in the debug preset.
    Measure outside{"4. GTE",
                    "all 64 opcodes, every sf, lm, mx, v, cv, on registers from the corners of their ranges",
                    "undefined overflow, a coordinate or bucket out of range, a FLAG bit that cannot be",
                    "SX, SY -400h..3FFh; IR0 0..1000h; FLAG bits 0-11 clear and bit 31 the OR of its causes",
                    "states",
                    0};
    Random random(6);
    for (int i = 0; i < 300'000; ++i) {
      auto r = extreme(random);
      const auto command = gte::Command(
          static_cast<std::uint32_t>((random.word() & 0x1ffffc0U) | static_cast<unsigned>(i % 64)));
      gte::execute(r, command);
      const bool projects = command.opcode() == 0x01 || command.opcode() == 0x30;
      const auto on_screen = [](std::int16_t v) { return v >= -0x400 && v <= 0x3ff; };
      bool good = (r.flag & 0xfff) == 0 && r.flag == gte::flag::with_error(r.flag & gte::flag::writable);
      good = good && (!projects ||
                      (on_screen(r.sxy[2].x) && on_screen(r.sxy[2].y) && r.ir[0] >= 0 && r.ir[0] <= 0x1000));
      outside.see(good ? 0 : 1);
    }
  }

  TEST_CASE("44-bit sums wrap and flag as a 128-bit sum says") {
    Measure wrong{"4. GTE",
                  "matrix rows whose partial sums pass +-2^43",
                  "a wrap that goes unnoticed or is flagged twice",
                  "MAC1 and the two overflow bits of every partial sum",
                  "rows",
                  0};
    Random random(7);
    for (int i = 0; i < 200'000; ++i) {
      auto r = extreme(random);
      // Alternating signs let a sum leave the range and come back.
      const auto any_corner = [&] {
        return static_cast<std::int16_t>(random.word() % 2 == 0 ? 0x7fff : -0x8000);
      };
      if (i % 2 == 0) {
        r.tr[0] = random.word() % 2 == 0 ? INT32_MAX : INT32_MIN;
        for (auto& element : r.rt[0]) element.raw = any_corner();
        r.v[0] = {any_corner(), any_corner(), any_corner(), 0};
      }
      __extension__ using wide = __int128;
      const std::array<std::int16_t, 3> v{r.v[0].x, r.v[0].y, r.v[0].z};
      wide sum = static_cast<wide>(r.tr[0]) * 4096;
      std::uint32_t flags = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        sum += static_cast<wide>(r.rt[0][c].raw) * v[c];
        if (sum > (static_cast<wide>(1) << 43) - 1) flags |= gte::flag::mac1_positive;
        if (sum < -(static_cast<wide>(1) << 43)) flags |= gte::flag::mac1_negative;
        const wide modulus = static_cast<wide>(1) << 44;
        sum = ((sum % modulus) + modulus) % modulus;  // 0..2^44-1
        if (sum >= modulus / 2) sum -= modulus;
      }
      const auto mac =
          static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(sum >> 12)));
      gte::mvmva(r, gte::Command{0x0480012});  // sf, RT, V0, TR
      const auto overflow = gte::flag::mac1_positive | gte::flag::mac1_negative;
      wrong.see(r.mac[1] == mac && (r.flag & overflow) == flags ? 0 : 1);
    }
  }

  TEST_CASE("A camera that moves by less than a unit moves no vertex by more than the rounding") {
    // Exact: rotation and translation in double. The matrix rounds to 1/4096 (half a step times 3 x 1,000
    // units of vertex = 0.37 units), the translation to 1 (0.5), MAC to 1 (floor): 1.87 units in x and z,
    // times H/Z and 1 + |x/z|, and the screen rounds down by up to a pixel.
    Measure error{"4. GTE",
                  "1,000 camera positions a fraction of a unit apart, 64 vertices",
                  "vertices that jump as the camera creeps",
                  "within 1 + 1.87 (1 + abs(x/z)) H/z pixels of the exact projection",
                  "of the bound",
                  1};
    Random random(8);
    std::array<gte::Vertex, 64> mesh{};
    for (auto& v : mesh) {
      v = {static_cast<std::int16_t>(random.between(-1000, 1000)),
           static_cast<std::int16_t>(random.between(-1000, 1000)),
           static_cast<std::int16_t>(random.between(-1000, 1000)), 0};
    }
    for (int step = 0; step < 1000; ++step) {
      const double turns = step / 7000.0;
      const double c = scene::cos_turns(turns), s = scene::sin_turns(turns);
      const double rotation[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
      const double translation[3] = {step * 0.13 - 65, step * 0.07, 2500 - step * 0.31};
      Registers r;
      r.h = h;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
          r.rt[i][j].raw = scene::round_saturated<std::int16_t>(rotation[i][j] * 4096);
        r.tr[i] = scene::round_saturated<std::int32_t>(translation[i]);
      }
      for (const auto& v : mesh) {
        r.v[0] = v;
        gte::rtps(r);
        if ((r.flag & gte::flag::error) != 0) continue;
        std::array<double, 3> exact{};
        for (std::size_t i = 0; i < 3; ++i) {
          exact[i] = rotation[i][0] * v.x + rotation[i][1] * v.y + rotation[i][2] * v.z + translation[i];
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double ratio = exact[axis] / exact[2];
          const double screen = axis == 0 ? r.sxy[2].x : r.sxy[2].y;
          const double bound = 1 + 1.87 * (1 + std::abs(ratio)) * h / exact[2];
          error.see(std::abs(screen - ratio * h) / bound);
        }
      }
    }
  }

  TEST_CASE("A million composed rotations saturate, and two remedies hold") {
    // One small rotation, multiplied on by MVMVA column by column, as a program does that keeps no angle. The
    // rounded matrix is not quite a rotation (its columns are sqrt(4096^2 + 25^2) long), so lengths grow
    // until IR saturates.
    Measure composed{"5. Drift",
                     "1,000,000 rotations of 1/1024 turn composed in 1.3.12, no remedy",
                     "a matrix that wraps round",
                     "elements saturate at 8 and FLAG says so; the length error is told here",
                     "of 1.0",
                     13};
    Measure mended{"5. Drift",
                   "the same, columns made orthonormal again every 64 steps",
                   "lengths that run away",
                   "column lengths within 1/64 of 1: 64 steps of one unit each",
                   "of 1.0",
                   1 / 64.0};
    Measure rebuilt{"5. Drift",
                    "the same rotation from its angle at every 1,000th step",
                    "error that grows with time",
                    "every element within 1/8192 + 4e-7 of the exact one",
                    "of 1.0",
                    1.0 / 8192 + 4e-7};
    for (const bool mend : {false, true}) {
      double worst = 0;
      std::uint32_t flags = 0;
      Columns m{{{4096, 0, 0}, {0, 4096, 0}, {0, 0, 4096}}};
      Registers r = small_step();
      for (int step = 1; step <= 1'000'000; ++step) {
        for (auto& column : m) {
          r.v[0] = {column[0], column[1], column[2], 0};
          gte::mvmva(r, gte::Command{0x0486012});  // sf, RT, V0, no translation
          flags |= r.flag;
          column = {r.ir[1], r.ir[2], r.ir[3]};
        }
        for (const auto& column : m) worst = std::max(worst, std::abs(1 - length(column)));
        if (mend && step % 64 == 0) make_orthonormal(m);
      }
      CHECK((flags != 0) == !mend);
      (mend ? mended : composed).see(worst, 1'000'000);
    }
    for (int step = 0; step <= 1'000'000; step += 1000) {
      const double exact = std::sin(2 * std::numbers::pi * std::fmod(step / 1024.0, 1.0));
      rebuilt.see(std::abs(
          scene::round_saturated<std::int16_t>(scene::sin_turns(step / 1024.0) * 4096) / 4096.0 - exact));
    }
  }

  TEST_CASE("Floats survive the trip through 1.3.12 to half a step") {
    Measure error{"5. Drift",
                  "floats -8..8 to 1.3.12 and back, and far outside, infinite and NaN",
                  "undefined conversion, truncation",
                  "half a step of 1/4096; saturation outside; NaN is 0",
                  "of 1.0",
                  1.0 / 8192};
    Random random(9);
    for (int i = 0; i < 200'000; ++i) {
      const double value = (static_cast<double>(random.word()) / 4294967296.0 * 16 - 8) * 0.99993;
      error.see(std::abs(scene::round_saturated<std::int16_t>(value * 4096) / 4096.0 - value));
    }
    CHECK(scene::round_saturated<std::int16_t>(1e300) == 0x7fff);
    CHECK(scene::round_saturated<std::int16_t>(-HUGE_VAL) == -0x8000);
    CHECK(scene::round_saturated<std::int16_t>(std::nan("")) == 0);
  }
}
