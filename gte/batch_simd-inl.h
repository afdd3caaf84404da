// What the SIMD kernels share. Included once for each instruction set, inside HWY_BEFORE_NAMESPACE; so no
// include guard in the usual sense.
#if defined(GTE_BATCH_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GTE_BATCH_SIMD_INL_H_
#undef GTE_BATCH_SIMD_INL_H_
#else
#define GTE_BATCH_SIMD_INL_H_
#endif

#include <cstdlib>

#include "hwy/highway.h"

// Highway's own emulations of a vector are slower than the plain loop, and only x86 keeps 128-bit blocks and
// pairs where the kernels expect them.
#undef GTE_HAS_SIMD
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#define GTE_HAS_SIMD 1
#else
#define GTE_HAS_SIMD 0
#endif

HWY_BEFORE_NAMESPACE();
namespace gte::HWY_NAMESPACE {

#if GTE_HAS_SIMD

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<std::int32_t>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr D d;
constexpr DU du;

HWY_INLINE V all(std::int32_t value) { return hn::Set(d, value); }
HWY_INLINE V all(std::uint32_t value) { return hn::Set(d, static_cast<std::int32_t>(value)); }

/// Two 16-bit numbers as one lane: `low` meets the low half of the other operand of multiply_pairs.
HWY_INLINE V pair(std::int32_t low, std::int32_t high) {
  return all((static_cast<std::uint32_t>(high) << 16) | (static_cast<std::uint32_t>(low) & 0xffffu));
}

/// Each lane: sum + a.low * b.low + a.high * b.high, halves signed. Exact as long as
/// the total fits into 32 bits.
HWY_INLINE V multiply_pairs(V a, V b, V sum) {
  const hn::Repartition<std::int16_t, D> d16;
  V unused = hn::Zero(d);
  return hn::ReorderWidenMulAccumulate(d, hn::BitCast(d16, a), hn::BitCast(d16, b), sum, unused);
}

HWY_INLINE V limit(V v, V lowest, V highest) { return hn::Min(hn::Max(v, lowest), highest); }

/// `bits` in the lanes where the mask holds.
HWY_INLINE V where(M mask, std::uint32_t bits) { return hn::IfThenElseZero(mask, all(bits)); }

/// Logical shift; the plain one copies the sign.
template <int n>
HWY_INLINE V shift_down(V v) {
  return hn::BitCast(d, hn::ShiftRight<n>(hn::BitCast(du, v)));
}

HWY_INLINE V load(const void* from) { return hn::LoadU(d, static_cast<const std::int32_t*>(from)); }
HWY_INLINE void store(V v, void* to) { hn::StoreU(v, d, static_cast<std::int32_t*>(to)); }

/// Vertices as two vectors, in order: (x, y) and (z, pad), low half first.
struct Vertices {
  V xy, z;
};
HWY_INLINE Vertices load_vertices(const Vertex* in) {
  const V a = load(in), b = load(in + hn::Lanes(d) / 2);
  return {hn::ConcatEven(d, b, a), hn::ConcatOdd(d, b, a)};
}

/// One row of a matrix, ready for multiply_pairs with (x, y) and (z, pad).
struct Row {
  V xy, z, offset;
  Row(const std::array<S3_12, 3>& m, std::int32_t t)
      : xy(pair(m[0].raw, m[1].raw)),
        z(pair(m[2].raw, 0)),
        offset(all(static_cast<std::uint32_t>(t) << 12)) {}
  [[nodiscard]] HWY_INLINE V times(const Vertices& v) const {
    return multiply_pairs(xy, v.xy, multiply_pairs(z, v.z, offset));
  }
};

/// True when no vector of 16-bit numbers can take this row out of 32 bits: then 32-bit lanes hold every
/// partial sum, and no 44-bit overflow is possible. The bound is strict, because (-8000h) * (-8000h) twice is
/// one too many.
inline bool fits_32_bits(const std::array<S3_12, 3>& m, std::int32_t t) {
  const std::int64_t row = std::int64_t{std::abs(m[0].raw)} + std::abs(m[1].raw) + std::abs(m[2].raw);
  return std::abs(std::int64_t{t}) * 4096 + row * 0x8000 < 0x80000000;
}

/// FLAG's bit 31 added.
HWY_INLINE V with_error(V bits) {
  const V causes = hn::And(bits, all(flag::error_causes));
  return hn::Or(bits, hn::AndNot(hn::VecFromMask(d, hn::Eq(causes, hn::Zero(d))), all(flag::error)));
}

#endif
}  // namespace gte::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
