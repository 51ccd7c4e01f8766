// SPDX-License-Identifier: Apache-2.0
// tinygltf without its own decoders and file access. Always include it through this header: the macros must
// be the same everywhere. The namespace is renamed because Debian's libdraco carries a tinygltf of another
// layout under the original name, and the linker would mix the two.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define tinygltf spa_import_tinygltf // NOLINT(readability-identifier-naming)

#include <tiny_gltf.h>
