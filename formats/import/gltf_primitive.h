// SPDX-License-Identifier: Apache-2.0
// One drawing of one primitive, appended to the flat model: attributes, rest pose, transform, triangles.
#pragma once

#include "gltf_draco.h"
#include "gltf_material.h"
#include "gltf_rig.h"

#include <map>
#include <optional>
#include <string>

namespace spa::import::gltf {

// What drawing needs beside the instance.
struct Assembly {
    const tinygltf::Model& model;
    Buffers& buffers;
    Materials& materials;
    Model& out;
    const Context& context;
    std::vector<Affine> globals;              // of the nodes
    std::map<int, std::vector<Affine>> skins; // joint matrices, by skin, when first used
    std::map<std::pair<std::size_t, std::size_t>, DracoMesh> draco; // by mesh and primitive
    RigBuilder* rig = nullptr;                                      // null: no rig is wanted
};

// Points and lines: not drawn.
bool is_drawn(const tinygltf::Primitive& primitive);

// What a drawing adds at most, and how many vertices must be read for it: morph targets and sparse accessors
// are read in full. The limits are held against it.
struct Size {
    std::uint64_t vertices = 0, triangles = 0, reads = 0;
    std::uint64_t influences = 0; // of bones on vertices
};
Size size_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

// Appends the primitive `number` of the mesh of instance.node. Throws Error for indices out of range and
// damaged compressed data.
void append_primitive(Assembly& assembly, const Instance& instance, std::size_t number);

} // namespace spa::import::gltf
