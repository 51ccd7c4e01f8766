// SPDX-License-Identifier: Apache-2.0
#include "scene_triangles.h"

#include "../core/error.h"

#include <string>

namespace spa::render {
namespace {

std::string name_of(const Scene& scene, std::uint32_t node) {
    return "node " + std::to_string(node) + " '" + scene.nodes[node].name + "'";
}

class Grouper {
public:
    Grouper(const Model& model, SceneTriangles& out)
        : model_(model), out_(out), new_index_(model.positions.size(), no_index) {}

    void begin(std::uint32_t object, bool alpha) {
        group_ = {
            object, alpha, std::uint32_t(out_.triangles.size()), 0, std::uint32_t(out_.positions.size()), 0};
    }
    void add(std::uint32_t triangle) {
        Triangle corners = model_.triangles[triangle];
        for (std::uint32_t& corner : corners.vertex) corner = vertex(corner);
        out_.triangles.push_back(corners);
        out_.materials.push_back(model_.triangle_materials[triangle]);
    }
    void end() {
        for (const std::uint32_t vertex : used_) new_index_[vertex] = no_index;
        used_.clear();
        group_.triangle_count = std::uint32_t(out_.triangles.size()) - group_.first_triangle;
        group_.vertex_count = std::uint32_t(out_.positions.size()) - group_.first_vertex;
        if (group_.triangle_count > 0) out_.groups.push_back(group_);
    }

private:
    std::uint32_t vertex(std::uint32_t old) {
        if (new_index_[old] != no_index) return new_index_[old];
        new_index_[old] = std::uint32_t(out_.positions.size());
        used_.push_back(old);
        out_.positions.push_back(model_.positions[old]);
        if (!model_.normals.empty()) out_.normals.push_back(model_.normals[old]);
        if (!model_.uvs.empty()) out_.uvs.push_back(model_.uvs[old]);
        if (!model_.colors.empty()) out_.colors.push_back(model_.colors[old]);
        return new_index_[old];
    }

    const Model& model_;
    SceneTriangles& out_;
    std::vector<std::uint32_t> new_index_; // of vertices in this group
    std::vector<std::uint32_t> used_;
    TriangleGroup group_;
};

} // namespace

std::vector<std::uint32_t> objects_of_nodes(const Scene& scene, std::span<const MapPlacement> maps) {
    std::vector<std::uint32_t> placed(scene.nodes.size(), 0);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (maps[i].dropped != (maps[i].map == nullptr))
            throw Error(ExitCode::usage, "a placement has no map, or is dropped and has one");
        if (maps[i].node == no_index && maps.size() > 1)
            throw Error(ExitCode::usage,
                        "a map takes the place of the whole scene, and another one that of a node of it");
        if (maps[i].node == no_index) return std::vector<std::uint32_t>(scene.nodes.size(), 1);
        if (maps[i].node >= scene.nodes.size())
            throw Error(ExitCode::usage, "a map is to replace node " + std::to_string(maps[i].node) +
                                             ", but the scene has " + std::to_string(scene.nodes.size()) +
                                             " nodes");
        if (placed[maps[i].node] != 0)
            throw Error(ExitCode::usage, "two maps are to replace " + name_of(scene, maps[i].node));
        placed[maps[i].node] = std::uint32_t(i + 1);
    }
    std::vector<std::uint32_t> objects(scene.nodes.size(), 0);
    for (std::uint32_t node = 0; node < scene.nodes.size(); ++node) {
        for (std::uint32_t at = node; at != no_index; at = scene.nodes[at].parent) {
            if (placed[at] == 0) continue;
            if (objects[node] != 0)
                throw Error(ExitCode::usage, "maps are to replace both " + name_of(scene, at) + " and " +
                                                 name_of(scene, maps[objects[node] - 1].node) + " below it");
            objects[node] = placed[at];
        }
    }
    return objects;
}

SceneTriangles group_triangles(const Scene& scene, std::span<const std::uint32_t> objects_of_nodes,
                               std::size_t placements, bool keep_replaced) {
    const Model& model = scene.model;
    // Triangles of each group: opaque and not, of what no map replaces, of the first object, of the second,
    // ...
    std::vector<std::vector<std::uint32_t>> members(2 * (keep_replaced ? placements + 1 : 1));
    for (std::uint32_t i = 0; i < model.triangles.size(); ++i) {
        const std::uint32_t object =
            scene.triangle_nodes.empty() ? 0 : objects_of_nodes[scene.triangle_nodes[i]];
        const bool alpha = model.materials[model.triangle_materials[i]].alpha_mode != AlphaMode::opaque;
        if (object == 0 || keep_replaced) members[2 * object + (alpha ? 1 : 0)].push_back(i);
    }
    SceneTriangles result;
    Grouper grouper(model, result);
    for (std::size_t i = 0; i < members.size(); ++i) {
        grouper.begin(std::uint32_t(i / 2), i % 2 == 1);
        for (const std::uint32_t triangle : members[i]) grouper.add(triangle);
        grouper.end();
    }
    return result;
}

} // namespace spa::render
