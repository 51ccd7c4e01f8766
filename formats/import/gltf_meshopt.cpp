// SPDX-License-Identifier: Apache-2.0
#include "gltf_meshopt.h"

#include <meshoptimizer.h>

namespace spa::import::gltf {

std::vector<std::byte> decode_meshopt(const MeshoptView& view, std::span<const std::byte> encoded) {
    std::vector<std::byte> decoded(view.count * view.stride);
    const auto* source = reinterpret_cast<const unsigned char*>(encoded.data());
    int status = -1;
    if (view.mode == "ATTRIBUTES")
        status = meshopt_decodeVertexBuffer(decoded.data(), view.count, view.stride, source, encoded.size());
    else if (view.mode == "TRIANGLES")
        status = meshopt_decodeIndexBuffer(decoded.data(), view.count, view.stride, source, encoded.size());
    else
        status = meshopt_decodeIndexSequence(decoded.data(), view.count, view.stride, source, encoded.size());
    if (status != 0) return {};

    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
    return decoded;
}

} // namespace spa::import::gltf
