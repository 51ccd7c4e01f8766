// SPDX-License-Identifier: Apache-2.0
#include "node_model.h"

#include "piece_model.h"

#include "../core/error.h"

#include <algorithm>

namespace spa {

std::string node_text(const Scene& scene, std::uint32_t node) {
    const std::string& name = scene.nodes[node].name;
    return "node " + std::to_string(node) + (name.empty() ? "" : " '" + name + "'");
}

std::vector<bool> nodes_below(const Scene& scene, std::uint32_t node) {
    std::vector<bool> below(scene.nodes.size()); // a node comes behind its parent
    for (std::uint32_t i = node; i < scene.nodes.size(); ++i)
        below[i] = i == node || (scene.nodes[i].parent != no_index && below[scene.nodes[i].parent]);
    return below;
}

Model node_model(const Scene& scene, std::uint32_t node) {
    const Affine& to_world = scene.nodes[node].to_world;
    if (!has_inverse(to_world))
        throw Error(ExitCode::invalid_data,
                    node_text(scene, node) + ": its transform or that of a parent has no inverse (a scale of "
                                             "0?), so it has no space of its own to be baked in");
    const std::vector<bool> drawn = nodes_below(scene, node);
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < scene.triangle_nodes.size(); ++t)
        if (drawn[scene.triangle_nodes[t]]) triangles.push_back(t);
    if (triangles.empty())
        throw Error(ExitCode::invalid_data,
                    node_text(scene, node) + ": neither it nor a node below it draws a triangle");
    Model model = piece_model(scene.model, triangles);
    move_to_local(model, to_world);
    const auto finite = [](const std::vector<Vec3f>& all) {
        return std::all_of(all.begin(), all.end(), [](Vec3f v) { return is_finite(v); });
    };
    if (!finite(model.positions) || !finite(model.normals))
        throw Error(
            ExitCode::invalid_data,
            node_text(scene, node) +
                ": its triangles are too large in its own space; is the scale of its transform meant?");
    return model;
}

} // namespace spa
