// SPDX-License-Identifier: Apache-2.0
// Rest pose: morph targets with their default weights and skins with the joints where the nodes put them.
#pragma once

#include "../../libspa/mesh/model.h"
#include "gltf_scene.h"

#include <span>
#include <string>
#include <vector>

namespace spa::import::gltf {

// The node's weights, else the mesh's, else none.
std::span<const double> morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node);

// values += sum of weight * target attribute. `attribute`: POSITION or NORMAL; `subset`: as in read_floats.
void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       std::span<const double> weights, const std::string& attribute, Buffers& buffers,
                       std::span<const std::uint32_t> subset, std::span<Vec3f> values,
                       const Context& context);

// What every joint has its vertices moved by before its own transform; the identity where the file has none.
std::vector<Affine> inverse_bind_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                          Buffers& buffers, const Context& context);

// jointGlobal * inverseBind of every joint (glTF 2.0, 3.7.3.3).
std::vector<Affine> joint_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                   std::span<const Affine> globals, Buffers& buffers, const Context& context);

// The weights of one vertex over the joints: `sets` JOINTS_n and WEIGHTS_n of four each, vertex after vertex.
struct VertexWeights {
    std::size_t sets = 0;
    std::vector<std::uint32_t> joints;
    std::vector<float> weights;

    // The map of a vertex: weights normalised; `unweighted` for a vertex without weights.
    [[nodiscard]] Affine blend(std::size_t vertex, std::span<const Affine> joints_of_skin,
                               const Affine& unweighted) const;
};

// Throws Error for a joint that the skin has not.
void check_weights(const VertexWeights& weights, std::size_t joints, const std::string& where,
                   const Context& context);

} // namespace spa::import::gltf
