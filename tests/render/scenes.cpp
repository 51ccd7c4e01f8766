// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

namespace spa::test {

std::uint32_t add_node(Scene& scene, const std::string& name, const Affine& to_world, std::uint32_t parent) {
    scene.nodes.push_back({name, parent, to_world});
    return std::uint32_t(scene.nodes.size() - 1);
}

void add_model(Scene& scene, std::uint32_t node, const Model& model) {
    Model& all = scene.model;
    const Affine& to_world = scene.nodes[node].to_world;
    const auto first_vertex = std::uint32_t(all.positions.size());
    const auto first_material = std::uint32_t(all.materials.size());
    const auto first_texture = std::uint32_t(all.textures.size());
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        all.positions.push_back(to_float(transform_point(to_world, to_double(model.positions[i]))));
        const Vec3d normal = model.normals.empty() ? Vec3d{} : to_double(model.normals[i]);
        all.normals.push_back(to_float(normalize(normal_matrix(to_world.linear) * normal)));
        all.uvs.push_back(model.uvs.empty() ? Vec2f{} : model.uvs[i]);
        all.colors.push_back(model.colors.empty() ? Vec4f{1, 1, 1, 1} : model.colors[i]);
    }
    for (Material material : model.materials) {
        if (material.texture != no_index) material.texture += first_texture;
        all.materials.push_back(material);
    }
    all.textures.insert(all.textures.end(), model.textures.begin(), model.textures.end());
    for (std::size_t i = 0; i < model.triangles.size(); ++i) {
        Triangle triangle = model.triangles[i];
        for (std::uint32_t& vertex : triangle.vertex) vertex += first_vertex;
        all.triangles.push_back(triangle);
        all.triangle_materials.push_back(first_material + model.triangle_materials[i]);
        scene.triangle_nodes.push_back(node);
    }
}

Model square(Vec3f center, Vec3f a, Vec3f b, Vec4f color) {
    Model model;
    model.materials.emplace_back();
    model.materials.back().base_color = color;
    model.positions = {center - a - b, center + a - b, center + a + b, center - a + b};
    model.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    model.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    model.triangle_materials = {0, 0};
    return model;
}

Light point_light(Vec3d position, Vec3f intensity) {
    Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

Camera camera_at(Vec3d from, Vec3d to, double vertical_fov) {
    const Vec3d forward = normalize(to - from);
    const Vec3d right = normalize(cross(forward, Vec3d{0, 1, 0}));
    const Vec3d up = cross(right, forward);
    Camera camera;
    camera.to_world.linear = transpose({{right, up, -forward}});
    camera.to_world.translation = from;
    camera.vertical_fov = vertical_fov;
    return camera;
}

void add_room(Scene& scene) {
    const std::uint32_t room = add_node(scene, "room");
    add_model(scene, room, square({0, -1, 0}, {4, 0, 0}, {0, 0, -4}, {0.8F, 0.8F, 0.8F, 1}));
    add_model(scene, room, square({0, 2, -2}, {4, 0, 0}, {0, 3, 0}, {0.8F, 0.3F, 0.2F, 1}));
    add_model(scene, room, square({-2, 2, 0}, {0, 0, 4}, {0, 3, 0}, {0.2F, 0.7F, 0.3F, 1}));
}

} // namespace spa::test
