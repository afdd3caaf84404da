otter_bench(frames LIBRARIES demos SOURCES frames.cpp)
