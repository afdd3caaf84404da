// No include guard, and before Highway: what every file of kernels tells it.

#if defined(__x86_64__)
// The baseline is plain code: SCALAR whatever the compiler. Without the second line Highway would take EMU128
// for it under Clang, and find no baseline among its targets.
#define HWY_BASELINE_TARGETS HWY_SCALAR
#define HWY_BROKEN_EMU128 1
#endif
