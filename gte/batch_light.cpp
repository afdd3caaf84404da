// Light, depth cue and matrix products for arrays, in 32-bit lanes.
//
// The fast path needs the set-up to be sane: rows whose sums fit into 32 bits whatever the vector
// (fits_32_bits), and a far colour whose distance from any colour does. Anything else goes the plain way,
// element by element.

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gte/batch_light.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "gte/batch_doors.h"
#include "gte/batch_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gte::HWY_NAMESPACE {
#if GTE_HAS_SIMD

/// X, Y, Z or R, G, B, one vector each.
struct Vector {
  V of[3];
};

/// Which limits were met: a lane is not zero where IRi, or colour i, lost bits in some step of the command.
template <bool wanted>
struct Lost {
  V ir[3], colour[3];

  // Spelt out: a constructor the compiler makes is not compiled for the instruction set of its surroundings.
  HWY_INLINE Lost() {
    for (std::size_t i = 0; i < 3; ++i) ir[i] = colour[i] = hn::Zero(d);
  }

  HWY_INLINE V limit_ir(std::size_t i, V mac, V lowest) {
    const V kept = limit(mac, lowest, all(0x7fff));
    if constexpr (wanted) ir[i] = hn::Or(ir[i], hn::Xor(mac, kept));
    return kept;
  }
  HWY_INLINE V limit_colour(std::size_t i, V value) {
    const V kept = limit(value, hn::Zero(d), all(0xff));
    if constexpr (wanted) colour[i] = hn::Or(colour[i], hn::Xor(value, kept));
    return kept;
  }
  [[nodiscard]] HWY_INLINE V flags() const {
    const V irs = hn::Or(hn::Or(ir[0], ir[1]), ir[2]),
            colours = hn::Or(hn::Or(colour[0], colour[1]), colour[2]);
    const V zero = hn::Zero(d);
    if (hn::AllTrue(d, hn::Eq(hn::Or(irs, colours), zero))) return zero;
    const auto unless_zero = [&](V lost, std::uint32_t bit) {
      return hn::AndNot(hn::VecFromMask(d, hn::Eq(lost, zero)), all(flag::with_error(bit)));
    };
    V bits = zero;
    for (std::size_t i = 0; i < 3; ++i) {
      bits = hn::Or(bits, unless_zero(ir[i], flag::ir1_saturated >> i));
      bits = hn::Or(bits, unless_zero(colour[i], flag::red_saturated >> i));
    }
    return bits;
  }
};

struct Rows {
  Row row[3];
  Rows(const Matrix& m, std::array<std::int32_t, 3> t) : row{{m[0], t[0]}, {m[1], t[1]}, {m[2], t[2]}} {}
};

bool rows_fit(const Matrix& m, std::array<std::int32_t, 3> t) {
  return fits_32_bits(m[0], t[0]) && fits_32_bits(m[1], t[1]) && fits_32_bits(m[2], t[2]);
}

template <class Format>
std::array<std::int32_t, 3> raw(const std::array<Format, 3>& of) {
  return {of[0].raw, of[1].raw, of[2].raw};
}

/// (FC << 12) - in, where in < 2^27, fits into 32 bits.
bool far_colour_fits(const Registers& r) {
  return std::all_of(r.fc.begin(), r.fc.end(),
                     [](S27_4 c) { return std::abs(std::int64_t{c.raw}) < 0x70000; });
}

struct LightSetup {
  Rows llm, lcm;
  V far[3];
  V lowest, code, rgbc, ir0;

  LightSetup(const Registers& r, Command c)
      : llm(r.llm, {}),
        lcm(r.lcm, raw(r.bk)),
        lowest(all(c.lowest_ir())),
        code(all(std::uint32_t{r.rgbc.code} << 24)),
        rgbc(all(detail::word(r.rgbc))),
        ir0(all(std::int32_t{r.ir[0]} & 0xffff)) {
    for (std::size_t i = 0; i < 3; ++i) far[i] = all(static_cast<std::uint32_t>(r.fc[i].raw) << 12);
  }
};

template <bool sf>
HWY_INLINE V shifted(V sum) {
  return hn::ShiftRight < sf ? 12 : 0 > (sum);
}

template <bool sf, class Limits>
HWY_INLINE Vector transform(const Rows& m, const Vertices& x, V lowest, Limits& lost) {
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) out.of[i] = lost.limit_ir(i, shifted<sf>(m.row[i].times(x)), lowest);
  return out;
}

/// IR1..3 as the vector of the next product.
HWY_INLINE Vertices as_vertices(const Vector& ir) {
  return {hn::Or(hn::And(ir.of[0], all(0xffff)), hn::ShiftLeft<16>(ir.of[1])), ir.of[2]};
}

HWY_INLINE Vector channels(V rgbc) {
  return {{hn::And(rgbc, all(0xff)), hn::And(hn::ShiftRight<8>(rgbc), all(0xff)),
           hn::And(hn::ShiftRight<16>(rgbc), all(0xff))}};
}

/// (RGBCi * IRi) << 4
HWY_INLINE Vector modulated(V rgbc, const Vector& ir) {
  const Vector colour = channels(rgbc);
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.of[i] = hn::ShiftLeft<4>(multiply_pairs(colour.of[i], ir.of[i], hn::Zero(d)));
  }
  return out;
}

/// RGBCi << 16
HWY_INLINE Vector widened(V rgbc) {
  return {{hn::And(hn::ShiftLeft<16>(rgbc), all(0xff0000)), hn::And(hn::ShiftLeft<8>(rgbc), all(0xff0000)),
           hn::And(rgbc, all(0xff0000))}};
}

/// Toward the far colour by IR0, whose upper half is zero here so that multiply_pairs sees one product.
template <bool sf, class Limits>
HWY_INLINE Vector cued(const LightSetup& s, const Vector& in, V ir0, Limits& lost) {
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) {
    const V ir = lost.limit_ir(i, shifted<sf>(hn::Sub(s.far[i], in.of[i])), all(-0x8000));
    out.of[i] = multiply_pairs(ir0, ir, in.of[i]);
  }
  return out;
}

/// MACi and IRi of the last sum, and the colour pushed.
template <bool sf, class Limits>
HWY_INLINE V pushed(const LightSetup& s, const Vector& sum, V code, Limits& lost) {
  V colour[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const V mac = shifted<sf>(sum.of[i]);
    lost.limit_ir(i, mac, s.lowest);
    colour[i] = lost.limit_colour(i, hn::ShiftRight<4>(mac));
  }
  return hn::Or(hn::Or(colour[0], hn::ShiftLeft<8>(colour[1])), hn::Or(hn::ShiftLeft<16>(colour[2]), code));
}

HWY_INLINE V code_of(V rgbc) { return hn::And(rgbc, all(0xff000000u)); }

/// NCS pushes what the colour matrix has already shifted and limited: MAC, not a sum.
template <class Limits>
HWY_INLINE V pushed_mac(const Vector& mac, V code, Limits& lost) {
  V colour[3];
  for (std::size_t i = 0; i < 3; ++i) colour[i] = lost.limit_colour(i, hn::ShiftRight<4>(mac.of[i]));
  return hn::Or(hn::Or(colour[0], hn::ShiftLeft<8>(colour[1])), hn::Or(hn::ShiftLeft<16>(colour[2]), code));
}

template <Light kind, bool sf, class Limits>
HWY_INLINE V lit(const LightSetup& s, const Vertices& normal, V rgbc, V ir0, Limits& lost) {
  const Vector direction = transform<sf>(s.llm, normal, s.lowest, lost);
  const Vertices x = as_vertices(direction);
  if constexpr (kind == Light::ncs) {
    Vector mac;
    for (std::size_t i = 0; i < 3; ++i) {
      mac.of[i] = shifted<sf>(s.lcm.row[i].times(x));
      lost.limit_ir(i, mac.of[i], s.lowest);
    }
    return pushed_mac(mac, code_of(rgbc), lost);
  }
  const Vector in = modulated(rgbc, transform<sf>(s.lcm, x, s.lowest, lost));
  if constexpr (kind == Light::nccs) return pushed<sf>(s, in, code_of(rgbc), lost);
  return pushed<sf>(s, cued<sf>(s, in, ir0, lost), code_of(rgbc), lost);
}

/// 16 bits to lanes, the upper half zero.
HWY_INLINE V load_ir0(const std::int16_t* from) {
  const hn::Rebind<std::uint16_t, D> narrow;
  return hn::PromoteTo(d, hn::LoadU(narrow, reinterpret_cast<const std::uint16_t*>(from)));
}

constexpr std::size_t max_lanes = hn::MaxLanes(d);

/// `count` entries of an array, 0 for those up to a whole vector: how the last, short vector is read.
template <class T, std::size_t n = max_lanes>
struct Padded {
  T entries[n] = {};
  Padded(std::span<const T> from, std::size_t at, std::size_t count) {
    if (!from.empty()) std::copy_n(from.data() + at, count, entries);
  }
};

template <class T>
void copy_wanted(T* to, const T* from, std::size_t count) {
  if (to != nullptr) std::copy_n(from, count, to);
}

struct Lights {
  std::span<const Vertex> normals;
  std::span<const Colour> rgbc;
  std::span<const std::int16_t> ir0;
};

template <Light kind, bool sf, bool want_flag>
HWY_INLINE void light_to(const LightSetup& s, const Vertex* normals, const Colour* rgbc,
                         const std::int16_t* ir0, const ColourOut& out, std::size_t at) {
  Lost<want_flag> lost;
  const V colour = lit<kind, sf>(s, load_vertices(normals), rgbc != nullptr ? load(rgbc) : s.rgbc,
                                 ir0 != nullptr ? load_ir0(ir0) : s.ir0, lost);
  if (out.rgb != nullptr) store(colour, out.rgb + at);
  if constexpr (want_flag) store(lost.flags(), out.flag + at);
}

template <Light kind, bool sf, bool want_flag>
void light_all(const LightSetup& s, const Lights& in, const ColourOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  const auto from = [](const auto& span, std::size_t at) {
    return span.empty() ? nullptr : span.data() + at;
  };
  std::size_t at = 0;
  for (; at + lanes <= in.normals.size(); at += lanes) {
    light_to<kind, sf, want_flag>(s, in.normals.data() + at, from(in.rgbc, at), from(in.ir0, at), out, at);
  }
  const std::size_t count = in.normals.size() - at;
  if (count == 0) return;
  const Padded normals(in.normals, at, count);
  const Padded rgbc(in.rgbc, at, count);
  const Padded ir0(in.ir0, at, count);
  Colour rgb[max_lanes];
  std::uint32_t flag[max_lanes];
  light_to<kind, sf, want_flag>(s, normals.entries, in.rgbc.empty() ? nullptr : rgbc.entries,
                                in.ir0.empty() ? nullptr : ir0.entries, {rgb, flag}, 0);
  copy_wanted(advance(out.rgb, at), rgb, count);
  if (want_flag) copy_wanted(out.flag + at, flag, count);
}

template <bool sf, bool want_flag>
void light_kind(const LightSetup& s, Light kind, const Lights& in, const ColourOut& out) {
  switch (kind) {
    case Light::ncs:
      return light_all<Light::ncs, sf, want_flag>(s, in, out);
    case Light::nccs:
      return light_all<Light::nccs, sf, want_flag>(s, in, out);
    case Light::ncds:
      return light_all<Light::ncds, sf, want_flag>(s, in, out);
  }
}

void light(const Registers& r, Light kind, std::span<const Vertex> normals, std::span<const Colour> rgbc,
           std::span<const std::int16_t> ir0, const ColourOut& out, Command c) {
  const bool sane =
      rows_fit(r.llm, {}) && rows_fit(r.lcm, raw(r.bk)) && (kind != Light::ncds || far_colour_fits(r));
  if (!sane) return plain_light_doors.light(r, kind, normals, rgbc, ir0, out, c);
  const LightSetup s(r, c);
  using Run = void (*)(const LightSetup&, Light, const Lights&, const ColourOut&);
  static constexpr Run runs[2][2] = {{light_kind<false, false>, light_kind<false, true>},
                                     {light_kind<true, false>, light_kind<true, true>}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0](s, kind, {normals, rgbc, ir0}, out);
}

template <bool sf, bool want_flag>
HWY_INLINE void cue_to(const LightSetup& s, const Colour* rgbc, const std::int16_t* ir0, const ColourOut& out,
                       std::size_t at) {
  Lost<want_flag> lost;
  const V in = load(rgbc);
  const Vector sum = cued<sf>(s, widened(in), ir0 != nullptr ? load_ir0(ir0) : s.ir0, lost);
  const V colour = pushed<sf>(s, sum, code_of(in), lost);
  if (out.rgb != nullptr) store(colour, out.rgb + at);
  if constexpr (want_flag) store(lost.flags(), out.flag + at);
}

template <bool sf, bool want_flag>
void cue_all(const LightSetup& s, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
             const ColourOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t at = 0;
  for (; at + lanes <= rgbc.size(); at += lanes) {
    cue_to<sf, want_flag>(s, rgbc.data() + at, ir0.empty() ? nullptr : ir0.data() + at, out, at);
  }
  const std::size_t count = rgbc.size() - at;
  if (count == 0) return;
  const Padded colours(rgbc, at, count);
  const Padded slopes(ir0, at, count);
  Colour rgb[max_lanes];
  std::uint32_t flag[max_lanes];
  cue_to<sf, want_flag>(s, colours.entries, ir0.empty() ? nullptr : slopes.entries, {rgb, flag}, 0);
  copy_wanted(advance(out.rgb, at), rgb, count);
  if (want_flag) copy_wanted(out.flag + at, flag, count);
}

using CueRun = void (*)(const LightSetup&, std::span<const Colour>, std::span<const std::int16_t>,
                        const ColourOut&);

void cue(const Registers& r, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c) {
  if (!far_colour_fits(r)) return plain_light_doors.cue(r, rgbc, ir0, out, c);
  static constexpr CueRun runs[2][2] = {{cue_all<false, false>, cue_all<false, true>},
                                        {cue_all<true, false>, cue_all<true, true>}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0](LightSetup(r, c), rgbc, ir0, out);
}

/// One vector of triples, three of colours; the FLAG of a triple gathers all three.
template <bool sf, bool want_flag>
HWY_INLINE void triples_to(const LightSetup& s, const Colour* rgb, const std::int16_t* ir0,
                           const ColourOut& out, std::size_t at) {
  Lost<want_flag> lost;
  const V slope = ir0 != nullptr ? load_ir0(ir0) : s.ir0;
  V in[3], colour[3];
  hn::LoadInterleaved3(d, reinterpret_cast<const std::int32_t*>(rgb), in[0], in[1], in[2]);
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = pushed<sf>(s, cued<sf>(s, widened(in[k]), slope, lost), s.code, lost);
  if (out.rgb != nullptr) {
    hn::StoreInterleaved3(colour[0], colour[1], colour[2], d,
                          reinterpret_cast<std::int32_t*>(out.rgb + 3 * at));
  }
  if constexpr (want_flag) store(lost.flags(), out.flag + at);
}

template <bool sf, bool want_flag>
void triples_all(const LightSetup& s, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out) {
  const std::size_t lanes = hn::Lanes(d), total = rgb.size() / 3;
  std::size_t at = 0;
  for (; at + lanes <= total; at += lanes) {
    triples_to<sf, want_flag>(s, rgb.data() + 3 * at, ir0.empty() ? nullptr : ir0.data() + at, out, at);
  }
  const std::size_t count = total - at;
  if (count == 0) return;
  const Padded<Colour, 3 * max_lanes> colours(rgb, 3 * at, 3 * count);
  const Padded slopes(ir0, at, count);
  Colour pushed_rgb[3 * max_lanes];
  std::uint32_t flag[max_lanes];
  triples_to<sf, want_flag>(s, colours.entries, ir0.empty() ? nullptr : slopes.entries, {pushed_rgb, flag},
                            0);
  copy_wanted(advance(out.rgb, 3 * at), pushed_rgb, 3 * count);
  if (want_flag) copy_wanted(out.flag + at, flag, count);
}

void cue_triples(const Registers& r, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c) {
  if (!far_colour_fits(r)) return plain_light_doors.cue_triples(r, rgb, ir0, out, c);
  static constexpr CueRun runs[2][2] = {{triples_all<false, false>, triples_all<false, true>},
                                        {triples_all<true, false>, triples_all<true, true>}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0](LightSetup(r, c), rgb, ir0, out);
}

/// MVMVA: the rows that make the result, and those whose result the far colour's fault
/// throws away but for its flags.
struct Product {
  Rows kept, thrown;
  V lowest;
};

template <bool sf, bool far_colour>
HWY_INLINE void multiply_to(const Product& m, const Vertex* in, const VectorOut& out, std::size_t at) {
  const hn::Rebind<std::int16_t, D> narrow;
  Lost<true> lost;
  const Vertices x = load_vertices(in);
  for (std::size_t i = 0; i < 3; ++i) {
    if constexpr (far_colour) lost.limit_ir(i, shifted<sf>(m.thrown.row[i].times(x)), all(-0x8000));
    const V mac = shifted<sf>(m.kept.row[i].times(x));
    const V ir = lost.limit_ir(i, mac, m.lowest);
    if (out.mac[i] != nullptr) store(mac, out.mac[i] + at);
    if (out.ir[i] != nullptr) hn::StoreU(hn::DemoteTo(narrow, ir), narrow, out.ir[i] + at);
  }
  if (out.flag != nullptr) store(lost.flags(), out.flag + at);
}

template <bool sf, bool far_colour>
void multiply_all(const Product& m, std::span<const Vertex> in, const VectorOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t at = 0;
  for (; at + lanes <= in.size(); at += lanes) multiply_to<sf, far_colour>(m, in.data() + at, out, at);
  const std::size_t count = in.size() - at;
  if (count == 0) return;
  const Padded vectors(in, at, count);
  std::int32_t mac[3][max_lanes];
  std::int16_t ir[3][max_lanes];
  std::uint32_t flag[max_lanes];
  multiply_to<sf, far_colour>(m, vectors.entries, {{mac[0], mac[1], mac[2]}, {ir[0], ir[1], ir[2]}, flag}, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    copy_wanted(advance(out.mac[i], at), mac[i], count);
    copy_wanted(advance(out.ir[i], at), ir[i], count);
  }
  copy_wanted(advance(out.flag, at), flag, count);
}

void multiply(const Registers& r, Command c, std::span<const Vertex> in, const VectorOut& out) {
  const Matrix m = mvmva_matrix(r, c);
  const std::array<std::int32_t, 3> t = mvmva_translation(r, c);
  if (!rows_fit(m, t)) return plain_light_doors.multiply(r, c, in, out);
  using Run = void (*)(const Product&, std::span<const Vertex>, const VectorOut&);
  static constexpr Run runs[2][2] = {{multiply_all<false, false>, multiply_all<false, true>},
                                     {multiply_all<true, false>, multiply_all<true, true>}};
  const bool far_colour = c.cv() == 2;
  Matrix kept = m, thrown{};
  for (std::size_t i = 0; far_colour && i < 3; ++i) std::swap(kept[i][0], thrown[i][0]);
  const Rows lost(thrown, far_colour ? t : std::array<std::int32_t, 3>{});
  const Rows rows(kept, far_colour ? std::array<std::int32_t, 3>{} : t);
  runs[c.sf() ? 1 : 0][far_colour ? 1 : 0]({rows, lost, all(c.lowest_ir())}, in, out);
}

const LightDoors* light_doors() {
  static constexpr LightDoors doors{light, cue, cue_triples, multiply};
  return &doors;
}

#else
const LightDoors* light_doors() { return nullptr; }
#endif
}  // namespace gte::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gte {
const LightDoors* light_doors([[maybe_unused]] std::int64_t target) {
#if HWY_TARGETS & HWY_AVX3
  if (target == HWY_AVX3) return N_AVX3::light_doors();
#endif
#if HWY_TARGETS & HWY_AVX2
  if (target == HWY_AVX2) return N_AVX2::light_doors();
#endif
#if HWY_TARGETS & HWY_SSE4
  if (target == HWY_SSE4) return N_SSE4::light_doors();
#endif
  return nullptr;
}
}  // namespace gte
#endif
