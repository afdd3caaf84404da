#pragma once
// The stages of the accurate pixel pipeline, each a loop over the pixels of one run. A stage that a primitive
// does not need is not called. Loops over short arrays keep every stage separate to read and to step, and let
// the compiler vectorise it.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "gpu/canvas/kernels.h"
#include "gpu/canvas/texel.h"
#include "gpu/rules.h"

namespace gpu::canvas {

inline constexpr int max_samples = 8;

/// The pixels of a run on their way through the pipeline.
struct Fragments {
  std::array<std::uint8_t, run_length> alive;  // samples still to be drawn
  std::array<std::uint32_t, std::size_t{run_length} * max_samples> keys;
  std::array<std::int32_t, run_length> r, g, b;  // 0..255
  std::array<std::int32_t, run_length> u, v;     // 8.8
  std::array<std::int32_t, run_length> level;    // 8.8
  std::array<Pixel, run_length> texel;
  std::array<Pixel, run_length> colour;
};

/// Where the attributes of pixel i of a run are taken, relative to the planes' origin.
class Positions {
 public:
  Positions(const Target& target, const Planes& planes, const Run& run)
      : run_(run),
        x_(run.x * units_per_pixel - planes.origin.x),
        y_(run.y * units_per_pixel - planes.origin.y),
        offset_(target.offset) {}
  [[nodiscard]] Point at(int i) const {
    const Point offset = run_.shaded_at != nullptr ? run_.shaded_at[i] : offset_;
    return {x_ + i * units_per_pixel + offset.x, y_ + offset.y};
  }

  /// f(i, value of the plane) for the pixels of the run. Where they are taken at one offset, as nearly
  /// always, a row is a start and a step, and the compiler vectorises the loop.
  template <class F>
  void each(const RealPlane& plane, F&& f) const {
    if (run_.shaded_at != nullptr) {
      for (int i = 0; i < run_.count; ++i) f(static_cast<std::size_t>(i), plane.at(at(i).x, at(i).y));
      return;
    }
    const double start = plane.at(at(0).x, at(0).y);
    const double step = plane.per_x * static_cast<double>(units_per_pixel);
    for (int i = 0; i < run_.count; ++i) f(static_cast<std::size_t>(i), start + step * i);
  }
  template <class F>
  void each(const IntegerPlane& plane, F&& f) const {
    const auto value = [&](Point p) {
      return plane.core + plane.per_x * static_cast<std::uint64_t>(p.x) +
             plane.per_y * static_cast<std::uint64_t>(p.y);
    };
    if (run_.shaded_at != nullptr) {
      for (int i = 0; i < run_.count; ++i) f(static_cast<std::size_t>(i), value(at(i)));
      return;
    }
    std::uint64_t running = value(at(0));
    const std::uint64_t step = plane.per_x * static_cast<std::uint64_t>(units_per_pixel);
    for (int i = 0; i < run_.count; ++i, running += step) f(static_cast<std::size_t>(i), running);
  }

 private:
  const Run& run_;
  std::int64_t x_, y_;
  Point offset_;
};

/// Depth keys of every living sample; kills those that are behind. False: nothing is left.
inline bool test_depth(const Target& target, const Paint& paint, const Planes& planes, const Run& run,
                       Fragments& f) {
  const auto samples = target.samples.size();
  const auto row = static_cast<std::size_t>(run.y) * static_cast<std::size_t>(target.width) +
                   static_cast<std::size_t>(run.x);
  const RealPlane& plane = planes.inverse_z;
  const DepthConstants& depth = *paint.depth;
  const auto test = [&](std::size_t i, std::size_t sample, double inverse_z) {
    const auto key = depth.key(depth.stored(depth.quantity(inverse_z)));
    f.keys[i * samples + sample] = key;
    const bool visible = depth.wins(key, target.depth[(row + i) * samples + sample]);
    f.alive[i] = static_cast<std::uint8_t>(f.alive[i] & ~((visible ? 0U : 1U) << sample));
  };
  const bool is_scattered = run.shaded_at != nullptr && samples == 1;
  if (is_scattered) {
    Positions(target, planes, run).each(plane, [&](std::size_t i, double inverse_z) {
      test(i, 0, inverse_z);
    });
  }
  for (std::size_t sample = 0; sample < samples && !is_scattered; ++sample) {
    const Point at = target.samples[sample];
    const double start = plane.at(run.x * units_per_pixel - planes.origin.x + at.x,
                                  run.y * units_per_pixel - planes.origin.y + at.y);
    const double step = plane.per_x * static_cast<double>(units_per_pixel);
    for (int k = 0; k < run.count; ++k) test(static_cast<std::size_t>(k), sample, start + step * k);
  }
  return std::any_of(f.alive.begin(), f.alive.begin() + run.count,
                     [](std::uint8_t bits) { return bits != 0; });
}

/// `plane` as 8.8 fixed point, the console's bits. [docs/hardware.md#attribute-interpolation]
inline void interpolate(const IntegerPlane& plane, int shift, const Positions& positions,
                        std::array<std::int32_t, run_length>& out) {
  positions.each(plane, [&](std::size_t i, std::uint64_t value) {
    out[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(value) >> (shift - 8));
  });
}

/// Attribute over z, times z, as 8.8; kept inside low..high (8.8 too), which also catches a NaN.
inline void interpolate(const RealPlane& over_z, const std::array<double, run_length>& z,
                        const Positions& positions, int low, int high,
                        std::array<std::int32_t, run_length>& out) {
  positions.each(over_z, [&](std::size_t i, double value) {
    const double scaled = value * z[i] * 256 + 0.5;
    const double kept = scaled > low ? (scaled < high ? scaled : high) : low;
    out[i] = static_cast<std::int32_t>(kept);
  });
}

/// 8.8 to the nearest integer, with the console's eight-bit wrap.
inline void round_to_byte(std::array<std::int32_t, run_length>& values, int count) {
  for (int i = 0; i < count; ++i) {
    auto& value = values[static_cast<std::size_t>(i)];
    value = (value + 128) >> 8 & 255;
  }
}

/// log2 of a positive number as 8.8: the exponent, and the mantissa taken for its logarithm (error below
/// 0.09). Half of it, because callers hold squares.
inline std::int32_t half_log2(float square) {
  return (std::bit_cast<std::int32_t>(square) - (127 << 23)) >> 16;
}

/// Mip levels: log2 of the longer of the two steps in texels that one canvas pixel
/// takes to the right and down.
inline void choose_levels(const Paint& paint, const Planes& planes, const Positions& positions,
                          const std::array<double, run_length>& z, int count, Fragments& f) {
  const auto longer_step = [](double ux, double vx, double uy, double vy) {
    const double square = std::max(ux * ux + vx * vx, uy * uy + vy * vy);
    return half_log2(static_cast<float>(std::clamp(square, 1e-12, 1e12)));
  };
  constexpr auto unit = static_cast<double>(units_per_pixel);
  if (!paint.perspective) {
    const double scale = unit / static_cast<double>(std::uint64_t{1} << planes.shift);
    const auto step = [&](std::uint64_t per_unit) {
      return static_cast<double>(static_cast<std::int64_t>(per_unit)) * scale;
    };
    const auto& u = planes.integer[3];
    const auto& v = planes.integer[4];
    f.level.fill(longer_step(step(u.per_x), step(v.per_x), step(u.per_y), step(v.per_y)) + paint.level_bias);
    return;
  }
  const auto& u = planes.over_z[3];
  const auto& v = planes.over_z[4];
  const auto& w = planes.inverse_z;
  for (int i = 0; i < count; ++i) {
    const Point p = positions.at(i);
    const double depth = z[static_cast<std::size_t>(i)] * unit;
    const double at_u = u.at(p.x, p.y) * z[static_cast<std::size_t>(i)];
    const double at_v = v.at(p.x, p.y) * z[static_cast<std::size_t>(i)];
    f.level[static_cast<std::size_t>(i)] =
        longer_step((u.per_x - at_u * w.per_x) * depth, (v.per_x - at_v * w.per_x) * depth,
                    (u.per_y - at_u * w.per_y) * depth, (v.per_y - at_v * w.per_y) * depth) +
        paint.level_bias;
  }
}

/// Texels at f.u, f.v. One loop per filter: the choice is made once per run.
template <TexelFormat T>
inline void fetch_texels(const Paint& paint, int count, Fragments& f) {
  const auto each = [&](auto&& texel_at) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      f.texel[i] = f.alive[i] != 0 ? texel_at(i) : 0;
    }
  };
  switch (paint.filter) {
    case Filter::nearest:
      if (paint.is_exact) {
        each([&](std::size_t i) { return sample_inside<T>(paint.texture, paint.box, f.u[i], f.v[i]); });
      } else {
        each([&](std::size_t i) { return sample_nearest<T>(paint.texture, f.u[i], f.v[i]); });
      }
      break;
    case Filter::bilinear:
      each([&](std::size_t i) { return sample_bilinear<T>(paint.texture, paint.box, f.u[i], f.v[i]); });
      break;
    case Filter::mipmap:
    case Filter::mipmap_linear: {
      const bool mixed = paint.filter == Filter::mipmap_linear;
      each([&](std::size_t i) {
        return sample_mips(*paint.mips, paint.box, mixed, f.level[i], f.u[i], f.v[i]);
      });
      break;
    }
  }
}

/// Modulation, fog, dither, quantisation: the colour that is blended or stored. With texels widened as v << 3
/// and the low three bits cut, (texel * colour) >> 7 gives the console's (texel5 * colour) >> 4 >> 3.
/// [docs/hardware.md#texture-modulation]
template <bool textured>
inline void shade(const Paint& paint, const Run& run, const std::array<std::int32_t, run_length>& fog,
                  Fragments& f) {
  const auto& dither = dither_matrix[static_cast<std::size_t>((run.y + paint.phase_y) & 3)];
  for (int k = 0; k < run.count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    std::array<std::int32_t, 3> c{f.r[i], f.g[i], f.b[i]};
    if constexpr (textured) {
      const Pixel texel = f.texel[i];
      const std::array<std::int32_t, 3> t{static_cast<std::int32_t>(texel & 255),
                                          static_cast<std::int32_t>(texel >> 8 & 255),
                                          static_cast<std::int32_t>(texel >> 16 & 255)};
      for (std::size_t n = 0; n < 3; ++n) c[n] = (t[n] * c[n]) >> 7;
    }
    if (paint.fog != nullptr) {
      for (std::size_t n = 0; n < 3; ++n) {
        const auto lit = std::min(c[n], 255);
        c[n] = lit + ((paint.fog->colour[n] - lit) * fog[i] + 2048) / 4096;
      }
    }
    const int offset = paint.dither ? dither[static_cast<std::size_t>((run.x + paint.phase_x + k) & 3)] : 0;
    Pixel colour = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      colour |= static_cast<Pixel>(std::clamp(c[n] + offset, 0, 255)) << (8 * n);
    }
    f.colour[i] = colour & paint.quantise;
  }
}

/// Byte-wise min(255, a + b) of three bytes.
constexpr Pixel add_saturated(Pixel a, Pixel b) {
  Pixel odd = (a & 0xff00ffU) + (b & 0xff00ffU);
  Pixel even = (a & 0x00ff00U) + (b & 0x00ff00U);
  const Pixel odd_carry = odd & 0x1000100U;
  const Pixel even_carry = even & 0x10000U;
  odd |= odd_carry - (odd_carry >> 8);
  even |= even_carry - (even_carry >> 8);
  return (odd & 0xff00ffU) | (even & 0x00ff00U);
}

/// B = canvas, F = new, three bytes each. With `quantise` f8f8f8 these are the console's formulas on five
/// bits, to the bit; with ffffff the same formulas on eight. [docs/hardware.md#semi-transparency]
template <Blend mode>
constexpr Pixel blend(Pixel back, Pixel front, Pixel quantise) {
  const Pixel b = back & 0xffffffU;
  if constexpr (mode == Blend::average) return ((b & front) + (((b ^ front) & 0xfefefeU) >> 1)) & quantise;
  if constexpr (mode == Blend::add) return add_saturated(b, front) & quantise;
  if constexpr (mode == Blend::subtract) return ~add_saturated(~b & 0xffffffU, front) & quantise;
  if constexpr (mode == Blend::add_quarter)
    return add_saturated(b, (front >> 2 & 0x3f3f3fU) & quantise) & quantise;
  return front;
}

}  // namespace gpu::canvas
