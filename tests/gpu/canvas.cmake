otter_suite(canvas
  LIBRARIES gpu
  SOURCES
    canvas_console.cpp
    canvas_seams.cpp)
