#include "gpu/canvas/kernels.h"

#include <algorithm>
#include <utility>

#include "gpu/canvas/stages.h"

namespace gpu::canvas {
namespace {

/// Colours of the vertices, interpolated; flat and raw ones are constant.
void interpolate_colour(const Paint& paint, const Planes& planes, const Positions& positions,
                        const std::array<double, run_length>& z, int count, Fragments& f) {
  const std::array<std::array<std::int32_t, run_length>*, 3> channels{&f.r, &f.g, &f.b};
  for (std::size_t c = 0; c < 3; ++c) {
    auto& values = *channels[c];
    if (paint.raw || !paint.gouraud) {
      constexpr std::int32_t unchanged = 128;  // modulation by 80h gives the texel back
      const auto flat = static_cast<std::int32_t>(planes.integer[c].core >> planes.shift & 255);
      std::fill_n(values.begin(), count, paint.raw ? unchanged : flat);
      continue;
    }
    if (paint.perspective) {
      interpolate(planes.over_z[c], z, positions, 0, 255 * 256, values);
    } else {
      interpolate(planes.integer[c], planes.shift, positions, values);
    }
    round_to_byte(values, count);
  }
}

void interpolate_texture(const Paint& paint, const Planes& planes, const Positions& positions,
                         const std::array<double, run_length>& z, int count, Fragments& f) {
  const auto& box = paint.box;
  if (paint.perspective) {
    interpolate(planes.over_z[3], z, positions, box.u_low, box.u_high, f.u);
    interpolate(planes.over_z[4], z, positions, box.v_low, box.v_high, f.v);
  } else {
    interpolate(planes.integer[3], planes.shift, positions, f.u);
    interpolate(planes.integer[4], planes.shift, positions, f.v);
  }
  if (paint.filter >= Filter::mipmap) choose_levels(paint, planes, positions, z, count, f);
}

/// z (in units of 4096ths, as the plane has it) at every pixel; a z that is not positive reads as far away.
void interpolate_z(const Planes& planes, const Positions& positions, std::array<double, run_length>& z) {
  positions.each(planes.inverse_z,
                 [&](std::size_t i, double inverse) { z[i] = 1 / (inverse > 1e-12 ? inverse : 1e-12); });
}

void fog_factors(const FogRamp& ramp, const Planes& planes, const Positions& positions,
                 std::array<std::int32_t, run_length>& fog) {
  positions.each(planes.inverse_z, [&](std::size_t i, double inverse) {
    const double f = ramp.constant + ramp.slope * inverse;
    fog[i] = static_cast<std::int32_t>((f > 0 ? (f < 1 ? f : 1) : 0) * 4096 + 0.5);
  });
}

/// Both coordinates in one word. They may leave 0..255 by half a texel, so 128 keeps them positive.
constexpr std::uint32_t texcoord(std::int32_t u, std::int32_t v) {
  const auto half = [](std::int32_t c) { return static_cast<std::uint32_t>(std::clamp(c + 128, 0, 0xffff)); };
  return half(u) | half(v) << 16;
}

/// Whether the depth test alone stopped pixel i, which a watcher is told. Without one there is no code for
/// it.
template <Mode M>
bool is_rejected([[maybe_unused]] const std::uint8_t* rejected, [[maybe_unused]] std::size_t i) {
  if constexpr (M.trace && M.depth) return rejected != nullptr && rejected[i] != 0;
  return false;
}

/// A watcher is told of pixels that only the depth test stops: they live on, marked in `rejected`. nullptr
/// when nobody watches. `rejected` comes in as what lived before the test.
const std::uint8_t* keep_rejected(const Target& target, const Run& run, Fragments& f,
                                  std::array<std::uint8_t, run_length>& rejected) {
  if (target.watch == nullptr) return nullptr;
  for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
    const std::uint8_t before = rejected[i];
    rejected[i] = static_cast<std::uint8_t>(before & ~f.alive[i]);
    f.alive[i] = before;
  }
  return rejected.data();
}

/// What a watcher is told: a watched canvas has one sample a pixel, and its pixels are those of VRAM.
void note(const Watch& watch, const Run& run, std::size_t i, Event event) {
  event.pixel =
      static_cast<std::uint32_t>(Vram::offset(watch.x + run.x + static_cast<int>(i), watch.y + run.y));
  watch.note(event);
}

/// Blends, stores colour, mask bit, depth and id of every living sample.
template <Mode M>
void write(const Target& target, const Paint& paint, const Run& run, const Fragments& f,
           const std::uint8_t* rejected, Counters& counters) {
  const auto samples = target.samples.size();
  const auto row = static_cast<std::size_t>(run.y) * static_cast<std::size_t>(target.width) +
                   static_cast<std::size_t>(run.x);
  std::uint64_t written = 0;
  std::uint64_t blended = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
    if (f.alive[i] == 0) continue;
    const bool is_lost = is_rejected<M>(rejected, i);
    constexpr bool textured = M.texture != TexelFormat::none;
    const Pixel texel = textured ? f.texel[i] : texel_solid | texel_semi;
    if ((texel & texel_solid) == 0) continue;
    const bool semi = M.blend != Blend::opaque && (texel & texel_semi) != 0;
    if (paint.pass != Pass::console && semi != (paint.pass == Pass::semi_transparent)) continue;
    const Pixel mask = paint.mask_set | (textured && (texel & texel_semi) != 0 ? mask_bit : 0);
    for (std::size_t s = 0; s < samples; ++s) {
      if ((f.alive[i] >> s & 1) == 0) continue;
      const auto at = (row + i) * samples + s;
      Pixel& pixel = target.colour[at];
      if (paint.mask_test && (pixel & mask_bit) != 0) continue;
      const Pixel mixed = (semi ? blend<M.blend>(pixel, f.colour[i], paint.quantise) : f.colour[i]) | mask;
      if constexpr (M.trace) {
        if (target.watch != nullptr) {
          note(*target.watch, run, i,
               {.depth = M.depth ? f.keys[i] : 0,
                .before = to_16_bits(pixel),
                .after = to_16_bits(is_lost ? pixel : mixed),
                .fragment = to_16_bits(f.colour[i] | mask),
                .blended = semi,
                .rejected = is_lost});
        }
        if (is_lost) continue;
      }
      pixel = mixed;
      if constexpr (M.depth) {
        if (paint.pass == Pass::opaque) target.depth[at] = f.keys[i * samples + s];
      }
      if constexpr (M.trace) {
        if (s == 0 && target.ids != nullptr) {
          target.ids[row + i] = paint.id;
          if constexpr (textured) target.texcoords[row + i] = texcoord(f.u[i], f.v[i]);
        }
      }
      ++written;
      if (semi) ++blended;
    }
  }
  counters.written += written;
  counters.blended += blended;
  if (M.depth && paint.pass == Pass::opaque) counters.stored += written;
}

/// Bytes that one texel is made of.
template <TexelFormat T>
constexpr std::uint64_t bytes_per_texel(Filter filter) {
  constexpr std::uint64_t fetch =
      T == TexelFormat::direct15 ? 2 : 4;  // a halfword of VRAM, one of the palette
  constexpr std::uint64_t taps = 4;
  switch (filter) {
    case Filter::nearest:
      return fetch;
    case Filter::bilinear:
      return taps * fetch;
    case Filter::mipmap:
      return taps * sizeof(Pixel);
    case Filter::mipmap_linear:
      break;
  }
  return 2 * taps * sizeof(Pixel);
}

template <Mode M>
void kernel(const Target& target, const Paint& paint, const Planes& planes, const Run& run,
            Counters& counters) {
  Fragments f;
  if (run.covered != nullptr) {
    std::copy_n(run.covered, run.count, f.alive.begin());
  } else {
    const auto all = static_cast<std::uint8_t>((1U << target.samples.size()) - 1);
    std::fill_n(f.alive.begin(), run.count, all);
  }
  const auto living = [&] {
    return static_cast<std::uint64_t>(
        run.count - std::count(f.alive.begin(), f.alive.begin() + run.count, std::uint8_t{0}));
  };
  const auto covered = run.covered == nullptr ? static_cast<std::uint64_t>(run.count) : living();
  counters.covered += covered;
  ++counters.runs[M.index()];
  const std::uint8_t* rejected = nullptr;
  [[maybe_unused]] std::array<std::uint8_t, run_length> before;
  if constexpr (M.depth) {
    counters.tested += covered * target.samples.size();
    if constexpr (M.trace) std::copy_n(f.alive.begin(), run.count, before.begin());
    const bool any = test_depth(target, paint, planes, run, f);
    if constexpr (M.trace) rejected = keep_rejected(target, run, f, before);
    if (!any && rejected == nullptr) return;
  }
  counters.shaded += covered;

  constexpr bool textured = M.texture != TexelFormat::none;
  const Positions positions(target, planes, run);
  std::array<double, run_length> z;
  if (paint.perspective) interpolate_z(planes, positions, z);
  if constexpr (textured) {
    interpolate_texture(paint, planes, positions, z, run.count, f);
    fetch_texels<M.texture>(paint, run.count, f);
    counters.texel_bytes += living() * bytes_per_texel<M.texture>(paint.filter);
  }
  interpolate_colour(paint, planes, positions, z, run.count, f);
  std::array<std::int32_t, run_length> fog;
  if (paint.fog != nullptr) fog_factors(*paint.fog, planes, positions, fog);
  shade<textured>(paint, run, fog, f);
  write<M>(target, paint, run, f, rejected, counters);
}

using Kernel = void (*)(const Target&, const Paint&, const Planes&, const Run&, Counters&);

constexpr auto kernels = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<Kernel, Mode::count>{&kernel<Mode::at(I)>...};
}
(std::make_index_sequence<Mode::count>{});

}  // namespace

void draw_run(const Target& target, const Paint& paint, const Planes& planes, const Run& run,
              Counters& counters) {
  kernels[paint.mode.index()](target, paint, planes, run, counters);
}

}  // namespace gpu::canvas
