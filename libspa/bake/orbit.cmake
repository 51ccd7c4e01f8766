# SPDX-License-Identifier: Apache-2.0
# The orbit baker and its OpenGL contexts: spa::orbit.
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(TBB REQUIRED)
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h)
find_library(OSMESA_LIBRARY OSMesa)
mark_as_advanced(OSMESA_INCLUDE_DIR OSMESA_LIBRARY)

set(orbit_shaders ${CMAKE_CURRENT_LIST_DIR}/shaders)
file(READ ${orbit_shaders}/orbit_common.glsl ORBIT_COMMON)
file(READ ${orbit_shaders}/orbit.vert ORBIT_VERT)
file(READ ${orbit_shaders}/orbit.frag ORBIT_FRAG)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${orbit_shaders}/orbit_common.glsl
  ${orbit_shaders}/orbit.vert ${orbit_shaders}/orbit.frag)
configure_file(${CMAKE_CURRENT_LIST_DIR}/orbit_shaders.h.in ${CMAKE_CURRENT_BINARY_DIR}/orbit/orbit_shaders.h @ONLY)

spa_library(orbit gl_context.cpp gl_egl.cpp gl_functions.cpp gl_objects.cpp gl_osmesa.cpp orbit.cpp
  orbit_batches.cpp orbit_culling.cpp orbit_naive.cpp orbit_scene.cpp orbit_tiles.cpp)
target_include_directories(spa_orbit PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/orbit)
target_link_libraries(spa_orbit PUBLIC spa::core spa::mesh PRIVATE OpenGL::EGL TBB::tbb)
if(OSMESA_INCLUDE_DIR AND OSMESA_LIBRARY)
  # Loaded on demand (gl_osmesa.cpp), under the name that a linked program would ask for.
  file(REAL_PATH ${OSMESA_LIBRARY} osmesa_file)
  cmake_path(GET osmesa_file FILENAME osmesa_name)
  string(REGEX REPLACE "(\\.so\\.[0-9]+).*" "\\1" osmesa_soname ${osmesa_name})
  target_compile_definitions(spa_orbit PRIVATE SPA_HAVE_OSMESA SPA_OSMESA_SONAME="${osmesa_soname}")
  target_include_directories(spa_orbit SYSTEM PRIVATE ${OSMESA_INCLUDE_DIR})
  target_link_libraries(spa_orbit PRIVATE ${CMAKE_DL_LIBS})
else()
  message(STATUS "OSMesa not found: the orbit baker runs on EGL alone")
endif()
