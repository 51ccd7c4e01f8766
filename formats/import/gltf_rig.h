// SPDX-License-Identifier: Apache-2.0
// Scene::rig: the vertices before their bones move them, gathered drawing by drawing.
#pragma once

#include "../../libspa/mesh/scene.h"
#include "gltf_skin.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::import::gltf {

// What a vertex of a rig takes beside its influences, and each of those.
inline constexpr std::uint64_t rig_vertex_bytes = 28, influence_bytes = sizeof(Influence);

// A drawing's vertices before they are posed.
struct Unposed {
    std::vector<Vec3f> positions, normals; // no normals: the drawing has none
    std::optional<VertexWeights> weights;  // of a skinned drawing
};

// What became of them.
struct Finished {
    const Model& model;
    std::size_t base = 0;                  // the first vertex in the model
    std::span<const std::uint32_t> from{}; // by vertex from `base` on: which it was, plus base; empty: all
    std::span<const std::uint32_t> computed{}; // ascending: vertices of the model whose normals are computed
};

class RigBuilder {
public:
    RigBuilder(const tinygltf::Model& model, Buffers& buffers, Rig& rig, const Context& context)
        : model_(model), buffers_(buffers), rig_(rig), context_(context) {}

    // Appends the vertices of a drawing, which the model has now. `joints`: the matrices of the skin. Throws
    // Error(invalid_data) for weights that are too large once they sum to 1.
    void append(const Instance& instance, const Unposed& unposed, std::span<const Affine> joints,
                const Finished& finished, const std::string& where);

    // After the last drawing: places for the joints that the scene does not list.
    void finish(std::vector<Place>& places);

private:
    std::uint32_t node_bone(std::uint32_t place);
    std::uint32_t first_joint(int skin); // the bone of joint 0
    void add_influences(const VertexWeights& weights, std::size_t vertex, std::uint32_t first,
                        std::uint32_t place, const std::string& where);

    const tinygltf::Model& model_;
    Buffers& buffers_;
    Rig& rig_; // until finish(): the bones of skins have the node in the file
    const Context& context_;
    std::map<int, std::uint32_t> skins_;           // by skin: its first bone
    std::map<std::uint32_t, std::uint32_t> nodes_; // by place
};

} // namespace spa::import::gltf
