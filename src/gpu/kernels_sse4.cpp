// The kernels of processors with SSE4.2.

#include "gpu/highway_baseline.h"
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX2 | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gpu/kernels_sse4.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "gpu/kernel_targets.h"

#if HWY_TARGET == HWY_SSE4
#include "gpu/kernels-inl.h"
#endif

#if HWY_ONCE
namespace gpu {
#if HWY_TARGETS & HWY_SSE4
const TargetKernels* sse4_kernels() { return &N_SSE4::kernels; }
#else
const TargetKernels* sse4_kernels() { return nullptr; }
#endif
}  // namespace gpu
#endif
