// SPDX-License-Identifier: Apache-2.0
// KHR_draco_mesh_compression: one primitive's indices and attributes.
#pragma once

#include "gltf_accessor.h"

#include <map>
#include <string>
#include <vector>

namespace spa::import::gltf {

struct DracoMesh {
    std::size_t vertices = 0;
    std::vector<std::uint32_t> indices;                    // three a triangle
    std::map<std::string, std::vector<std::byte>> storage; // of the attributes' elements
    std::map<std::string, Elements> attributes;            // by the name in the primitive
};

// Decodes the primitive's compressed mesh: Draco 2.2, as glTF exporters write it, without metadata. Throws
// Error(invalid_data) if it is damaged, is not of the size that the primitive's accessors say, which
// check_meshes and the limits have judged, or takes more than limits.model_bytes.
DracoMesh decode_draco(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Buffers& buffers,
                       const std::string& where, const Context& context);

} // namespace spa::import::gltf
