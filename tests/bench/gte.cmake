find_package(hwy REQUIRED)
otter_bench(gte LIBRARIES gte hwy::hwy SOURCES gte.cpp gte_float.cpp)
target_compile_definitions(bench_gte PRIVATE HWY_DISABLED_TARGETS=HWY_SSSE3)
