# SPDX-License-Identifier: Apache-2.0
# What a program needs that loads `.spa` files (component "development": spa::core, spa::container and
# spa::trace_map), traces them on the CPU (spa::trace, if it was built: find_package(spa COMPONENTS trace), pkg-config
# spa-trace), on a Vulkan device (spa::vulkan: COMPONENTS vulkan, pkg-config spa-vulkan) or a Direct3D 12 one
# (spa::dxr, the same way), with headers, find_package and pkg-config files; and the command (component "tools").
# Users write #include <libspa/core/...> and <formats/container/...>, as the source tree is laid out, so
# that the headers' own relative includes hold. What only the sources include is not installed.
include(CMakePackageConfigHelpers)

set(spa_exported_targets spa_core spa_container spa_trace_map)
set(spa_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spa)
foreach(target IN ITEMS spa_trace spa_vulkan spa_dxr)
  if(TARGET ${target})
    list(APPEND spa_optional_targets ${target})
  endif()
endforeach()

foreach(target IN LISTS spa_exported_targets spa_optional_targets)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/spa>)
endforeach()

install(TARGETS ${spa_exported_targets} EXPORT spaTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT spaTargets NAMESPACE spa:: DESTINATION ${spa_package_dir} COMPONENT development)
set(core_headers affine.h direction_map.h element_format.h error.h spherical_map.h vector.h)
set(container_headers check.h format.h limits.h reader.h source.h status.h writer.h)
list(TRANSFORM core_headers PREPEND libspa/core/)
list(TRANSFORM container_headers PREPEND formats/container/)
set(trace_map_headers packed_images.h ray.h space.h trace_map.h)
list(TRANSFORM trace_map_headers PREPEND libspa/trace/)
install(FILES ${trace_map_headers}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/trace COMPONENT development)
install(FILES ${core_headers}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/core COMPONENT development)
install(FILES ${container_headers}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/formats/container COMPONENT development)

# Apart, so that who only loads files needs neither Highway nor oneTBB.
if(TARGET spa_trace)
  install(TARGETS spa_trace EXPORT spaTraceTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spaTraceTargets NAMESPACE spa:: DESTINATION ${spa_package_dir} COMPONENT development)
  set(trace_headers fan.h march.h scene.h shade.h trace.h)
  list(TRANSFORM trace_headers PREPEND libspa/trace/)
  install(FILES ${trace_headers}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/trace COMPONENT development)
endif()
# Apart, so that who only loads files needs no Vulkan headers.
if(TARGET spa_vulkan)
  install(TARGETS spa_vulkan EXPORT spaVulkanTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spaVulkanTargets NAMESPACE spa:: DESTINATION ${spa_package_dir} COMPONENT development)
  set(vulkan_headers acceleration_structure.h allocator.h buffer.h device.h functions.h hit_group.h map_object.h
    submit.h top_level.h)
  list(TRANSFORM vulkan_headers PREPEND libspa/vulkan/)
  install(FILES ${vulkan_headers}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/vulkan COMPONENT development)
endif()
# And no Direct3D ones; the package that finds the library finds those.
if(TARGET spa_dxr)
  install(TARGETS spa_dxr EXPORT spaDxrTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spaDxrTargets NAMESPACE spa:: DESTINATION ${spa_package_dir} COMPONENT development)
  install(FILES cmake/SpaDirectX.cmake DESTINATION ${spa_package_dir} COMPONENT development)
  set(dxr_headers com.h d3d12.h hit_group.h map_object.h)
  list(TRANSFORM dxr_headers PREPEND libspa/dxr/)
  install(FILES ${dxr_headers}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/libspa/dxr COMPONENT development)
endif()
# The tracing text and the stages that use it.
install(DIRECTORY shaders/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spa/shaders COMPONENT development
  FILES_MATCHING PATTERN "spa_*.h" PATTERN "spa*.glsl" PATTERN "spa*.hlsl" PATTERN "spa.r*")

configure_package_config_file(cmake/spaConfig.cmake.in ${PROJECT_BINARY_DIR}/spaConfig.cmake
  INSTALL_DESTINATION ${spa_package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spaConfig.cmake ${PROJECT_BINARY_DIR}/spaConfigVersion.cmake
  DESTINATION ${spa_package_dir} COMPONENT development)

# From the folder of spa.pc up to the prefix.
file(RELATIVE_PATH spa_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(spa_packages spa)
foreach(target IN LISTS spa_optional_targets)
  string(REPLACE _ - package ${target})
  list(APPEND spa_packages ${package})
endforeach()
foreach(package IN LISTS spa_packages)
  configure_file(cmake/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${package}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()

install(FILES LICENSE formats/SPA.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
if(TARGET spa)
  install(TARGETS spa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
endif()
