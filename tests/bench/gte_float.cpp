#include "tests/bench/gte_float.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/gte_float.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace bench::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
namespace hn = hwy::HWY_NAMESPACE;

// The count is a multiple of the lanes: this is a yardstick, not a door.
void project(const gte::Registers& r, std::span<const gte::Vertex> in, gte::ScreenXy* sxy,
             std::uint16_t* sz) {
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> d;
  const hn::Repartition<std::int16_t, decltype(df)> d16;
  const hn::Rebind<std::uint16_t, decltype(df)> du16;
  const hn::Repartition<std::uint8_t, decltype(df)> d8;
  alignas(16) static constexpr std::uint8_t xyxy[16] = {0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15};
  using V = hn::Vec<decltype(df)>;
  V m[3][3], t[3];
  for (std::size_t i = 0; i < 3; ++i) {
    t[i] = hn::Set(df, static_cast<float>(r.tr[i]));
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = hn::Set(df, static_cast<float>(r.rt[i][j].to_double()));
  }
  const V ofx = hn::Set(df, static_cast<float>(r.ofx.to_double())),
          ofy = hn::Set(df, static_cast<float>(r.ofy.to_double()));
  const V h = hn::Set(df, static_cast<float>(r.h));
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t at = 0; at < in.size(); at += lanes) {
    const auto* words = reinterpret_cast<const std::int32_t*>(in.data() + at);
    const auto a = hn::LoadU(d, words), b = hn::LoadU(d, words + lanes);
    const auto xy = hn::ConcatEven(d, b, a), zp = hn::ConcatOdd(d, b, a);
    const V x = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(xy)));
    const V y = hn::ConvertTo(df, hn::ShiftRight<16>(xy));
    const V z = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(zp)));
    V eye[3];
    for (std::size_t i = 0; i < 3; ++i) {
      eye[i] = hn::MulAdd(m[i][0], x, hn::MulAdd(m[i][1], y, hn::MulAdd(m[i][2], z, t[i])));
    }
    const V scale = hn::Div(h, eye[2]);
    const auto sx = hn::ConvertTo(d, hn::MulAdd(eye[0], scale, ofx));
    const auto sy = hn::ConvertTo(d, hn::MulAdd(eye[1], scale, ofy));
    // Saturated to 16 bits, then x and y side by side.
    const auto xxyy = hn::ReorderDemote2To(d16, sx, sy);
    const auto packed = hn::TableLookupBytes(hn::BitCast(d8, xxyy), hn::LoadDup128(d8, xyxy));
    hn::StoreU(hn::BitCast(d16, packed), d16, reinterpret_cast<std::int16_t*>(sxy + at));
    hn::StoreU(hn::DemoteTo(du16, hn::ConvertTo(d, eye[2])), du16, sz + at);
  }
}
FloatProject door() { return project; }
#else
FloatProject door() { return nullptr; }
#endif
}  // namespace bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bench {
HWY_EXPORT(door);

FloatProject float_project(std::string_view target) {
  FloatProject found = nullptr;
  for (const std::int64_t each : hwy::SupportedAndGeneratedTargets()) {
    const std::string_view name = each == HWY_AVX3 ? "AVX-512" : hwy::TargetName(each);
    if (name != target) continue;
    hwy::SetSupportedTargetsForTest(each);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    found = HWY_DYNAMIC_DISPATCH(door)();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return found;
}
}  // namespace bench
#endif
