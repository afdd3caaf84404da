otter_bench(inspect LIBRARIES inspect SOURCES inspect.cpp)
