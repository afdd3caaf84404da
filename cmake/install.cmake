# cmake --install: the program, and the libraries that other projects use through find_package(otter).
include(CMakePackageConfigHelpers)

install(TARGETS build_flags base gte ot gpu exact inspect EXPORT otter-targets)
install(EXPORT otter-c-targets NAMESPACE otter:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
install(EXPORT otter-targets NAMESPACE otter:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
# The headers that other projects may include, and with them those that they include; all others may change at any time.
# tests/consumer/run compiles all.
set(public_headers
  base/result.h
  gte/batch.h gte/check.h gte/commands.h gte/divide.h gte/limits.h
  ot/command_stream.h ot/describe.h ot/dma.h ot/gp0.h ot/gp1.h ot/main_ram.h ot/ordering_table.h ot/packet.h
  ot/sort.h ot/walker.h
  gpu/canvas/canvas.h gpu/canvas/resolve.h gpu/canvas/sample_pattern.h gpu/gpu.h
  exact/depth_order.h
  inspect/check.h inspect/history.h inspect/json.h inspect/maps.h inspect/report.h inspect/truth.h)
set(installed_headers)
while(public_headers)
  list(POP_FRONT public_headers header)
  list(APPEND installed_headers ${header})
  find_file(path ${header} PATHS ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src NO_DEFAULT_PATH NO_CACHE REQUIRED)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${path} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/otter/${folder})
  file(STRINGS ${path} included REGEX "^#include \"")
  list(TRANSFORM included REPLACE "^#include \"([^\"]+)\".*" "\\1")
  list(APPEND public_headers ${included})
  list(REMOVE_DUPLICATES public_headers)
  list(REMOVE_ITEM public_headers ${installed_headers})
  unset(path)
endwhile()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/otter-config.cmake.in ${CMAKE_BINARY_DIR}/otter-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/otter-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/otter-config.cmake ${CMAKE_BINARY_DIR}/otter-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)

install(FILES ${CMAKE_BINARY_DIR}/otter-config.cmake ${CMAKE_BINARY_DIR}/otter-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter COMPONENT sdk EXCLUDE_FROM_ALL)

# (cd build/release && cpack): one Debian package with the program, the libraries and their headers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME otter)
set(CPACK_PACKAGE_CONTACT "The maintainers of Otter <otter@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
include(CPack)
