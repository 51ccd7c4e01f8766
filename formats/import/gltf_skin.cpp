// SPDX-License-Identifier: Apache-2.0
#include "gltf_skin.h"

#include <array>
#include <cmath>

namespace spa::import::gltf {

std::span<const double> morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node) {
    return node.weights.empty() ? mesh.weights : node.weights;
}

void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       std::span<const double> weights, const std::string& attribute, Buffers& buffers,
                       std::span<const std::uint32_t> subset, std::span<Vec3f> values,
                       const Context& context) {
    std::vector<Vec3f> delta;
    for (std::size_t i = 0; i < std::min(weights.size(), primitive.targets.size()); ++i) {
        const auto found = primitive.targets[i].find(attribute);
        if (weights[i] == 0.0 || found == primitive.targets[i].end()) continue;
        delta.resize(values.size());
        read_floats(model.accessors[static_cast<std::size_t>(found->second)], buffers, subset, 3, &delta[0].x,
                    3, context);
        const auto weight = static_cast<float>(weights[i]);
        for (std::size_t v = 0; v < values.size(); ++v) values[v] = values[v] + delta[v] * weight;
    }
}

std::vector<Affine> inverse_bind_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                          Buffers& buffers, const Context& context) {
    std::vector<Affine> matrices(skin.joints.size());
    if (skin.inverseBindMatrices < 0) return matrices;
    // Only as many as there are joints: the accessor may hold more.
    std::vector<std::uint32_t> subset(skin.joints.size());
    for (std::size_t i = 0; i < subset.size(); ++i) subset[i] = static_cast<std::uint32_t>(i);
    std::vector<std::array<float, 16>> inverse_bind(skin.joints.size());
    read_floats(model.accessors[static_cast<std::size_t>(skin.inverseBindMatrices)], buffers, subset, 16,
                inverse_bind[0].data(), 16, context);
    for (std::size_t j = 0; j < matrices.size(); ++j) {
        const std::array<float, 16>& m = inverse_bind[j]; // column-major
        if (std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1.0F) > 1e-4F)
            warn(context, at("accessors", static_cast<std::size_t>(skin.inverseBindMatrices)),
                 "matrix " + std::to_string(j) + " is not affine: its last row is taken as 0 0 0 1");
        for (std::size_t i = 0; i < 3; ++i) matrices[j].linear.row[i] = {m[i], m[4 + i], m[8 + i]};
        matrices[j].translation = {m[12], m[13], m[14]};
    }
    return matrices;
}

std::vector<Affine> joint_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                   std::span<const Affine> globals, Buffers& buffers,
                                   const Context& context) {
    std::vector<Affine> matrices = inverse_bind_matrices(model, skin, buffers, context);
    for (std::size_t j = 0; j < matrices.size(); ++j)
        matrices[j] = globals[static_cast<std::size_t>(skin.joints[j])] * matrices[j];
    return matrices;
}

Affine VertexWeights::blend(std::size_t vertex, std::span<const Affine> joints_of_skin,
                            const Affine& unweighted) const {
    const std::size_t first = vertex * sets * 4;
    double sum = 0;
    for (std::size_t i = 0; i < sets * 4; ++i) sum += double(weights[first + i]);
    if (!(sum > 0)) return unweighted;
    Affine out{{{{}, {}, {}}}, {}};
    for (std::size_t i = 0; i < sets * 4; ++i) {
        if (weights[first + i] == 0.0F) continue;
        const double weight = double(weights[first + i]) / sum;
        const Affine& joint = joints_of_skin[joints[first + i]];
        for (std::size_t r = 0; r < 3; ++r)
            out.linear.row[r] = out.linear.row[r] + joint.linear.row[r] * weight;
        out.translation = out.translation + joint.translation * weight;
    }
    return out;
}

void check_weights(const VertexWeights& weights, std::size_t joints, const std::string& where,
                   const Context& context) {
    const std::size_t per_vertex = weights.sets * 4;
    for (std::size_t i = 0; i < weights.joints.size(); ++i)
        if (weights.joints[i] >= joints && weights.weights[i] != 0.0F)
            fail(context, where,
                 "vertex " + std::to_string(i / per_vertex) + " follows joint " +
                     std::to_string(weights.joints[i]) + ", the skin has " + std::to_string(joints));
}

} // namespace spa::import::gltf
