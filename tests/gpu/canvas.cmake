otter_suite(canvas
  LIBRARIES gpu
  SOURCES
    canvas_antialias.cpp
    canvas_attributes.cpp
    canvas_console.cpp
    canvas_mips.cpp
    canvas_seams.cpp)
