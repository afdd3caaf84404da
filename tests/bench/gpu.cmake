otter_bench(gpu
  LIBRARIES gpu
  SOURCES gpu.cpp)
