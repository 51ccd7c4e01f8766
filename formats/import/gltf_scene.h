// SPDX-License-Identifier: Apache-2.0
// The node hierarchy flattened: which meshes are drawn, and where.
#pragma once

#include "../../libspa/core/rotation.h"
#include "../../libspa/mesh/model.h"
#include "gltf_accessor.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::import::gltf {

struct Instance {
    std::size_t node = 0; // has a mesh
    Affine world;
    std::uint32_t place = 0; // index into the places
};

// Where a node stands in the scene, or one of its instances.
struct Place {
    enum class Kind : std::uint8_t {
        node,
        instance, // of EXT_mesh_gpu_instancing; `parent` is then the node's own place
        outside,  // a node that the scene does not list, but joints need
    };
    std::size_t node = 0;
    std::uint32_t parent = no_index; // index into the places
    Affine world, local{};           // local: to the parent
    Kind kind = Kind::node;
};

// What a node without a matrix says of its local transform.
struct LocalParts {
    Vec3d translation, scale{1, 1, 1};
    Quaternion rotation;
};
LocalParts local_parts(const tinygltf::Node& node);

// Every drawing of a mesh in the default scene (the first scene if none is the default, all root nodes if
// there are no scenes), EXT_mesh_gpu_instancing included, in the order of the hierarchy. A node with several
// parents is drawn below each; a node that the scene lists below another listed one is drawn once. Throws
// Error if shared children multiply beyond all measure. The document passed check_nodes. `places`, if given,
// gets all nodes of the scene, those without meshes too, parents first.
std::vector<Instance> flatten_scene(const tinygltf::Model& model, Buffers& buffers, const Context& context,
                                    std::vector<Place>* places = nullptr);

// The node that has each node as its child, the first if there are several; no_index: none.
std::vector<std::uint32_t> first_parents(const tinygltf::Model& model);

// The global transform of every node, along its first parent.
std::vector<Affine> global_transforms(const tinygltf::Model& model);

// The places where the nodes `wanted` stand along their first parents, as global_transforms has them; those
// that are not in the scene are appended, with the nodes above them.
std::vector<std::uint32_t> place_along_first_parents(const tinygltf::Model& model,
                                                     std::span<const std::uint32_t> wanted,
                                                     std::vector<Place>& places);

} // namespace spa::import::gltf
