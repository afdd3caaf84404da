# As -DCMAKE_TOOLCHAIN_FILE: the compiler of this machine, and otter-sdk.cmake behind the project() command.
set(CMAKE_PROJECT_INCLUDE ${CMAKE_CURRENT_LIST_DIR}/otter-sdk.cmake)
