# As -DCMAKE_TOOLCHAIN_FILE: the compiler of this machine, and otter-sdk.cmake behind the project() command; not behind
# those of the little projects that CMake tries compilers with.
get_property(otter_sdk_is_trial GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT otter_sdk_is_trial)
  set(CMAKE_PROJECT_INCLUDE ${CMAKE_CURRENT_LIST_DIR}/otter-sdk.cmake)
endif()
