// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace spa::import::gltf {

struct MeshoptView {
    std::size_t count = 0, stride = 0;
    std::string mode;   // ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; // NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

// The count * stride decoded bytes; an empty vector for damaged data. Wants a view that passed
// check_buffer_views, so what it allocates is in proportion to the encoded bytes.
std::vector<std::byte> decode_meshopt(const MeshoptView& view, std::span<const std::byte> encoded);

} // namespace spa::import::gltf
