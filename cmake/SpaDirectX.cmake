# SPDX-License-Identifier: Apache-2.0
# SPA_DIRECTX_INCLUDE_DIRS: where Direct3D 12's headers are. On Windows the SDK's do, or the DirectX-Headers package's;
# elsewhere it takes the package, with its folder wsl/stubs.
find_path(SPA_DIRECTX_INCLUDE_DIR directx/d3d12.h)
find_path(SPA_DIRECTX_STUBS_DIR unknwn.h PATH_SUFFIXES wsl/stubs)
mark_as_advanced(SPA_DIRECTX_INCLUDE_DIR SPA_DIRECTX_STUBS_DIR)
set(SPA_DIRECTX_INCLUDE_DIRS)
if(WIN32)
  set(SPA_DIRECTX_FOUND TRUE)
elseif(SPA_DIRECTX_INCLUDE_DIR AND SPA_DIRECTX_STUBS_DIR)
  set(SPA_DIRECTX_FOUND TRUE)
  list(APPEND SPA_DIRECTX_INCLUDE_DIRS ${SPA_DIRECTX_STUBS_DIR})
else()
  set(SPA_DIRECTX_FOUND FALSE)
endif()
if(SPA_DIRECTX_INCLUDE_DIR)
  list(APPEND SPA_DIRECTX_INCLUDE_DIRS ${SPA_DIRECTX_INCLUDE_DIR})
endif()
