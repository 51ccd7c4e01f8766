// SPDX-License-Identifier: Apache-2.0
// The one place where tinygltf's functions are compiled.
#include <fstream> // tiny_gltf.h lacks it

#define TINYGLTF_IMPLEMENTATION
#include "tinygltf.h"
