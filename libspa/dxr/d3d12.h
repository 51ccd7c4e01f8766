// SPDX-License-Identifier: Apache-2.0
// Direct3D 12's declarations: of the DirectX-Headers package where it is there, else of the Windows SDK. On
// Linux the package brings its own stand-ins for Windows' types; with them the loader compiles and its tests
// run, though no device there can be given to it.
#pragma once

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>
// MinGW-w64 says that its RPC headers are older than the MIDL compiler that wrote d3d12.h; they do.
#if defined(__MINGW32__) && !defined(__REQUIRED_RPCNDR_H_VERSION__)
#define __REQUIRED_RPCNDR_H_VERSION__ 475
#endif
#else
#include <wsl/winadapter.h>
#endif

#if __has_include(<directx/d3d12.h>)
#include <directx/d3d12.h>
#else
#include <d3d12.h>
#endif
