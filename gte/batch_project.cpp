// RTPS and RTPT for arrays, in 32-bit lanes.
//
// The fast path needs the set-up, not the vertices, to be sane (see Setup::is_sane): then rows fit into 32
// bits, and so do the screen coordinates once two bits are shifted out. Anything else goes the plain way,
// vertex by vertex.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gte/batch_project.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "gte/batch_doors.h"
#include "gte/batch_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gte::HWY_NAMESPACE {
#if GTE_HAS_SIMD

/// The quotients q for which a linear depth cue p = DQB + q*DQA stays within 0..limit: an interval, as p is
/// monotone.
struct CueRange {
  std::int32_t first = 1, last = 0;
  CueRange(std::int64_t slope, std::int64_t offset, std::int64_t limit) {
    if (slope < 0) {  // mirrored: limit - p rises
      slope = -slope;
      offset = limit - offset;
    }
    if (slope == 0) {
      if (offset >= 0 && offset <= limit) last = 0x1ffff, first = 0;
      return;
    }
    const auto floor = [&](std::int64_t v) { return v >= 0 ? v / slope : -((-v + slope - 1) / slope); };
    const std::int64_t low = std::max<std::int64_t>(-floor(offset), 0);
    const std::int64_t high = std::min<std::int64_t>(floor(limit - offset), 0x1ffff);
    if (low <= high) first = static_cast<std::int32_t>(low), last = static_cast<std::int32_t>(high);
  }
};

/// Everything about RTPS that is the same for all vertices.
struct Setup {
  Row x, y, z;
  V ofx, ofy, dqa, dqb, h, lowest;
  V enough;  ///< the least SZ3 that H can be divided by: H / 2 + 1
  V cue_first, cue_last;

  Setup(const Registers& r, Command c)
      : x(r.rt[0], r.tr[0]),
        y(r.rt[1], r.tr[1]),
        z(r.rt[2], r.tr[2]),
        ofx(all(r.ofx.raw)),
        ofy(all(r.ofy.raw)),
        dqa(pair(r.dqa.raw, 0)),
        dqb(all(r.dqb.raw)),
        h(all(std::int32_t{r.h})),
        enough(all(r.h / 2 + 1)),
        lowest(all(c.lowest_ir())) {
    const CueRange cue(r.dqa.raw, r.dqb.raw, 0x1000fff);
    cue_first = all(cue.first);
    cue_last = all(cue.last);
  }

  /// OFX, OFY, DQB far enough from their limits that (OFX + (q & 3)*IR) / 4 + (q / 4)*IR fits into 32 bits,
  /// and a depth cue that overflows MAC0 for no quotient.
  static bool is_sane(const Registers& r) {
    const auto far_inside = [](std::int32_t v) { return std::abs(std::int64_t{v}) < 0x80000000 - 0x40000; };
    const std::int64_t last_cue = r.dqb.raw + std::int64_t{0x1ffff} * r.dqa.raw;
    return fits_32_bits(r.rt[0], r.tr[0]) && fits_32_bits(r.rt[1], r.tr[1]) &&
           fits_32_bits(r.rt[2], r.tr[2]) && far_inside(r.ofx.raw) && far_inside(r.ofy.raw) &&
           far_inside(r.dqb.raw) && last_cue == static_cast<std::int32_t>(last_cue);
  }
};

struct Division {
  V quotient;
  M overflow;
};

/// divide.h in 32-bit lanes. SZ3 becomes a float, whose mantissa is the normalised divisor; rounded to 8 bits
/// it is k + 100h, and the table is max(round(20000h / (k + 100h)), 101h), for which no quotient lies on a
/// half. The result of n*f, f = 10000h + rho, is n + (n*rho >> 16), and n*rho + 8000h stays below 2^32
/// because n*f < 2^32 + 2^16.
HWY_INLINE Division divide(V sz, V h, V enough) {
  const hn::RebindToFloat<D> df;
  const V bits = hn::BitCast(d, hn::ConvertTo(df, sz));
  const V one_to_two = hn::Or(hn::And(bits, all(0x7fffff)), all(0x3f800000));
  const V rounded = hn::And(hn::Add(one_to_two, all(0x4000)), all(~0x7fff));
  const V u = hn::Max(hn::NearestInt(hn::Div(hn::Set(df, 512.0f), hn::BitCast(df, rounded))), all(0x101));
  const V divisor = hn::And(hn::ShiftRight<8>(one_to_two), all(0xffff));
  const V e = hn::ShiftRight<8>(hn::Sub(all(0x2000080), hn::Mul(divisor, u)));
  const V rho = hn::Sub(hn::ShiftRight<8>(hn::Add(hn::Mul(e, u), all(0x80))), all(0x10000));
  const V zeros = hn::Sub(all(142), shift_down<23>(bits));  // 142: the exponent of 8000h
  const V n = hn::Shl(h, zeros);
  const V product = shift_down<16>(hn::Add(hn::Mul(n, rho), all(0x8000)));
  const V quotient = hn::Min(hn::Add(n, product), all(0x1ffff));
  const M overflow = hn::Gt(enough, sz);  // H >= 2*SZ3
  return {hn::IfThenElse(overflow, all(0x1ffff), quotient), overflow};
}

/// One vector of vertices, projected, not yet cut to the registers' widths.
struct Projected {
  V mac1, mac2, ir1, ir2, sum3, z, sz, q, x_4, y_4;  // x_4, y_4: (OF + q*IR) >> 2, so bits 14.. are the pixel
  M overflow;
};

/// (offset + q*ir) >> 2; q has 17 bits, one too many for a product in 32.
HWY_INLINE V offset_product(V q, V ir, V offset) {
  const V low = hn::ShiftRight<2>(multiply_pairs(hn::And(q, all(3)), ir, offset));
  return multiply_pairs(hn::ShiftRight<2>(q), ir, low);
}

template <bool sf>
HWY_INLINE Projected project_block(const Setup& s, const Vertices& v) {
  constexpr int shift = sf ? 12 : 0;
  Projected p;
  p.mac1 = hn::ShiftRight<shift>(s.x.times(v));
  p.mac2 = hn::ShiftRight<shift>(s.y.times(v));
  p.sum3 = s.z.times(v);
  p.ir1 = limit(p.mac1, s.lowest, all(0x7fff));
  p.ir2 = limit(p.mac2, s.lowest, all(0x7fff));
  p.z = hn::ShiftRight<12>(p.sum3);
  p.sz = limit(p.z, hn::Zero(d), all(0xffff));
  const Division division = divide(p.sz, s.h, s.enough);
  p.q = division.quotient;
  p.overflow = division.overflow;
  p.x_4 = offset_product(p.q, p.ir1, s.ofx);
  p.y_4 = offset_product(p.q, p.ir2, s.ofy);
  return p;
}

/// SX and SY, limited to -400h..3FFh: a saturating pack limits x >> 11 to 16 bits, 5 more than wanted.
HWY_INLINE V screen(const Projected& p) {
  const hn::Repartition<std::int16_t, D> d16;
  const hn::Repartition<std::uint8_t, D> d8;
  const auto xxyy = hn::ReorderDemote2To(d16, hn::ShiftRight<9>(p.x_4), hn::ShiftRight<9>(p.y_4));
  alignas(16) static constexpr std::uint8_t xyxy[16] = {0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15};
  return hn::BitCast(
      d, hn::TableLookupBytes(hn::BitCast(d8, hn::ShiftRight<5>(xxyy)), hn::LoadDup128(d8, xyxy)));
}

HWY_INLINE V ir0_flag(const Setup& s, V q) {
  return where(hn::Or(hn::Lt(q, s.cue_first), hn::Gt(q, s.cue_last)), flag::ir0_saturated);
}

/// True when nothing but IR0 can have been limited: IR1, IR2 within 16 bits, z within 0..7FFFh, the pixel
/// inside the screen limits, and so MAC0 far from its own.
HWY_INLINE bool is_clean(const Projected& p) {
  const V ir = hn::Or(hn::Xor(p.mac1, p.ir1), hn::Xor(p.mac2, p.ir2));
  const V z = hn::AndNot(all(0x7fff), p.z);
  const V pixel = hn::Or(hn::Add(p.x_4, all(1 << 24)), hn::Add(p.y_4, all(1 << 24)));
  const V outside = hn::Or(hn::Or(ir, z), hn::AndNot(all((1 << 25) - 1), pixel));
  return hn::AllFalse(d, hn::Or(p.overflow, hn::Ne(outside, hn::Zero(d))));
}

/// FLAG but for IR0 and bit 31.
HWY_INLINE V dirty_flags(const Projected& p) {
  const auto differ = [](V a, V b, std::uint32_t bits) { return where(hn::Ne(a, b), bits); };
  const auto outside = [](V v, std::int32_t low, std::int32_t high, std::uint32_t bits) {
    return where(hn::Or(hn::Lt(v, all(low)), hn::Gt(v, all(high))), bits);
  };
  V bits =
      hn::Or(differ(p.mac1, p.ir1, flag::ir1_saturated), differ(p.mac2, p.ir2, flag::ir1_saturated >> 1));
  bits = hn::Or(bits, outside(p.z, -0x8000, 0x7fff, flag::ir1_saturated >> 2));
  bits = hn::Or(bits, differ(p.z, p.sz, flag::sz3_or_otz_saturated));
  bits = hn::Or(bits, where(p.overflow, flag::divide_overflow));
  const V most = hn::Max(p.x_4, p.y_4), least = hn::Min(p.x_4, p.y_4);
  bits = hn::Or(bits, where(hn::Gt(most, all((1 << 29) - 1)), flag::mac0_positive));
  bits = hn::Or(bits, where(hn::Lt(least, all(-(1 << 29))), flag::mac0_negative));
  bits = hn::Or(bits, outside(p.x_4, -(1 << 24), (1 << 24) - 1, flag::sx2_saturated));
  return hn::Or(bits, outside(p.y_4, -(1 << 24), (1 << 24) - 1, flag::sy2_saturated));
}

HWY_INLINE V flags(const Setup& s, const Projected& p) {
  const V cue = ir0_flag(s, p.q);
  if (is_clean(p)) return cue;
  return with_error(hn::Or(cue, dirty_flags(p)));
}

template <class To>
HWY_INLINE void store_narrow(V v, To* to) {
  const hn::Rebind<To, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, v), narrow, to);
}

HWY_INLINE V ir0(const Setup& s, V q) {
  return limit(hn::ShiftRight<10>(offset_product(q, s.dqa, s.dqb)), hn::Zero(d), all(0x1000));
}

/// One vector of vertices from `in` to place `at` of the outputs. `extras`: any of the outputs few callers
/// want.
template <bool sf, bool want_flag, bool extras>
HWY_INLINE void project_to(const Setup& s, const Vertex* in, const ProjectOut& out, std::size_t at) {
  const Projected p = project_block<sf>(s, load_vertices(in));
  if (out.sxy != nullptr) store(screen(p), out.sxy + at);
  if (out.sz != nullptr) store_narrow(p.sz, out.sz + at);
  if constexpr (want_flag) store(flags(s, p), out.flag + at);
  if constexpr (extras) {
    if (out.ir0 != nullptr) store_narrow(ir0(s, p.q), out.ir0 + at);
    if (out.z_20_12 != nullptr) store(hn::Max(p.sum3, hn::Zero(d)), out.z_20_12 + at);
    const auto fraction = [](V v) { return hn::And(hn::ShiftRight<6>(v), all(0xff)); };
    if (out.fraction_x != nullptr) store_narrow(fraction(p.x_4), out.fraction_x + at);
    if (out.fraction_y != nullptr) store_narrow(fraction(p.y_4), out.fraction_y + at);
  }
}

/// The last, short vector goes through memory of its own.
template <bool sf, bool want_flag, bool extras>
HWY_NOINLINE void project_tail(const Setup& s, std::span<const Vertex> in, const ProjectOut& out,
                               std::size_t at) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  Vertex v[lanes] = {};
  ScreenXy sxy[lanes];
  std::uint16_t sz[lanes];
  std::uint32_t flag[lanes], z[lanes];
  std::int16_t ir0[lanes];
  std::uint8_t fx[lanes], fy[lanes];
  const std::size_t count = in.size() - at;
  std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(at), count, v);
  project_to<sf, want_flag, extras>(s, v, {sxy, sz, flag, ir0, z, fx, fy}, 0);
  const auto copy = [&](auto* to, const auto* from) {
    if (to != nullptr) std::copy_n(from, count, to + at);
  };
  copy(out.sxy, sxy);
  copy(out.sz, sz);
  if (want_flag) copy(out.flag, flag);
  if (!extras) return;
  copy(out.ir0, ir0);
  copy(out.z_20_12, z);
  copy(out.fraction_x, fx);
  copy(out.fraction_y, fy);
}

template <bool sf, bool want_flag, bool extras>
void project_all(const Setup& s, std::span<const Vertex> in, const ProjectOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t at = 0;
  for (; at + lanes <= in.size(); at += lanes) project_to<sf, want_flag, extras>(s, in.data() + at, out, at);
  if (at < in.size()) project_tail<sf, want_flag, extras>(s, in, out, at);
}

void project(const Registers& r, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  if (!Setup::is_sane(r)) return plain_project_doors.project(r, in, out, c);
  const Setup s(r, c);
  const bool extras =
      out.ir0 != nullptr || out.z_20_12 != nullptr || out.fraction_x != nullptr || out.fraction_y != nullptr;
  using Run = void (*)(const Setup&, std::span<const Vertex>, const ProjectOut&);
  static constexpr Run runs[2][2][2] = {{{project_all<false, false, false>, project_all<false, false, true>},
                                         {project_all<false, true, false>, project_all<false, true, true>}},
                                        {{project_all<true, false, false>, project_all<true, false, true>},
                                         {project_all<true, true, false>, project_all<true, true, true>}}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0][extras ? 1 : 0](s, in, out);
}

/// NCLIP from packed screen positions of RTPT: (b - a) x (c - a); differences have 12 bits, so 16-bit ones
/// do.
HWY_INLINE V signed_area(V a, V b, V c) {
  const hn::Repartition<std::int16_t, D> d16;
  const auto minus = [&](V v, V w) { return hn::Sub(hn::BitCast(d16, v), hn::BitCast(d16, w)); };
  const auto swap = [](V v) { return hn::BitCast(d, hn::RotateRight<16>(hn::BitCast(du, v))); };
  const V high = all(0xffff0000u);
  const V to_c = hn::Xor(hn::BitCast(d, minus(swap(c), swap(a))), high);  // (y, ~x); ~x + 1 = -x
  return multiply_pairs(hn::BitCast(d, minus(b, a)), hn::BitCast(d, minus(to_c, high)), hn::Zero(d));
}

/// One vector of triangles, three of vertices: projected in order, then taken apart by corner.
template <bool sf, bool want_flag>
HWY_INLINE void triangles_to(const Setup& s, V zsf3, const Vertex* in, const TriangleOut& out,
                             std::size_t at) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  alignas(64) std::int32_t own_sxy[3 * lanes], sz[3 * lanes], bits[3 * lanes], q[3 * lanes];
  std::int32_t* sxy = own_sxy;
  for (std::size_t k = 0; k < 3; ++k) {
    const Projected p = project_block<sf>(s, load_vertices(in + k * lanes));
    store(screen(p), sxy + k * lanes);
    store(p.sz, sz + k * lanes);
    if (out.sxy != nullptr) store(load(sxy + k * lanes), out.sxy + 3 * at + k * lanes);
    if (out.sz != nullptr) store_narrow(p.sz, out.sz + 3 * at + k * lanes);
    if (out.ir0 != nullptr) store(p.q, q + k * lanes);
    if constexpr (want_flag) store(flags(s, p), bits + k * lanes);
  }
  V a, b, c;
  if (out.mac0 != nullptr) {
    hn::LoadInterleaved3(d, sxy, a, b, c);
    store(signed_area(a, b, c), out.mac0 + at);
  }
  if (out.otz != nullptr || out.avsz3_flag != nullptr) {
    hn::LoadInterleaved3(d, sz, a, b, c);
    const V average = hn::ShiftRight<12>(hn::Mul(zsf3, hn::Add(hn::Add(a, b), c)));
    const V otz = limit(average, hn::Zero(d), all(0xffff));
    if (out.otz != nullptr) store_narrow(otz, out.otz + at);
    if (out.avsz3_flag != nullptr) {
      store(where(hn::Ne(otz, average), flag::error | flag::sz3_or_otz_saturated), out.avsz3_flag + at);
    }
  }
  if constexpr (want_flag) {  // only the last vertex has a depth cue
    hn::LoadInterleaved3(d, bits, a, b, c);
    store(hn::Or(hn::AndNot(all(flag::ir0_saturated), hn::Or(a, b)), c), out.flag + at);
  }
  if (out.ir0 != nullptr) {
    hn::LoadInterleaved3(d, q, a, b, c);
    store_narrow(ir0(s, c), out.ir0 + at);
  }
}

template <bool sf, bool want_flag>
HWY_NOINLINE void triangles_tail(const Setup& s, V zsf3, std::span<const Vertex> in, const TriangleOut& out,
                                 std::size_t at) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  Vertex v[3 * lanes] = {};
  ScreenXy sxy[3 * lanes];
  std::uint16_t sz[3 * lanes], otz[lanes];
  std::uint32_t flag[lanes], avsz3_flag[lanes];
  std::int16_t ir0[lanes];
  std::int32_t mac0[lanes];
  const std::size_t count = in.size() / 3 - at;
  std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(3 * at), 3 * count, v);
  triangles_to<sf, want_flag>(s, zsf3, v, {sxy, sz, flag, ir0, mac0, otz, avsz3_flag}, 0);
  const auto copy = [&](auto* to, const auto* from, std::size_t each) {
    if (to != nullptr) std::copy_n(from, each * count, to + each * at);
  };
  copy(out.sxy, sxy, 3);
  copy(out.sz, sz, 3);
  if (want_flag) copy(out.flag, flag, 1);
  copy(out.ir0, ir0, 1);
  copy(out.mac0, mac0, 1);
  copy(out.otz, otz, 1);
  copy(out.avsz3_flag, avsz3_flag, 1);
}

template <bool sf, bool want_flag>
void triangles_all(const Registers& r, const Setup& s, std::span<const Vertex> in, const TriangleOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t count = in.size() / 3;
  const V zsf3 = all(std::int32_t{r.zsf3.raw});
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes) triangles_to<sf, want_flag>(s, zsf3, in.data() + 3 * at, out, at);
  if (at < count) triangles_tail<sf, want_flag>(s, zsf3, in, out, at);
}

void project_triangles(const Registers& r, std::span<const Vertex> in, const TriangleOut& out, Command c) {
  constexpr int steepest_average = 10922;  // 3 * FFFFh * 10922 < 2^31
  if (!Setup::is_sane(r) || std::abs(r.zsf3.raw) > steepest_average) {
    return plain_project_doors.project_triangles(r, in, out, c);
  }
  const Setup s(r, c);
  using Run = void (*)(const Registers&, const Setup&, std::span<const Vertex>, const TriangleOut&);
  static constexpr Run runs[2][2] = {{triangles_all<false, false>, triangles_all<false, true>},
                                     {triangles_all<true, false>, triangles_all<true, true>}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0](r, s, in, out);
}

const ProjectDoors* project_doors() {
  static constexpr ProjectDoors doors{project, project_triangles};
  return &doors;
}

#else
const ProjectDoors* project_doors() { return nullptr; }
#endif
}  // namespace gte::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gte {
HWY_EXPORT(project_doors);
const ProjectDoors* chosen_project_doors() { return HWY_DYNAMIC_DISPATCH(project_doors)(); }
}  // namespace gte
#endif
