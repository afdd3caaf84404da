otter_bench(ot LIBRARIES ot SOURCES ot.cpp)
