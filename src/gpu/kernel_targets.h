#pragma once
// Inside kernels.h: what each dispatch target brings.

#include <cstdint>

#include "gpu/kernels.h"

namespace gpu {

struct TargetKernels {
  std::int64_t id;  ///< one bit: how Highway numbers it
  const KernelTable& table;
  const Operations& operations;
};

/// nullptr where this build has none.
const TargetKernels* avx512_kernels();
const TargetKernels* avx2_kernels();
const TargetKernels* sse4_kernels();
/// Plain code, to compare with and to fall back on.
const TargetKernels* scalar_kernels();

}  // namespace gpu
