# cmake --install: the program, and the libraries that other projects use through find_package(otter).
include(CMakePackageConfigHelpers)

install(TARGETS build_flags base gte ot gpu exact inspect EXPORT otter-targets)
install(EXPORT otter-targets NAMESPACE otter:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
foreach(folder IN ITEMS gte ot src/base src/gpu src/exact src/inspect)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/otter
          FILES_MATCHING PATTERN "*.h")
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/otter-config.cmake.in ${CMAKE_BINARY_DIR}/otter-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/otter-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/otter-config.cmake ${CMAKE_BINARY_DIR}/otter-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/otter)
