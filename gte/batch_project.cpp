// RTPS and RTPT for arrays, in 32-bit lanes. Where a row of the set-up could overflow 32 bits (fits_32_bits),
// its sums are made in 64-bit lanes, 44 bits wide as the hardware's, and the rest stays the same. The fast
// path needs the set-up, not the vertices, to be sane (see ProjectSetup::is_sane): then rows fit into 32
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

/// The quotients q for which a linear depth cue p = DQB + q*DQA stays within 0..limit:
/// an interval, as p is monotone.
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
struct ProjectSetup {
  Row x, y, z;
  V ofx, ofy, dqa, dqb, h, lowest;
  V enough;  ///< the least SZ3 that H can be divided by: H / 2 + 1
  V cue_first, cue_last;
  V wide[3][3];  ///< the matrix for the wide way: x and z in the low half of a pair, y in the high one
  std::array<std::int32_t, 3> translation;

  ProjectSetup(const Registers& r, Command c)
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
    for (std::size_t i = 0; i < 3; ++i) {
      wide[i][0] = pair(r.rt[i][0].raw, 0);
      wide[i][1] = pair(0, r.rt[i][1].raw);
      wide[i][2] = pair(r.rt[i][2].raw, 0);
    }
    translation = r.tr;
  }

  static bool rows_are_narrow(const Registers& r) {
    return fits_32_bits(r.rt[0], r.tr[0]) && fits_32_bits(r.rt[1], r.tr[1]) && fits_32_bits(r.rt[2], r.tr[2]);
  }

  /// OFX, OFY, DQB far enough from their limits that (OFX + (q & 3)*IR) / 4 + (q / 4)*IR fits
  /// into 32 bits, and a depth cue that overflows MAC0 for no quotient. No scene is otherwise;
  /// one that is goes vertex by vertex.
  static bool offsets_are_sane(const Registers& r) {
    const auto far_inside = [](std::int32_t v) { return std::abs(std::int64_t{v}) < 0x80000000 - 0x40000; };
    const std::int64_t last_cue = r.dqb.raw + std::int64_t{0x1ffff} * r.dqa.raw;
    return far_inside(r.ofx.raw) && far_inside(r.ofy.raw) && far_inside(r.dqb.raw) &&
           last_cue == static_cast<std::int32_t>(last_cue);
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

/// A vertex in eye space: MAC1, MAC2, the sum of row 3 both as z = sum >> 12 and as z_20_12 shows it.
struct Eye {
  V mac1, mac2, z, z_20_12;
  V wrapped;  ///< FLAG bits of sums beyond 44 bits; zero on the narrow way
};

/// The narrow way: every row fits into 32 bits.
template <bool sf>
HWY_INLINE Eye to_eye_narrow(const ProjectSetup& s, const Vertices& v) {
  constexpr int shift = sf ? 12 : 0;
  const V sum3 = s.z.times(v);
  return {hn::ShiftRight<shift>(s.x.times(v)), hn::ShiftRight<shift>(s.y.times(v)), hn::ShiftRight<12>(sum3),
          hn::Max(sum3, hn::Zero(d)), hn::Zero(d)};
}

/// The wide way: 44-bit sums in 64-bit lanes, shifted left by 20, so that they wrap, and overflow, where the
/// hardware's do. Half a vector at a time; `upper` and `lower` are the 32-bit halves of the sums.
using D64 = hn::Repartition<std::int64_t, D>;
using V64 = hn::Vec<D64>;
constexpr D64 d64;

struct WideSum {
  V64 sum, positive, negative;  // sign bits of the latter two: ever overflowed that way

  HWY_INLINE void add(V64 term) {
    const V64 next = hn::Add(sum, term);
    const V64 overflowed = hn::AndNot(hn::Xor(sum, term), hn::Xor(next, sum));
    positive = hn::Or(positive, hn::AndNot(sum, overflowed));
    negative = hn::Or(negative, hn::And(sum, overflowed));
    sum = next;
  }
};

struct WideRow {
  V upper, lower, wrapped;
};

HWY_INLINE WideRow wide_row(const V (&m)[3], std::int32_t t, const Vertices& v, std::uint32_t positive_bit) {
  const V64 zero = hn::Zero(d64);
  const V64 offset = hn::Set(d64, static_cast<std::int64_t>(static_cast<std::uint64_t>(t) << 32));
  WideSum low{offset, zero, zero}, high{offset, zero, zero};
  const V products[3] = {multiply_pairs(m[0], v.xy, hn::Zero(d)), multiply_pairs(m[1], v.xy, hn::Zero(d)),
                         multiply_pairs(m[2], v.z, hn::Zero(d))};
  for (const V product : products) {
    low.add(hn::ShiftLeft<20>(hn::PromoteTo(d64, hn::LowerHalf(product))));
    high.add(hn::ShiftLeft<20>(hn::PromoteTo(d64, hn::UpperHalf(hn::Half<D>(), product))));
  }
  const auto odd = [](V64 h, V64 l) { return hn::ConcatOdd(d, hn::BitCast(d, h), hn::BitCast(d, l)); };
  const auto negative = [](V x, std::uint32_t bits) { return hn::And(hn::ShiftRight<31>(x), all(bits)); };
  return {odd(high.sum, low.sum), hn::ConcatEven(d, hn::BitCast(d, high.sum), hn::BitCast(d, low.sum)),
          hn::Or(negative(odd(high.positive, low.positive), positive_bit),
                 negative(odd(high.negative, low.negative), positive_bit >> 3))};
}

/// MAC: the upper 32 bits of a shifted sum are its bits 12.. , bits 0.. lie 20 above the bottom.
template <bool sf>
HWY_INLINE V wide_mac(const WideRow& row) {
  if constexpr (sf) return row.upper;
  return hn::Or(hn::ShiftLeft<12>(row.upper), shift_down<20>(row.lower));
}

template <bool sf>
HWY_INLINE Eye to_eye_wide(const ProjectSetup& s, const Vertices& v) {
  const WideRow x = wide_row(s.wide[0], s.translation[0], v, flag::mac1_positive);
  const WideRow y = wide_row(s.wide[1], s.translation[1], v, flag::mac1_positive >> 1);
  const WideRow z = wide_row(s.wide[2], s.translation[2], v, flag::mac1_positive >> 2);
  const V limited = hn::IfThenElse(hn::Gt(z.upper, all(0xfffff)), all(-1), wide_mac<false>(z));
  return {wide_mac<sf>(x), wide_mac<sf>(y), z.upper,
          hn::IfThenZeroElse(hn::Lt(z.upper, hn::Zero(d)), limited),
          hn::Or(hn::Or(x.wrapped, y.wrapped), z.wrapped)};
}

/// One vector of vertices, projected, not yet cut to the registers' widths.
struct Projected {
  Eye eye;
  V ir1, ir2, sz, q, x_4, y_4;  // x_4, y_4: (OF + q*IR) >> 2, so bits 14.. are the pixel
  M overflow;
};

/// (offset + q*ir) >> 2; q has 17 bits, one too many for a product in 32.
HWY_INLINE V offset_product(V q, V ir, V offset) {
  const V low = hn::ShiftRight<2>(multiply_pairs(hn::And(q, all(3)), ir, offset));
  return multiply_pairs(hn::ShiftRight<2>(q), ir, low);
}

enum class Sums : std::uint8_t { narrow, wide };

template <bool sf, Sums sums>
HWY_INLINE Projected project_block(const ProjectSetup& s, const Vertices& v) {
  Projected p;
  if constexpr (sums == Sums::narrow) p.eye = to_eye_narrow<sf>(s, v);
  if constexpr (sums == Sums::wide) p.eye = to_eye_wide<sf>(s, v);
  p.ir1 = limit(p.eye.mac1, s.lowest, all(0x7fff));
  p.ir2 = limit(p.eye.mac2, s.lowest, all(0x7fff));
  p.sz = limit(p.eye.z, hn::Zero(d), all(0xffff));
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

HWY_INLINE V ir0_flag(const ProjectSetup& s, V q) {
  return where(hn::Or(hn::Lt(q, s.cue_first), hn::Gt(q, s.cue_last)), flag::ir0_saturated);
}

/// True when nothing but IR0 can have been limited: IR1, IR2 within 16 bits, z within 0..7FFFh, the pixel
/// inside the screen limits, and so MAC0 far from its own.
HWY_INLINE bool is_clean(const Projected& p) {
  const V ir = hn::Or(hn::Or(hn::Xor(p.eye.mac1, p.ir1), hn::Xor(p.eye.mac2, p.ir2)), p.eye.wrapped);
  const V z = hn::AndNot(all(0x7fff), p.eye.z);
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
  V bits = hn::Or(differ(p.eye.mac1, p.ir1, flag::ir1_saturated),
                  differ(p.eye.mac2, p.ir2, flag::ir1_saturated >> 1));
  bits = hn::Or(bits, p.eye.wrapped);
  bits = hn::Or(bits, outside(p.eye.z, -0x8000, 0x7fff, flag::ir1_saturated >> 2));
  bits = hn::Or(bits, differ(p.eye.z, p.sz, flag::sz3_or_otz_saturated));
  bits = hn::Or(bits, where(p.overflow, flag::divide_overflow));
  const V most = hn::Max(p.x_4, p.y_4), least = hn::Min(p.x_4, p.y_4);
  bits = hn::Or(bits, where(hn::Gt(most, all((1 << 29) - 1)), flag::mac0_positive));
  bits = hn::Or(bits, where(hn::Lt(least, all(-(1 << 29))), flag::mac0_negative));
  bits = hn::Or(bits, outside(p.x_4, -(1 << 24), (1 << 24) - 1, flag::sx2_saturated));
  return hn::Or(bits, outside(p.y_4, -(1 << 24), (1 << 24) - 1, flag::sy2_saturated));
}

HWY_INLINE V flags(const ProjectSetup& s, const Projected& p) {
  const V cue = ir0_flag(s, p.q);
  if (is_clean(p)) return cue;
  return with_error(hn::Or(cue, dirty_flags(p)));
}

template <class To>
HWY_INLINE void store_narrow(V v, To* to) {
  const hn::Rebind<To, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, v), narrow, to);
}

HWY_INLINE V ir0(const ProjectSetup& s, V q) {
  return limit(hn::ShiftRight<10>(offset_product(q, s.dqa, s.dqb)), hn::Zero(d), all(0x1000));
}

/// One vector of vertices from `in` to place `at` of the outputs. `extras`: any of
/// the outputs few callers want.
template <bool sf, Sums sums, bool want_flag, bool extras>
HWY_INLINE void project_to(const ProjectSetup& s, const Vertex* in, const ProjectOut& out, std::size_t at) {
  const Projected p = project_block<sf, sums>(s, load_vertices(in));
  if (out.sxy != nullptr) store(screen(p), out.sxy + at);
  if (out.sz != nullptr) store_narrow(p.sz, out.sz + at);
  if constexpr (want_flag) store(flags(s, p), out.flag + at);
  if constexpr (extras) {
    if (out.ir0 != nullptr) store_narrow(ir0(s, p.q), out.ir0 + at);
    if (out.z_20_12 != nullptr) store(p.eye.z_20_12, out.z_20_12 + at);
    const auto fraction = [](V v) { return hn::And(hn::ShiftRight<6>(v), all(0xff)); };
    if (out.fraction_x != nullptr) store_narrow(fraction(p.x_4), out.fraction_x + at);
    if (out.fraction_y != nullptr) store_narrow(fraction(p.y_4), out.fraction_y + at);
  }
}

/// The last, short vector goes through memory of its own.
template <bool sf, Sums sums, bool want_flag, bool extras>
HWY_NOINLINE void project_tail(const ProjectSetup& s, std::span<const Vertex> in, const ProjectOut& out,
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
  project_to<sf, sums, want_flag, extras>(s, v, {sxy, sz, flag, ir0, z, fx, fy}, 0);
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

template <bool sf, Sums sums, bool want_flag, bool extras>
void project_all(const ProjectSetup& s, std::span<const Vertex> in, const ProjectOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  std::size_t at = 0;
  for (; at + lanes <= in.size(); at += lanes)
    project_to<sf, sums, want_flag, extras>(s, in.data() + at, out, at);
  if (at < in.size()) project_tail<sf, sums, want_flag, extras>(s, in, out, at);
}

template <bool sf, bool want_flag>
void project_chosen(const ProjectSetup& s, bool narrow, bool extras, std::span<const Vertex> in,
                    const ProjectOut& out) {
  if (!narrow) return project_all<sf, Sums::wide, want_flag, true>(s, in, out);
  if (extras) return project_all<sf, Sums::narrow, want_flag, true>(s, in, out);
  project_all<sf, Sums::narrow, want_flag, false>(s, in, out);
}

void project(const Registers& r, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  if (!ProjectSetup::offsets_are_sane(r)) return plain_project_doors.project(r, in, out, c);
  const bool extras =
      out.ir0 != nullptr || out.z_20_12 != nullptr || out.fraction_x != nullptr || out.fraction_y != nullptr;
  using Run = void (*)(const ProjectSetup&, bool, bool, std::span<const Vertex>, const ProjectOut&);
  static constexpr Run runs[2][2] = {{project_chosen<false, false>, project_chosen<false, true>},
                                     {project_chosen<true, false>, project_chosen<true, true>}};
  runs[c.sf() ? 1 : 0][out.flag != nullptr ? 1 : 0](ProjectSetup(r, c), ProjectSetup::rows_are_narrow(r),
                                                    extras, in, out);
}

/// NCLIP from packed screen positions of RTPT: (b - a) x (c - a); differences have
/// 12 bits, so 16-bit ones do.
HWY_INLINE V signed_area(V a, V b, V c) {
  const hn::Repartition<std::int16_t, D> d16;
  const auto minus = [&](V v, V w) { return hn::Sub(hn::BitCast(d16, v), hn::BitCast(d16, w)); };
  const auto swap = [](V v) { return hn::BitCast(d, hn::RotateRight<16>(hn::BitCast(du, v))); };
  const V high = all(0xffff0000u);
  const V to_c = hn::Xor(hn::BitCast(d, minus(swap(c), swap(a))), high);  // (y, ~x); ~x + 1 = -x
  return multiply_pairs(hn::BitCast(d, minus(b, a)), hn::BitCast(d, minus(to_c, high)), hn::Zero(d));
}

/// One vector of triangles, three of vertices: projected in order, then taken apart by corner.
template <bool sf, Sums sums, bool want_flag>
HWY_INLINE void triangles_to(const ProjectSetup& s, V zsf3, const Vertex* in, const TriangleOut& out,
                             std::size_t at) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  alignas(64) std::int32_t own_sxy[3 * lanes], sz[3 * lanes], bits[3 * lanes], q[3 * lanes];
  std::int32_t* sxy = own_sxy;
  for (std::size_t k = 0; k < 3; ++k) {
    const Projected p = project_block<sf, sums>(s, load_vertices(in + k * lanes));
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

template <bool sf, Sums sums, bool want_flag>
HWY_NOINLINE void triangles_tail(const ProjectSetup& s, V zsf3, std::span<const Vertex> in,
                                 const TriangleOut& out, std::size_t at) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  Vertex v[3 * lanes] = {};
  ScreenXy sxy[3 * lanes];
  std::uint16_t sz[3 * lanes], otz[lanes];
  std::uint32_t flag[lanes], avsz3_flag[lanes];
  std::int16_t ir0[lanes];
  std::int32_t mac0[lanes];
  const std::size_t count = in.size() / 3 - at;
  std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(3 * at), 3 * count, v);
  triangles_to<sf, sums, want_flag>(s, zsf3, v, {sxy, sz, flag, ir0, mac0, otz, avsz3_flag}, 0);
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

template <bool sf, Sums sums, bool want_flag>
void triangles_all(const Registers& r, const ProjectSetup& s, std::span<const Vertex> in,
                   const TriangleOut& out) {
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t count = in.size() / 3;
  const V zsf3 = all(std::int32_t{r.zsf3.raw});
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes)
    triangles_to<sf, sums, want_flag>(s, zsf3, in.data() + 3 * at, out, at);
  if (at < count) triangles_tail<sf, sums, want_flag>(s, zsf3, in, out, at);
}

void project_triangles(const Registers& r, std::span<const Vertex> in, const TriangleOut& out, Command c) {
  constexpr int steepest_average = 10922;  // 3 * FFFFh * 10922 < 2^31
  if (!ProjectSetup::offsets_are_sane(r) || std::abs(r.zsf3.raw) > steepest_average) {
    return plain_project_doors.project_triangles(r, in, out, c);
  }
  using Run = void (*)(const Registers&, const ProjectSetup&, std::span<const Vertex>, const TriangleOut&);
  static constexpr Run runs[2][2][2] = {
      {{triangles_all<false, Sums::wide, false>, triangles_all<false, Sums::wide, true>},
       {triangles_all<false, Sums::narrow, false>, triangles_all<false, Sums::narrow, true>}},
      {{triangles_all<true, Sums::wide, false>, triangles_all<true, Sums::wide, true>},
       {triangles_all<true, Sums::narrow, false>, triangles_all<true, Sums::narrow, true>}}};
  const bool narrow = ProjectSetup::rows_are_narrow(r);
  runs[c.sf() ? 1 : 0][narrow ? 1 : 0][out.flag != nullptr ? 1 : 0](r, ProjectSetup(r, c), in, out);
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
const ProjectDoors* project_doors([[maybe_unused]] std::int64_t target) {
#if HWY_TARGETS & HWY_AVX3
  if (target == HWY_AVX3) return N_AVX3::project_doors();
#endif
#if HWY_TARGETS & HWY_AVX2
  if (target == HWY_AVX2) return N_AVX2::project_doors();
#endif
#if HWY_TARGETS & HWY_SSE4
  if (target == HWY_SSE4) return N_SSE4::project_doors();
#endif
  return nullptr;
}
}  // namespace gte
#endif
