// The kernels of processors with AVX-512 (F, BW, CD, DQ, VL).

#include "gpu/highway_baseline.h"
#define HWY_DISABLED_TARGETS (HWY_AVX2 | HWY_SSE4 | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gpu/kernels_avx512.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "gpu/kernel_targets.h"

#if HWY_TARGET == HWY_AVX3
#include "gpu/kernels-inl.h"
#endif

#if HWY_ONCE
namespace gpu {
#if HWY_TARGETS & HWY_AVX3
const TargetKernels* avx512_kernels() { return &N_AVX3::kernels; }
#else
const TargetKernels* avx512_kernels() { return nullptr; }
#endif
}  // namespace gpu
#endif
