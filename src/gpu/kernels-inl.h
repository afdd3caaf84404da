// The kernels of one dispatch target: every Mode, instantiated from the stages. Included by the file of each
// target, so that they compile side by side.

#if defined(OTTER_GPU_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OTTER_GPU_KERNELS_INL_H_
#undef OTTER_GPU_KERNELS_INL_H_
#else
#define OTTER_GPU_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "gpu/kernel_targets.h"
#include "gpu/stages-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gpu::HWY_NAMESPACE {

/// Nobody watches: no member, no code.
struct Unwatched {
  static constexpr bool is_on = false;
};
static_assert(std::is_empty_v<Unwatched>);

struct Watched {
  static constexpr bool is_on = true;
  const Watch& watch;
};

/// Stores the lanes of `wanted`. Neighbours of the row may be rewritten as they were.
template <class D, class M>
STAGE void store(D d, hn::Vec<D> value, M wanted, hn::TFromD<D>* to) {
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
  hn::BlendedStore(value, wanted, d, to);
#else
  hn::StoreU(hn::IfThenElse(wanted, value, hn::LoadU(d, to)), d, to);
#endif
}

/// The same lanes, for vectors of half the width and back.
template <class D, class M>
STAGE auto to_mask16([[maybe_unused]] D d, M mask) {
#if HWY_TARGET <= HWY_AVX3
  return hn::Mask<Half16<D>>{mask.raw};
#else
  const hn::RebindToUnsigned<D> du;
  return hn::MaskFromVec(narrow(d, hn::BitCast(d, hn::VecFromMask(du, mask))));
#endif
}

template <class D, class M>
STAGE auto to_mask32(D d, M mask) {
#if HWY_TARGET <= HWY_AVX3
  return hn::Mask<D>{mask.raw};
#else
  const Half16<D> d16;
  return hn::MaskFromVec(
      hn::PromoteTo(d, hn::BitCast(hn::RebindToSigned<Half16<D>>(), hn::VecFromMask(d16, mask))));
#endif
}

/// What all spans of a job have in common, in registers: as far as the compiler knows, every pixel written
/// might be a part of the job, which it would read again for every block.
template <class D>
struct Constants {
  Palette16<D> palette;
  Rgb<D> colour{}, colour_step{};  // of the lanes, relative to the first; from block to block
  V<D> u{}, v{}, u_step{}, v_step{};
  FixedDepths<D> depth{};
  std::uint64_t depth_step = 0;
  V<D> key_add{};  // the key plus this must not exceed the one that is there
  V16<D> mask_set{};
  bool writes_depth = false;
};

template <class D>
STAGE Constants<D> prepare(D d, Mode m, const Job& job) {
  Constants<D> c{Palette16<D>(job.clut)};
  constexpr auto lanes = static_cast<std::uint32_t>(hn::MaxLanes(d));
  const auto step = [d](const Gradient& g) { return hn::Set(d, static_cast<std::int32_t>(g.dx * lanes)); };
  if (m.surface.shade == Shade::gouraud) {
    c.colour = {ramp(d, job.shade.r.dx), ramp(d, job.shade.g.dx), ramp(d, job.shade.b.dx)};
    c.colour_step = {step(job.shade.r), step(job.shade.g), step(job.shade.b)};
  }
  if (m.surface.texture != TexelFormat::none) {
    c.u = ramp(d, job.texel.u.dx);
    c.v = ramp(d, job.texel.v.dx);
    c.u_step = step(job.texel.u);
    c.v_step = step(job.texel.v);
  }
  if (m.depth) {
    c.depth = FixedDepths<D>::ramp(job.depth.fixed.dx);
    c.depth_step = job.depth.fixed.dx;
    c.key_add = hn::Set(d, job.depth.constants->equal_wins ? 0 : 1);
    c.writes_depth = job.depth.writes;
  }
  c.mask_set = hn::Set(Half16<D>(), job.mask_set);
  return c;
}

/// The block that is next in a span.
template <class D>
struct Walk {
  std::uint16_t* pixels = nullptr;
  int x = 0, y = 0, left = 0;  // pixels of the span that are left
  Rgb<D> colour{};
  V<D> dither{};
  V<D> u{}, v{};
  std::uint32_t first_u = 0, first_v = 0;
  bool is_adjacent = false;  // texels from first_u on lie side by side
  std::int32_t* keys = nullptr;
  FixedDepths<D> fixed_depth{};
  const std::int32_t* computed_keys = nullptr;  // nullptr: fixed_depth counts
};

template <class D>
STAGE Walk<D> begin(D d, Mode m, const Job& job, const Constants<D>& constants, const Span& span,
                    const std::int32_t* computed_keys) {
  Walk<D> walk{
      .pixels = job.pixels + Vram::offset(span.x, span.y), .x = span.x, .y = span.y, .left = span.count};
  const auto start = [&](const Gradient& g, V<D> lanes) {
    return hn::Add(hn::Set(d, static_cast<std::int32_t>(g.at(span.dx, span.dy))), lanes);
  };
  if (m.surface.shade == Shade::gouraud) {
    walk.colour = {start(job.shade.r, constants.colour.r), start(job.shade.g, constants.colour.g),
                   start(job.shade.b, constants.colour.b)};
  }
  if (m.surface.dither) walk.dither = dither_offsets(d, span.x, span.y);
  if (m.surface.texture != TexelFormat::none) {
    walk.first_u = job.texel.u.at(span.dx, span.dy) >> 24;
    walk.first_v = job.texel.v.at(span.dx, span.dy) >> 24;
    walk.is_adjacent = job.page.side_by_side && walk.first_u + static_cast<std::uint32_t>(span.count) <= 256;
    if (!walk.is_adjacent) {
      walk.u = start(job.texel.u, constants.u);
      walk.v = start(job.texel.v, constants.v);
    }
  }
  if (m.depth) {
    walk.keys = reinterpret_cast<std::int32_t*>(job.depth.keys + DepthPlane::offset(span.x, span.y));
    walk.computed_keys = computed_keys;
    if (computed_keys == nullptr)
      walk.fixed_depth = FixedDepths<D>::from(job.depth.fixed.at(span.dx, span.dy), constants.depth);
  }
  return walk;
}

template <class D>
STAGE void advance(D d, Mode m, const Constants<D>& constants, Walk<D>& walk) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  walk.pixels += lanes;
  walk.x += lanes;
  walk.left -= lanes;
  if (m.surface.shade == Shade::gouraud) {
    walk.colour.r = hn::Add(walk.colour.r, constants.colour_step.r);
    walk.colour.g = hn::Add(walk.colour.g, constants.colour_step.g);
    walk.colour.b = hn::Add(walk.colour.b, constants.colour_step.b);
  }
  // The pattern repeats every four pixels.
  if (m.surface.dither && lanes % 4 != 0) walk.dither = dither_offsets(d, walk.x, walk.y);
  if (m.surface.texture != TexelFormat::none) {
    if (walk.is_adjacent) {
      walk.first_u += static_cast<std::uint32_t>(lanes);
    } else {
      walk.u = hn::Add(walk.u, constants.u_step);
      walk.v = hn::Add(walk.v, constants.v_step);
    }
  }
  if (m.depth) {
    walk.keys += lanes;
    if (walk.computed_keys == nullptr) {
      FixedDepths<D>::advance(walk.fixed_depth, constants.depth_step);
    } else {
      walk.computed_keys += lanes;
    }
  }
}

/// Depth key of each lane.
template <class D>
STAGE V<D> depth_keys(D d, const Walk<D>& walk) {
  if (walk.computed_keys != nullptr) return hn::LoadU(d, walk.computed_keys);
  return limited_key(d, FixedDepths<D>::whole(walk.fixed_depth));
}

template <class D>
STAGE V<D> texel(D d, Mode m, const Job& job, const Palette16<D>& palette, const Walk<D>& walk) {
  if (m.surface.texture == TexelFormat::none) return hn::Zero(d);
  if (walk.is_adjacent) {
    return through_palette(d, m, job, palette, adjacent_word(d, m, job, walk.first_u, walk.first_v));
  }
  return through_palette(d, m, job, palette, texel_word(d, m, job, whole(d, walk.u), whole(d, walk.v)));
}

/// The pixel before it meets VRAM: 15 bits, or a raw texel with all 16.
template <class D>
STAGE V16<D> shade(D d, Mode m, const Job& job, const Walk<D>& walk, V<D> texel_bits) {
  const bool is_gouraud = m.surface.shade == Shade::gouraud,
             is_textured = m.surface.texture != TexelFormat::none;
  if (m.surface.shade == Shade::raw) return narrow(d, texel_bits);
  if (!is_gouraud && !is_textured) return hn::Set(Half16<D>(), job.colour);
  const auto set = [d](std::uint8_t channel) { return hn::Set(d, std::int32_t{channel}); };
  Rgb<D> colour{set(job.r), set(job.g), set(job.b)};
  if (is_gouraud) colour = {whole(d, walk.colour.r), whole(d, walk.colour.g), whole(d, walk.colour.b)};
  if (is_textured) colour = modulate(d, texel_bits, colour);
  return narrow(d, pack(d, m, colour, walk.dither));
}

/// What of `pixel` ends in VRAM where `back` is, mask bit included.
template <class D16, class T = hn::Vec<D16>>
STAGE T combine(D16 d, Mode m, T mask_set, T texel_bits, T pixel, T back) {
  const bool is_textured = m.surface.texture != TexelFormat::none, is_blended = m.blend != Blend::opaque;
  const auto bit15 = hn::Set(d, 0x8000);
  if (is_blended && is_textured) {
    const auto lets_light_through = hn::Ne(hn::And(texel_bits, bit15), hn::Zero(d));
    pixel = hn::IfThenElse(lets_light_through, hn::Or(blend(d, m.blend, back, pixel), bit15), pixel);
  } else if (is_blended) {
    pixel = blend(d, m.blend, back, pixel);
  } else if (is_textured && m.surface.shade != Shade::raw) {
    pixel = hn::Or(pixel, hn::And(texel_bits, bit15));
  }
  return hn::Or(pixel, mask_set);
}

/// One lane: what the watcher is told. A fragment that lost the depth test is told too, as rejected.
template <class D16, class T = hn::Vec<D16>>
STAGE Event event_of(D16 d, Mode m, T mask_set, T texel16, T shaded, T back, std::size_t place) {
  Mode unblended = m;
  unblended.blend = Blend::opaque;
  Event event;
  event.pixel = static_cast<std::uint32_t>(place);
  event.before = event.after = hn::GetLane(back);
  event.fragment = hn::GetLane(combine(d, unblended, mask_set, texel16, shaded, back));
  event.blended = m.blend != Blend::opaque &&
                  (m.surface.texture == TexelFormat::none || (hn::GetLane(texel16) & 0x8000) != 0);
  return event;
}

template <class D, class Observer>
STAGE void draw_block(D d, Mode m, const Job& job, const Constants<D>& constants, const Walk<D>& walk,
                      [[maybe_unused]] const Observer& observer) {
  const Half16<D> d16;
  auto wanted = hn::FirstN(d16, static_cast<std::size_t>(walk.left));
  [[maybe_unused]] auto lost = wanted;

  V<D> key = hn::Zero(d);
  if (m.depth) {
    key = depth_keys(d, walk);
    lost = to_mask16(d, loses(d, constants.key_add, key, hn::LoadU(d, walk.keys)));
    if constexpr (!Observer::is_on) {
      wanted = hn::AndNot(lost, wanted);
      // Worth a branch that is hard to foretell only where a texel would have to be fetched.
      if (m.surface.texture != TexelFormat::none && hn::AllFalse(d16, wanted)) return;
    }
  }

  const auto texel_bits = texel(d, m, job, constants.palette, walk);
  const auto texel16 = narrow(d, texel_bits);
  if (m.surface.texture != TexelFormat::none) {
    wanted = hn::And(wanted, hn::Ne(texel16, hn::Zero(d16)));  // docs/hardware.md#texel-0000h
    if (m.depth) {
      const auto kind = hn::And(texel16, hn::Set(d16, job.depth.texel_mask));
      wanted = hn::And(wanted, hn::Eq(kind, hn::Set(d16, job.depth.texel_value)));
    }
  }

  auto back = hn::Zero(d16);
  if (m.reads_target() || Observer::is_on) {
    back = hn::LoadU(d16, walk.pixels);
    wanted = hn::And(wanted, hn::Eq(hn::And(back, hn::Set(d16, job.mask_test)), hn::Zero(d16)));
  }
  const auto shaded = shade(d, m, job, walk, texel_bits);
  const auto pixel = combine(d16, m, constants.mask_set, texel16, shaded, back);
  if constexpr (Observer::is_on) {
    if (hn::AllFalse(d16, wanted)) return;
    Event event = event_of(d16, m, constants.mask_set, texel16, shaded, back, Vram::offset(walk.x, walk.y));
    event.depth = static_cast<std::uint32_t>(hn::GetLane(key));
    event.rejected = m.depth && !hn::AllFalse(d16, lost);
    if (!event.rejected) event.after = hn::GetLane(pixel);
    observer.watch.note(event);
    if (event.rejected) return;
  }
  store(d16, pixel, wanted, walk.pixels);
  if (m.depth && constants.writes_depth) {  // after the texel test: a hole hides nothing
    store(d, key, to_mask32(d, wanted), walk.keys);
  }
}

/// Flat and opaque: the colour is known before the row is.
STAGE void fill_row(std::uint16_t* to, int width, std::uint16_t value) {
  const hn::ScalableTag<std::uint16_t> d;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  const auto values = hn::Set(d, value);
  for (; width >= lanes; width -= lanes, to += lanes) hn::StoreU(values, d, to);
  if (width > 0) store(d, values, hn::FirstN(d, static_cast<std::size_t>(width)), to);
}

template <class D, class Observer>
STAGE void draw_spans(D d, Mode m, const Job& job, std::span<const Span> spans, const Observer& observer) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  if (m == Mode{{TexelFormat::none, Shade::flat, false}, Blend::opaque, false, false} && !Observer::is_on) {
    for (const Span& span : spans)
      fill_row(job.pixels + Vram::offset(span.x, span.y), span.count, job.colour);
    return;
  }
  const Constants<D> constants = prepare(d, m, job);
  KeyBatch keys;
  const bool computes = m.depth && !job.depth.is_fixed;
  while (!spans.empty()) {
    const auto batch = spans.first(computes ? compute_keys(job.depth, spans, keys) : spans.size());
    const std::int32_t* next_keys = computes ? keys.data() : nullptr;
    for (const Span& span : batch) {
      Walk<D> walk = begin(d, m, job, constants, span, next_keys);
      while (true) {
        draw_block(d, m, job, constants, walk, observer);
        if (walk.left <= lanes) break;
        advance(d, m, constants, walk);
      }
      if (computes) next_keys += key_room(span);
    }
    spans = spans.subspan(batch.size());
  }
}

template <std::size_t index>
void kernel(const Job& job, std::span<const Span> spans) {
  draw_spans(hn::ScalableTag<std::int32_t>(), Mode::at(index), job, spans, Unwatched());
}

constexpr KernelTable table = []<std::size_t... I>(std::index_sequence<I...>) {
  return KernelTable{&kernel<I>...};
}
(std::make_index_sequence<Mode::count>());

void fill_block(std::uint16_t* to, int width, int height, std::uint16_t value) {
  for (; height > 0; --height, to += Vram::width) fill_row(to, width, value);
}

/// Vectors from the lower end up when the target lies there, else from the upper end down. Written out
/// because GCC turns a bounded memcpy of a row into `rep movsq`, several times slower at these lengths.
STAGE void copy_row(std::uint16_t* to, const std::uint16_t* from, int width) {
  const hn::ScalableTag<std::uint16_t> d;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  const int whole_vectors = width / lanes * lanes;
  const auto copy = [&](int i) { hn::StoreU(hn::LoadU(d, from + i), d, to + i); };
  if (to <= from) {
    for (int i = 0; i < whole_vectors; i += lanes) copy(i);
  }
  if (whole_vectors < width) {
    const auto rest = hn::FirstN(d, static_cast<std::size_t>(width - whole_vectors));
    store(d, hn::LoadU(d, from + whole_vectors), rest, to + whole_vectors);
  }
  if (to > from) {
    for (int i = whole_vectors - lanes; i >= 0; i -= lanes) copy(i);
  }
}

void copy_block(std::uint16_t* to, const std::uint16_t* from, int width, int height) {
  for (; height > 0; --height, to += Vram::width, from += Vram::width) copy_row(to, from, width);
}

using D32 = hn::ScalableTag<std::int32_t>;

/// How many pixels at the start of a span lose the depth test, in whole blocks.
STAGE int hidden_start(const DepthJob& depth, const Span& span, const FixedDepths<D32>& ramp,
                       V<D32> key_add) {
  const D32 d;
  const hn::RebindToUnsigned<D32> du;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  const auto* old = reinterpret_cast<const std::int32_t*>(depth.keys + DepthPlane::offset(span.x, span.y));
  auto fixed = FixedDepths<D32>::from(depth.fixed.at(span.dx, span.dy), ramp);
  int hidden = 0;
  for (; hidden < span.count; hidden += lanes) {
    const auto key = limited_key(d, FixedDepths<D32>::whole(fixed));
    const auto lost = loses(d, key_add, key, hn::LoadU(d, old + hidden));
    const auto inside = hn::FirstN(du, static_cast<std::size_t>(span.count - hidden));
    if (!hn::AllFalse(du, hn::AndNot(lost, inside))) break;
    FixedDepths<D32>::advance(fixed, depth.fixed.dx);
  }
  return hidden;
}

std::size_t cut_hidden(const DepthJob& depth, std::span<Span> spans, int least) {
  const auto ramp = FixedDepths<D32>::ramp(depth.fixed.dx);
  const auto key_add = hn::Set(D32(), depth.constants->equal_wins ? 0 : 1);
  std::size_t kept = 0;
  for (Span span : spans) {
    const int hidden = span.count < least ? 0 : hidden_start(depth, span, ramp, key_add);
    if (hidden >= span.count) continue;
    span.x = static_cast<std::int16_t>(span.x + hidden);
    span.dx = static_cast<std::int16_t>(span.dx + hidden);
    span.count = static_cast<std::int16_t>(span.count - hidden);
    spans[kept++] = span;
  }
  return kept;
}

constexpr Operations operations{&fill_block, &copy_block, &cut_hidden};

constexpr TargetKernels kernels{HWY_TARGET, table, operations};

}  // namespace gpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
