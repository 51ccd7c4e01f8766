// SPDX-License-Identifier: Apache-2.0
#include "node_model.h"

#include "../core/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace spa {

namespace {

// New numbers for what is used, in the old order.
class Renumbering {
public:
    explicit Renumbering(std::size_t count) : number_(count, no_index) {}
    void use(std::uint32_t old) { number_[old] = 0; }
    void number() {
        for (std::uint32_t old = 0; old < number_.size(); ++old) {
            if (number_[old] == no_index) continue;
            number_[old] = std::uint32_t(used_.size());
            used_.push_back(old);
        }
    }
    [[nodiscard]] std::uint32_t operator()(std::uint32_t old) const { return number_[old]; }
    [[nodiscard]] const std::vector<std::uint32_t>& used() const { return used_; }

private:
    std::vector<std::uint32_t> number_, used_;
};

template <class T>
std::vector<T> picked(const std::vector<T>& all, const std::vector<std::uint32_t>& used) {
    std::vector<T> result;
    if (all.empty()) return result;
    result.reserve(used.size());
    for (const std::uint32_t i : used) result.push_back(all[i]);
    return result;
}

bool has_inverse(const Affine& map) {
    const double size = determinant(map.linear);
    return size != 0 && std::isfinite(size) && is_finite(inverse(map));
}

// The triangles with vertices and materials as the model will have them; returns which vertices these are.
Renumbering pick_triangles(const Scene& scene, std::uint32_t node, bool turned, Model& model) {
    const Model& source = scene.model;
    const std::vector<bool> drawn = nodes_below(scene, node);
    Renumbering vertices(source.positions.size());
    for (std::size_t i = 0; i < source.triangles.size(); ++i) {
        if (!drawn[scene.triangle_nodes[i]]) continue;
        model.triangles.push_back(source.triangles[i]);
        model.triangle_materials.push_back(source.triangle_materials[i]);
        for (const std::uint32_t vertex : source.triangles[i].vertex) vertices.use(vertex);
    }
    vertices.number();
    for (Triangle& triangle : model.triangles) {
        for (std::uint32_t& vertex : triangle.vertex) vertex = vertices(vertex);
        if (turned) std::swap(triangle.vertex[1], triangle.vertex[2]);
    }
    return vertices;
}

void pick_materials(const Model& source, Model& model) {
    Renumbering materials(source.materials.size()), textures(source.textures.size());
    for (const std::uint32_t material : model.triangle_materials) materials.use(material);
    materials.number();
    for (std::uint32_t& material : model.triangle_materials) material = materials(material);
    model.materials = picked(source.materials, materials.used());
    for (const Material& material : model.materials)
        if (material.texture != no_index) textures.use(material.texture);
    textures.number();
    for (Material& material : model.materials)
        if (material.texture != no_index) material.texture = textures(material.texture);
    model.textures = picked(source.textures, textures.used());
}

} // namespace

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
    Model model;
    const Renumbering vertices = pick_triangles(scene, node, determinant(to_world.linear) < 0, model);
    if (model.triangles.empty())
        throw Error(ExitCode::invalid_data,
                    node_text(scene, node) + ": neither it nor a node below it draws a triangle");
    pick_materials(scene.model, model);
    model.colors = picked(scene.model.colors, vertices.used());
    if (!model.textures.empty()) model.uvs = picked(scene.model.uvs, vertices.used());

    const Affine to_local = inverse(to_world);
    model.positions = picked(scene.model.positions, vertices.used());
    for (Vec3f& position : model.positions)
        position = to_float(transform_point(to_local, to_double(position)));
    const Mat3 of_normals = normal_matrix(to_local.linear);
    model.normals = picked(scene.model.normals, vertices.used());
    for (Vec3f& normal : model.normals) normal = to_float(normalize(of_normals * to_double(normal)));
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
