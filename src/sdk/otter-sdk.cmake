# Programs written for the console's SDK, built to run here.
#
#   find_package(otter COMPONENTS sdk)
#   otter_add_program(name main.c ... [INCBIN symbol=file ...])
#
# or, for an unmodified project of PSn00bSDK, the same functions under its names:
#
#   cmake -S PROJECT -B build -DCMAKE_PROJECT_INCLUDE=/where/otter/is/otter-sdk.cmake
#   cmake -S PROJECT -B build -DCMAKE_TOOLCHAIN_FILE=/where/otter/is/otter-sdk-toolchain.cmake      # the same
#
# A program is linked at 10000h without position independence, so that 24-bit links hold the addresses of its static
# data; its objects get a heap in static storage and the console's random numbers in place of the system's.
include_guard(GLOBAL)

enable_language(C)
enable_language(CXX)

if(NOT TARGET otter::sdk-program)
  find_package(otter REQUIRED COMPONENTS sdk HINTS ${CMAKE_CURRENT_LIST_DIR})
endif()

# otter_sdk_program(name): what an executable's sources need to be compiled and linked as a program.
function(otter_sdk_program name)
  target_include_directories(${name} BEFORE PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/include)
  target_compile_options(${name} PRIVATE -g -fno-pie -fwrapv -fno-strict-aliasing
    $<$<COMPILE_LANGUAGE:C>:-std=gnu11>)
  target_link_options(${name} PRIVATE -no-pie -Wl,-Ttext-segment=0x10000 -Wl,--wrap=main)
  target_link_libraries(${name} PRIVATE otter::sdk-program)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF LINKER_LANGUAGE CXX)
  foreach(language IN ITEMS C CXX)  # `;` only before a launcher there is: an empty one would be run as a command
    set(launcher ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/otter-sdk-compile ${CMAKE_${language}_COMPILER_LAUNCHER})
    set_target_properties(${name} PROPERTIES ${language}_COMPILER_LAUNCHER "${launcher}")
  endforeach()
endfunction()

# otter_sdk_incbin(target scope symbol size file): a file as data, 8-byte aligned: `symbol`, `symbol`_end and its length.
function(otter_sdk_incbin target scope symbol size file)
  get_filename_component(path ${file} ABSOLUTE)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.${symbol}.c)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
__asm__(".section .data\n.balign 8\n.global @symbol@\n@symbol@: .incbin \"@path@\"\n"
        ".global @symbol@_end\n@symbol@_end:\n.balign 4\n"
        ".global @size@\n@size@: .int @symbol@_end - @symbol@\n.previous");
]])
  set_property(SOURCE ${source} APPEND PROPERTY OBJECT_DEPENDS ${path})
  target_sources(${target} ${scope} ${source})
endfunction()

# otter_add_program(name source... [INCBIN symbol=file...]): an executable `name` that runs here.
function(otter_add_program name)
  cmake_parse_arguments(PARSE_ARGV 1 program "" "" "INCBIN")
  add_executable(${name} ${program_UNPARSED_ARGUMENTS})
  otter_sdk_program(${name})
  foreach(pair IN LISTS program_INCBIN)
    string(REGEX MATCH "^([^=]+)=(.+)$" _ ${pair})
    otter_sdk_incbin(${name} PRIVATE ${CMAKE_MATCH_1} ${CMAKE_MATCH_1}_size ${CMAKE_MATCH_2})
  endforeach()
endfunction()

# ---- the names that projects of PSn00bSDK use

# psn00bsdk_add_executable(name GPREL|NOGPREL|DYNAMIC source...)
function(psn00bsdk_add_executable name type)
  add_executable(${name} ${ARGN})
  otter_sdk_program(${name})
  target_compile_options(${name} PRIVATE -w)  # a foreign program's warnings are its own
endfunction()

# psn00bsdk_add_library(name STATIC|OBJECT|SHARED|MODULE source...): shared ones become static, too.
function(psn00bsdk_add_library name type)
  if(type STREQUAL "OBJECT")
    add_library(${name} OBJECT ${ARGN})
  else()
    add_library(${name} STATIC ${ARGN})
  endif()
  otter_sdk_program(${name})
  target_compile_options(${name} PRIVATE -w)
endfunction()

# psn00bsdk_target_incbin(target scope symbol file)
function(psn00bsdk_target_incbin target scope symbol file)
  otter_sdk_incbin(${target} ${scope} ${symbol} ${symbol}_size ${file})
endfunction()

# psn00bsdk_target_incbin_a(target scope symbol size_symbol file section align)
function(psn00bsdk_target_incbin_a target scope symbol size file)
  otter_sdk_incbin(${target} ${scope} ${symbol} ${size} ${file})
endfunction()

# There is no disc: the target exists and does nothing.
function(psn00bsdk_add_cd_image name)
  add_custom_target(${name})
endfunction()
