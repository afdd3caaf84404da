// The kernels of any processor, and the bodies that draw one pixel after the other.

#include "gpu/highway_baseline.h"
#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include "gpu/kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gpu::HWY_NAMESPACE {

using OnePixel = hn::CappedTag<std::int32_t, 1>;

void in_order(const Mode& mode, const Job& job, std::span<const Span> spans) {
  draw_spans(OnePixel(), mode, job, spans, Unwatched());
}

void watched(const Mode& mode, const Job& job, std::span<const Span> spans, const Watch& watch) {
  draw_spans(OnePixel(), mode, job, spans, Watched{watch});
}

}  // namespace gpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace gpu {

const TargetKernels* scalar_kernels() { return &HWY_NAMESPACE::kernels; }

void draw_in_order(const Mode& mode, const Job& job, std::span<const Span> spans) {
  HWY_NAMESPACE::in_order(mode, job, spans);
}

void draw_watched(const Mode& mode, const Job& job, std::span<const Span> spans, const Watch& watch) {
  HWY_NAMESPACE::watched(mode, job, spans, watch);
}

}  // namespace gpu
