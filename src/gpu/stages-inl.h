// The pixel pipeline, one small function per stage, written once in Highway vectors and compiled for every
// dispatch target. A block is as many pixels of a row as the target has 32-bit lanes. Included by
// kernels-inl.h alone, once per target; every `if` on Mode folds away because a kernel passes a constant.

#if defined(OTTER_GPU_STAGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OTTER_GPU_STAGES_INL_H_
#undef OTTER_GPU_STAGES_INL_H_
#else
#define OTTER_GPU_STAGES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "gpu/depth.h"
#include "gpu/job.h"
#include "gpu/rules.h"
#include "gpu/vram.h"

HWY_BEFORE_NAMESPACE();
namespace gpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Left to itself the compiler keeps a stage as a call, and the kernel runs many times slower. Under the
// sanitizers stages are calls indeed: they can be stepped, are shared by all modes, and compile in seconds.
#undef STAGE
#ifdef OTTER_STAGES_ARE_CALLS
#define STAGE static
#else
#define STAGE static HWY_INLINE
#endif

template <class D>
using Half16 = hn::Rebind<std::uint16_t, D>;
template <class D>
using V = hn::Vec<D>;  // 32-bit lanes: one pixel each
template <class D>
using V16 = hn::Vec<Half16<D>>;  // the same pixels in 16 bits

/// 0, step, 2 step ...
template <class D>
STAGE V<D> ramp(D d, std::uint32_t step) {
  if constexpr (hn::MaxLanes(d) == 1) {
    return hn::Zero(d);
  } else {
    return hn::Mul(hn::Iota(d, 0), hn::Set(d, static_cast<std::int32_t>(step)));
  }
}

/// The 8-bit value of an attribute with 24 bits of fraction.
template <class D>
STAGE V<D> whole(D d, V<D> attribute) {
  return hn::BitCast(d, hn::ShiftRight<24>(hn::BitCast(hn::RebindToUnsigned<D>(), attribute)));
}

/// Halfwords base[index], in the low 16 bits of each lane; what the high bits hold is nobody's business.
template <class D>
STAGE V<D> gather([[maybe_unused]] D d, const std::uint16_t* base, V<D> index) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET <= HWY_AVX3
  return hn::GatherOffset(d, reinterpret_cast<const std::int32_t*>(base), hn::ShiftLeft<1>(index));
#else
  constexpr std::size_t lanes = hn::MaxLanes(d);
  HWY_ALIGN std::int32_t at[lanes];
  hn::Store(index, d, at);
  for (std::int32_t& lane : at) lane = base[lane];
  return hn::Load(d, at);
#endif
}

template <class D>
STAGE V<D> shift_right(D d, V<D> value, V<D> bits) {
  const hn::RebindToUnsigned<D> du;
  return hn::BitCast(d, hn::BitCast(du, value) >> hn::BitCast(du, bits));
}

/// Products that fit in 16 bits.
template <class D>
STAGE V<D> multiply_small([[maybe_unused]] D d, V<D> a, V<D> b) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Mul(a, b);
#else
  const hn::Repartition<std::uint16_t, D> d16;
  return hn::BitCast(d, hn::Mul(hn::BitCast(d16, a), hn::BitCast(d16, b)));
#endif
}

template <class D>
STAGE V16<D> narrow([[maybe_unused]] D d, V<D> pixels) {
#if HWY_TARGET == HWY_SCALAR
  return V16<D>(static_cast<std::uint16_t>(pixels.raw));
#else
  return hn::TruncateTo(Half16<D>(), hn::BitCast(hn::RebindToUnsigned<D>(), pixels));
#endif
}

// --- texel ---

/// 16-entry palette that one shuffle looks up for all lanes: an entry in each lane where there are 16, else
/// two tables of bytes.
template <class D>
struct Palette16 {
#if HWY_TARGET <= HWY_AVX3
  V<hn::ScalableTag<std::int32_t>> entries;
  explicit Palette16(const std::uint16_t* clut) {
    const hn::ScalableTag<std::int32_t> d;
    entries = hn::PromoteTo(d, hn::LoadU(Half16<decltype(d)>(), clut));
  }
  STAGE V<D> at(const Palette16& p, V<D> index) {
    const D d;
    return hn::TableLookupLanes(p.entries, hn::IndicesFromVec(d, index));
  }
#elif HWY_TARGET == HWY_SCALAR
  const std::uint16_t* entries;
  explicit Palette16(const std::uint16_t* clut) : entries(clut) {}
  STAGE V<D> at(const Palette16& p, V<D> index) { return V<D>(p.entries[index.raw]); }
#else
  using D8 = hn::Repartition<std::uint8_t, D>;
  hn::Vec<D8> low, high;
  explicit Palette16(const std::uint16_t* clut) {
    alignas(16) std::array<std::uint8_t, 16> lows, highs;
    for (std::size_t i = 0; i < 16; ++i) {
      lows[i] = static_cast<std::uint8_t>(clut[i]);
      highs[i] = static_cast<std::uint8_t>(clut[i] >> 8);
    }
    low = hn::LoadDup128(D8(), lows.data());
    high = hn::LoadDup128(D8(), highs.data());
  }
  STAGE V<D> at(const Palette16& p, V<D> index) {
    const D d;
    const auto skip = [d](std::uint32_t bytes) { return hn::Set(d, static_cast<std::int32_t>(bytes)); };
    const auto first = hn::BitCast(D8(), hn::Or(index, skip(0x80808000)));
    const auto second = hn::BitCast(D8(), hn::Or(hn::ShiftLeft<8>(index), skip(0x80800080)));
    return hn::BitCast(
        d, hn::Or(hn::TableLookupBytesOr0(p.low, first), hn::TableLookupBytesOr0(p.high, second)));
  }
#endif
};

/// Palette indices or pixels of texels u, v anywhere in the page.
template <class D>
STAGE V<D> texel_word(D d, Mode m, const Job& job, V<D> u, V<D> v) {
  const auto set = [d](std::uint32_t x) { return hn::Set(d, static_cast<std::int32_t>(x)); };
  u = hn::Or(hn::And(u, set(job.page.keep_u)), set(job.page.set_u));
  v = hn::Or(hn::And(v, set(job.page.keep_v)), set(job.page.set_v));
  const auto row = hn::ShiftLeft<10>(hn::Add(v, set(job.page.y)));
  const auto address = [&](V<D> column) {
    return hn::Or(row, hn::And(hn::Add(column, set(job.page.x)), set(Vram::width - 1)));
  };
  if (m.surface.texture == TexelFormat::clut4) {
    const auto word = gather(d, job.pixels, address(hn::ShiftRight<2>(u)));
    return hn::And(shift_right(d, word, hn::ShiftLeft<2>(hn::And(u, set(3)))), set(15));
  }
  if (m.surface.texture == TexelFormat::clut8) {
    const auto word = gather(d, job.pixels, address(hn::ShiftRight<1>(u)));
    return hn::And(shift_right(d, word, hn::ShiftLeft<3>(hn::And(u, set(1)))), set(255));
  }
  return hn::And(gather(d, job.pixels, address(u)), set(0xffff));
}

/// The same for texels that lie side by side from u, v on: loads instead of gathers.
template <class D>
STAGE V<D> adjacent_word(D d, Mode m, const Job& job, std::uint32_t u, std::uint32_t v) {
  const std::uint16_t* row = job.pixels + (job.page.y + v) * Vram::width + job.page.x;
  constexpr std::size_t lanes = hn::MaxLanes(d);
  if (m.surface.texture == TexelFormat::clut4) {
    // 16 nibbles from u on; an odd u drops one, which the next byte makes good.
    const auto* bytes = reinterpret_cast<const unsigned char*>(row) + (u >> 1);
    std::uint64_t nibbles = 0, next = 0;
    std::memcpy(&nibbles, bytes, 8);
    std::memcpy(&next, bytes + 1, 8);
    const std::uint32_t odd = u % 2 * 4;
    nibbles = nibbles >> odd | next << (8 - odd);  // an even u: the same bytes twice
    auto words = hn::Set(d, static_cast<std::int32_t>(static_cast<std::uint32_t>(nibbles)));
    if constexpr (lanes == 16) {
      const auto both = hn::BitCast(d, hn::Set(hn::Repartition<std::uint64_t, D>(), nibbles));
      words = hn::TableLookupLanes(both, hn::IndicesFromVec(d, hn::ShiftRight<3>(hn::Iota(d, 0))));
    }
    if constexpr (lanes > 1) {
      words = shift_right(d, words, hn::And(hn::ShiftLeft<2>(hn::Iota(d, 0)), hn::Set(d, 31)));
    }
    return hn::And(words, hn::Set(d, 15));
  }
  if (m.surface.texture == TexelFormat::clut8) {
    const hn::Rebind<std::uint8_t, D> d8;
    return hn::PromoteTo(d, hn::LoadU(d8, reinterpret_cast<const unsigned char*>(row) + u));
  }
  return hn::PromoteTo(d, hn::LoadU(Half16<D>(), row + u));
}

template <class D>
STAGE V<D> through_palette(D d, Mode m, const Job& job, const Palette16<D>& palette, V<D> word) {
  if (m.surface.texture == TexelFormat::clut4) return Palette16<D>::at(palette, word);
  if (m.surface.texture == TexelFormat::clut8) return hn::And(gather(d, job.clut, word), hn::Set(d, 0xffff));
  return word;
}

// --- shade ---

template <class D>
struct Rgb {
  V<D> r, g, b;  // 0..255, or 0..494 after modulation
};

/// Offsets of the pixels x, x+1 ... of row y.
template <class D>
STAGE V<D> dither_offsets(D d, int x, int y) {
  // The matrix again and again, as far as a vector reaches from any column.
  static constexpr auto table = [] {
    std::array<std::array<std::int32_t, 20>, 4> rows{};
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t i = 0; i < 20; ++i) rows[row][i] = dither_matrix[row][i % 4];
    }
    return rows;
  }();
  return hn::LoadU(d, &table[static_cast<std::size_t>(y & 3)][static_cast<std::size_t>(x & 3)]);
}

template <class D>
STAGE V<D> modulate_channel(D d, V<D> texel5, V<D> colour8) {
  return hn::ShiftRight<4>(multiply_small(d, texel5, colour8));
}

template <class D>
STAGE Rgb<D> modulate(D d, V<D> texel, const Rgb<D>& colour) {
  const auto five = hn::Set(d, 31);
  return {modulate_channel(d, hn::And(texel, five), colour.r),
          modulate_channel(d, hn::And(hn::ShiftRight<5>(texel), five), colour.g),
          modulate_channel(d, hn::And(hn::ShiftRight<10>(texel), five), colour.b)};
}

/// 8-bit channels to a 15-bit pixel, each limited to 0..255 where it can lie outside.
template <class D>
STAGE V<D> pack(D d, Mode m, Rgb<D> c, V<D> dither) {
  const auto top = hn::Set(d, 255);
  if (m.surface.dither) {
    const auto add = [&](V<D> channel) { return hn::Max(hn::Add(channel, dither), hn::Zero(d)); };
    c = {add(c.r), add(c.g), add(c.b)};
  }
  if (m.surface.dither || m.surface.texture != TexelFormat::none) {
    c = {hn::Min(c.r, top), hn::Min(c.g, top), hn::Min(c.b, top)};
  }
  const auto high5 = hn::Set(d, 0xf8);
  return hn::Or(hn::Or(hn::ShiftRight<3>(c.r), hn::ShiftLeft<2>(hn::And(c.g, high5))),
                hn::ShiftLeft<7>(hn::And(c.b, high5)));
}

// --- blend: three 5-bit channels at once; the top bit of each is added apart, so that no carry leaves a
// channel ---

/// 10h of a channel to 1Fh of it.
template <class D16, class T = hn::Vec<D16>>
STAGE T widen(D16, T top_bits) {
  return hn::Sub(hn::ShiftLeft<1>(top_bits), hn::ShiftRight<4>(top_bits));
}

template <class D16, class T = hn::Vec<D16>>
STAGE T add_saturated(D16 d, T back, T front) {
  const auto top = hn::Set(d, 0x4210), low = hn::Set(d, 0x3def);
  const auto sum =
      hn::Xor(hn::Add(hn::And(back, low), hn::And(front, low)), hn::And(hn::Xor(back, front), top));
  const auto carries = hn::Or(hn::And(back, front), hn::AndNot(sum, hn::Or(back, front)));
  return hn::Or(sum, widen(d, hn::And(carries, top)));
}

template <class D16, class T = hn::Vec<D16>>
STAGE T subtract_saturated(D16 d, T back, T front) {
  const auto top = hn::Set(d, 0x4210), low = hn::Set(d, 0x3def);
  const auto differs = hn::Xor(back, front);
  const auto difference = hn::Xor(hn::Sub(hn::Or(back, top), hn::And(front, low)), hn::AndNot(differs, top));
  const auto borrows = hn::Or(hn::AndNot(back, front), hn::AndNot(differs, difference));
  return hn::AndNot(widen(d, hn::And(borrows, top)), difference);
}

/// Bit 15 of the operands takes no part; that of the result is 0.
template <class D16, class T = hn::Vec<D16>>
STAGE T blend(D16 d, Blend how, T back, T front) {
  back = hn::And(back, hn::Set(d, 0x7fff));
  front = hn::And(front, hn::Set(d, 0x7fff));
  if (how == Blend::average) {
    return hn::Add(hn::And(back, front),
                   hn::ShiftRight<1>(hn::And(hn::Xor(back, front), hn::Set(d, 0x7bde))));
  }
  if (how == Blend::subtract) return subtract_saturated(d, back, front);
  if (how == Blend::add_quarter) front = hn::And(hn::ShiftRight<2>(front), hn::Set(d, 0x1ce7));
  return add_saturated(d, back, front);
}

// --- depth ---

/// The affine depth quantity at the leftmost pixel of a span.
STAGE double depth_at(const DepthJob& depth, const Span& span) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double edge = depth.edge_start[i] + depth.edge_dx[i] * span.dx + depth.edge_dy[i] * span.dy;
    sum += edge * depth.weight[i];
  }
  return sum;
}

#if HWY_TARGET == HWY_SCALAR
template <bool, bool, class D>
STAGE V<D> computed_depth(D, const DepthJob& depth, double start, int column) {
  return V<D>(static_cast<std::int32_t>(depth.constants->stored(start + depth.slope * column)));
}

template <class D>
struct FixedDepths {
  std::uint64_t first = 0;
  STAGE FixedDepths ramp(std::uint64_t) { return {}; }
  STAGE FixedDepths from(std::uint64_t start, const FixedDepths&) { return {start}; }
  STAGE V<D> whole(const FixedDepths& f) {
    return V<D>(static_cast<std::int32_t>(static_cast<std::uint32_t>(f.first >> 32)));
  }
  STAGE void advance(FixedDepths& f, std::uint64_t dx) { f.first += dx; }
};
#else
/// Doubles, half a block at a time: 32-bit depths need their 53 bits.
template <bool is_linear, bool is_float, class D>
STAGE auto computed_half(D, const DepthJob& depth, double start, int column) {
  const hn::Repartition<double, D> d;
  const hn::Rebind<std::int32_t, decltype(d)> d32;
  const DepthConstants& c = *depth.constants;
  const auto set = [d](double x) { return hn::Set(d, x); };
  const auto columns = hn::Add(hn::Iota(d, 0), set(column));
  auto value = hn::Add(set(start), hn::Mul(set(depth.slope), columns));
  value = hn::Min(hn::Max(value, set(c.low)), set(c.high));
  if constexpr (is_linear) {
    value = hn::Add(hn::Mul(hn::Div(set(1.0), value), set(c.linear_scale)), set(c.linear_offset));
    value = hn::Min(hn::Max(value, hn::Zero(d)), set(c.scale));
  }
  if constexpr (is_float) {
    const hn::Rebind<float, decltype(d)> df;
    return hn::BitCast(d32, hn::DemoteTo(df, value));
  } else {
    // There is no conversion to unsigned on every target: shift the range down, convert, shift it back.
    constexpr double middle = 2147483648.0;
    const auto shifted = hn::Sub(hn::Floor(hn::Add(value, set(0.5))), set(middle));
    return hn::Xor(hn::DemoteTo(d32, shifted), hn::Set(d32, static_cast<std::int32_t>(0x80000000)));
  }
}

template <bool is_linear, bool is_float, class D>
STAGE V<D> computed_depth(D d, const DepthJob& depth, double start, int column) {
  constexpr int half = static_cast<int>(hn::MaxLanes(d) / 2);
  return hn::Combine(d, computed_half<is_linear, is_float>(d, depth, start, column + half),
                     computed_half<is_linear, is_float>(d, depth, start, column));
}

/// The block's keys in 32.32: two vectors, whose odd 32-bit lanes are the keys.
template <class D>
struct FixedDepths {
  using D64 = hn::Repartition<std::uint64_t, D>;
  hn::Vec<D64> low, high;

  STAGE FixedDepths ramp(std::uint64_t dx) {
    const D64 d;
    const hn::RebindToUnsigned<D> d32;
    constexpr auto half = hn::MaxLanes(d);
    const auto lane = hn::BitCast(d32, hn::Iota(d, 0));
    const auto times = [&](std::uint64_t factor) {
      return hn::MulEven(lane, hn::Set(d32, static_cast<std::uint32_t>(factor)));
    };
    const auto first = hn::Add(times(dx), hn::ShiftLeft<32>(times(dx >> 32)));
    return {first, hn::Add(first, hn::Set(d, dx * half))};
  }
  STAGE FixedDepths from(std::uint64_t start, const FixedDepths& lanes) {
    const auto first = hn::Set(D64(), start);
    return {hn::Add(first, lanes.low), hn::Add(first, lanes.high)};
  }
  STAGE V<D> whole(const FixedDepths& f) {
    const D d;
    return hn::ConcatOdd(d, hn::BitCast(d, f.high), hn::BitCast(d, f.low));
  }
  STAGE void advance(FixedDepths& f, std::uint64_t dx) {
    const D64 d;
    const auto block = hn::Set(d, dx * (2 * hn::MaxLanes(d)));
    f = {hn::Add(f.low, block), hn::Add(f.high, block)};
  }
};
#endif

/// Nearer is smaller, whatever the format.
template <class D>
STAGE V<D> key_of(D d, const DepthConstants& c, V<D> stored) {
  return hn::Add(hn::Xor(stored, hn::Set(d, static_cast<std::int32_t>(c.flip))),
                 hn::Set(d, static_cast<std::int32_t>(c.add)));
}

/// No fragment is as far as a pixel that nobody wrote.
template <class D>
STAGE V<D> limited_key(D d, V<D> key) {
  const hn::RebindToUnsigned<D> du;
  return hn::BitCast(d, hn::Min(hn::BitCast(du, key), hn::Set(du, DepthPlane::farthest)));
}

/// Where the fragment lies behind what is there. `add` is 0 where an equal one wins, else 1: no key overflows
/// by it.
template <class D>
STAGE auto loses(D, V<D> add, V<D> key, V<D> old) {
  const hn::RebindToUnsigned<D> du;
  return hn::Lt(hn::BitCast(du, old), hn::BitCast(du, hn::Add(key, add)));
}

/// Keys of a few spans, for those that are computed pixel by pixel; each begins a vector.
using KeyBatch = std::array<std::int32_t, Vram::width + Vram::padding>;

STAGE std::size_t key_room(const Span& span) {
  constexpr auto lanes = hn::MaxLanes(hn::ScalableTag<std::int32_t>());
  return (static_cast<std::size_t>(span.count) + lanes - 1) / lanes * lanes;
}

template <bool is_linear, bool is_float>
std::size_t compute_keys(const DepthJob& depth, std::span<const Span> spans, KeyBatch& keys) {
  const hn::ScalableTag<std::int32_t> d;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  std::size_t done = 0;
  std::int32_t* next = keys.data();
  std::int32_t* const end = keys.data() + keys.size();
  for (; done < spans.size() && static_cast<std::size_t>(end - next) >= key_room(spans[done]); ++done) {
    const double start = depth_at(depth, spans[done]);
    for (int x = 0; x < spans[done].count; x += lanes, next += lanes) {
      const auto stored = computed_depth<is_linear, is_float>(d, depth, start, x);
      hn::StoreU(limited_key(d, key_of(d, *depth.constants, stored)), d, next);
    }
  }
  return done;
}

/// The keys of the first spans, as many as there is room for: at least one. Returns how many. Not a stage: it
/// would be a large part of every kernel with depth.
static HWY_NOINLINE std::size_t compute_keys(const DepthJob& depth, std::span<const Span> spans,
                                             KeyBatch& keys) {
  if (depth.constants->is_linear) {
    return depth.constants->is_float ? compute_keys<true, true>(depth, spans, keys)
                                     : compute_keys<true, false>(depth, spans, keys);
  }
  return depth.constants->is_float ? compute_keys<false, true>(depth, spans, keys)
                                   : compute_keys<false, false>(depth, spans, keys);
}

}  // namespace gpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
