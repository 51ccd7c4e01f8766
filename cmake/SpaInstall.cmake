# SPDX-License-Identifier: Apache-2.0
# What a program that only loads `.spa` files needs (component "development": spa::core, spa::container,
# their headers, find_package and pkg-config files) and the command (component "tools").
# Users write #include <libspa/core/...> and <formats/container/...>, as the source tree is laid out, so
# that the headers' own relative includes hold. What only the sources include is not installed.
include(CMakePackageConfigHelpers)

set(spa_exported_targets spa_core spa_container)
set(spa_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spa)

foreach(target IN LISTS spa_exported_targets)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/spa>)
endforeach()

install(TARGETS ${spa_exported_targets} EXPORT spaTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT spaTargets NAMESPACE spa:: DESTINATION ${spa_package_dir} COMPONENT development)
set(core_headers direction_map.h element_format.h error.h spherical_map.h vector.h)
set(container_headers check.h format.h limits.h reader.h source.h status.h writer.h)
list(TRANSFORM core_headers PREPEND libspa/core/)
list(TRANSFORM container_headers PREPEND formats/container/)
install(FILES ${core_headers}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/core COMPONENT development)
install(FILES ${container_headers}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/formats/container COMPONENT development)

configure_package_config_file(cmake/spaConfig.cmake.in ${PROJECT_BINARY_DIR}/spaConfig.cmake
  INSTALL_DESTINATION ${spa_package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spaConfig.cmake ${PROJECT_BINARY_DIR}/spaConfigVersion.cmake
  DESTINATION ${spa_package_dir} COMPONENT development)

# From the folder of spa.pc up to the prefix.
file(RELATIVE_PATH spa_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/spa.pc.in ${PROJECT_BINARY_DIR}/spa.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/spa.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(FILES LICENSE formats/SPA.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
if(TARGET spa)
  install(TARGETS spa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
endif()
