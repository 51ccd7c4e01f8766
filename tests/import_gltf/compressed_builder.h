// SPDX-License-Identifier: Apache-2.0
// Small glTF documents with compressed geometry, encoded by the libraries' own encoders.
#pragma once

#include "gltf_builder.h"

#include <vector>

namespace spa::test {

// Puts the encoded bytes behind view `view`, whose own range moves to a fallback buffer without data.
void compress(GltfBuilder& builder, int view, const std::vector<unsigned char>& encoded, std::size_t count,
              std::size_t stride, const char* mode, const char* filter = "NONE");

// Two triangles by EXT_meshopt_compression: positions 12 bytes a vertex, indices as TRIANGLES or INDICES.
GltfBuilder meshopt_quad(bool triangles);

// The document with the second, empty buffer that compress() refers to. Call it when everything is added: the
// first buffer's length is not known before.
GltfBuilder with_fallback_buffer(GltfBuilder builder);

// A grid of n x n quads with heights by KHR_draco_mesh_compression.
GltfBuilder draco_grid(int n, bool sequential);

} // namespace spa::test
