// SPDX-License-Identifier: Apache-2.0
// The node hierarchy flattened: which meshes are drawn, and where.
#pragma once

#include "../../libspa/core/affine.h"
#include "../../libspa/mesh/model.h"
#include "gltf_accessor.h"

#include <cstdint>
#include <vector>

namespace spa::import::gltf {

struct Instance {
    std::size_t node = 0; // has a mesh
    Affine world;
    std::uint32_t place = 0; // index into the places
};

// Where a node stands in the scene, or one of its instances.
struct Place {
    std::size_t node = 0;
    std::uint32_t parent = no_index; // index into the places
    Affine world;
    bool is_instance = false; // of EXT_mesh_gpu_instancing; `parent` is then the node's own place
};

// Every drawing of a mesh in the default scene (the first scene if none is the default, all root nodes if
// there are no scenes), EXT_mesh_gpu_instancing included, in the order of the hierarchy. A node with several
// parents is drawn below each; a node that the scene lists below another listed one is drawn once. Throws
// Error if shared children multiply beyond all measure. The document passed check_nodes. `places`, if given,
// gets all nodes of the scene, those without meshes too, parents first.
std::vector<Instance> flatten_scene(const tinygltf::Model& model, Buffers& buffers, const Context& context,
                                    std::vector<Place>* places = nullptr);

// The global transform of every node, along its first parent.
std::vector<Affine> global_transforms(const tinygltf::Model& model);

} // namespace spa::import::gltf
