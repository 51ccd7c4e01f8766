// SPDX-License-Identifier: Apache-2.0
#include "gltf_rig.h"

#include <algorithm>
#include <cmath>

namespace spa::import::gltf {

std::uint32_t RigBuilder::node_bone(std::uint32_t place) {
    const auto [found, is_new] = nodes_.try_emplace(place, static_cast<std::uint32_t>(rig_.bones.size()));
    if (is_new) rig_.bones.push_back({place, no_index, 0, {}});
    return found->second;
}

std::uint32_t RigBuilder::first_joint(int skin) {
    const auto [found, is_new] = skins_.try_emplace(skin, static_cast<std::uint32_t>(rig_.bones.size()));
    if (!is_new) return found->second;
    const tinygltf::Skin& source = model_.skins[static_cast<std::size_t>(skin)];
    const std::vector<Affine> inverse_bind = inverse_bind_matrices(model_, source, buffers_, context_);
    for (std::size_t j = 0; j < source.joints.size(); ++j)
        rig_.bones.push_back({static_cast<std::uint32_t>(source.joints[j]), static_cast<std::uint32_t>(skin),
                              static_cast<std::uint32_t>(j), inverse_bind[j]});
    return found->second;
}

void RigBuilder::add_influences(const VertexWeights& weights, std::size_t vertex, std::uint32_t first,
                                std::uint32_t place, const std::string& where) {
    const std::size_t per_vertex = weights.sets * 4;
    const std::span shares = std::span(weights.weights).subspan(vertex * per_vertex, per_vertex);
    double sum = 0;
    for (const float share : shares) sum += double(share);
    const std::size_t before = rig_.influences.size();
    for (std::size_t i = 0; sum > 0 && i < per_vertex; ++i) {
        const auto weight = static_cast<float>(double(shares[i]) / sum);
        if (!std::isfinite(weight))
            fail(context_, where,
                 "vertex " + std::to_string(vertex) +
                     " has weights of both signs that cancel each other; make them positive");
        if (weight != 0) rig_.influences.push_back({first + weights.joints[vertex * per_vertex + i], weight});
    }
    if (rig_.influences.size() == before) rig_.influences.push_back({node_bone(place), 1});
}

void RigBuilder::append(const Instance& instance, const Unposed& unposed, std::span<const Affine> joints,
                        const Finished& finished, const std::string& where) {
    const std::size_t base = finished.base, count = finished.model.positions.size() - base;
    const int skin = model_.nodes[instance.node].skin;
    const std::uint32_t first = unposed.weights && count > 0 ? first_joint(skin) : 0;
    for (std::size_t v = 0; v < count; ++v) {
        const std::size_t source = finished.from.empty() ? v : finished.from[v] - base;
        rig_.first.push_back(static_cast<std::uint32_t>(rig_.influences.size()));
        rig_.positions.push_back(unposed.positions[source]);
        rig_.normals.push_back(
            unposed.normals.empty() ? Vec3f{} : to_float(normalize(to_double(unposed.normals[source]))));
        if (unposed.weights)
            add_influences(*unposed.weights, source, first, instance.place, where);
        else
            rig_.influences.push_back({node_bone(instance.place), 1});
    }
    // A normal that was computed from posed triangles goes back the way: posing takes n to a positive
    // multiple of the inverse transpose times n, so it came from the transpose times it.
    for (const std::uint32_t vertex : finished.computed) {
        const std::size_t v = vertex - base, source = finished.from.empty() ? v : finished.from[v] - base;
        const Affine map =
            unposed.weights ? unposed.weights->blend(source, joints, instance.world) : instance.world;
        const Vec3d normal = to_double(finished.model.normals[vertex]);
        const Vec3d back = normalize(transpose(map.linear) * normal);
        rig_.normals[vertex] = to_float(is_finite(back) && !(back == Vec3d{}) ? back : normal);
    }
}

void RigBuilder::finish(std::vector<Place>& places) {
    rig_.first.push_back(static_cast<std::uint32_t>(rig_.influences.size()));
    std::vector<std::uint32_t> joints;
    for (const Bone& bone : rig_.bones)
        if (bone.skin != no_index) joints.push_back(bone.node);
    const std::vector<std::uint32_t> stands = place_along_first_parents(model_, joints, places);
    auto next = stands.begin();
    for (Bone& bone : rig_.bones)
        if (bone.skin != no_index) bone.node = *next++;
}

} // namespace spa::import::gltf
