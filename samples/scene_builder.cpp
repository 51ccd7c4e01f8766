// SPDX-License-Identifier: Apache-2.0
#include "scene_builder.h"

#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace spa::samples {
namespace {

struct Turn {
    double cosine, sine;
};

Turn turn_of(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
}

template <class T>
std::uint32_t size_of(const std::vector<T>& values) {
    return static_cast<std::uint32_t>(values.size());
}

} // namespace

Mat3 turn_x(double degrees) {
    const auto [c, s] = turn_of(degrees);
    return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
}

Mat3 turn_y(double degrees) {
    const auto [c, s] = turn_of(degrees);
    return {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
}

Mat3 turn_z(double degrees) {
    const auto [c, s] = turn_of(degrees);
    return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

std::uint32_t SceneBuilder::add(const std::string& name, const Affine& to_world, const Model& mesh,
                                std::uint32_t parent) {
    Model& model = scene_.model;
    const std::uint32_t node = size_of(scene_.nodes);
    Affine to_parent = to_world;
    if (parent != no_index) to_parent = inverse(scene_.nodes[parent].to_world) * to_world;
    scene_.nodes.push_back({name, parent, to_world, to_parent, node});

    const auto first_texture = static_cast<std::uint32_t>(model.textures.size());
    model.textures.insert(model.textures.end(), mesh.textures.begin(), mesh.textures.end());
    std::vector<std::uint32_t> materials;
    for (Material material : mesh.materials) {
        const auto known =
            std::find_if(model.materials.begin(), model.materials.end(),
                         [&](const Material& earlier) { return earlier.name == material.name; });
        materials.push_back(static_cast<std::uint32_t>(known - model.materials.begin()));
        if (known != model.materials.end()) continue;
        if (material.texture != no_index) material.texture += first_texture;
        model.materials.push_back(std::move(material));
    }

    const std::uint32_t first = size_of(model.positions);
    for (const Vec3f& p : mesh.positions)
        model.positions.push_back(to_float(transform_point(to_world, to_double(p))));
    const Mat3 by = normal_matrix(to_world.linear);
    for (const Vec3f& n : mesh.normals) model.normals.push_back(to_float(normalize(by * to_double(n))));
    if (!mesh.uvs.empty()) {
        model.uvs.resize(first);
        model.uvs.insert(model.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    }
    if (!model.uvs.empty()) model.uvs.resize(model.positions.size());
    if (!model.colors.empty()) model.colors.resize(model.positions.size(), {1, 1, 1, 1});
    for (const Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = triangle.vertex;
        model.triangles.push_back({{a + first, b + first, c + first}});
    }
    for (const std::uint32_t material : mesh.triangle_materials)
        model.triangle_materials.push_back(materials[material]);
    scene_.triangle_nodes.resize(model.triangles.size(), node);
    return node;
}

std::uint32_t SceneBuilder::add_group(const std::string& name) {
    const std::uint32_t node = size_of(scene_.nodes);
    scene_.nodes.push_back({name, no_index, {}, {}, node});
    return node;
}

void SceneBuilder::add_boot(int level, const Mat3& turn, Vec3d place) {
    const Model boot = make_boot(level);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3f& p : boot.positions) lowest = std::min(lowest, (turn * to_double(p)).y);
    add("boot", {turn, place - Vec3d{0, lowest, 0}}, boot);
}

void SceneBuilder::add_camera(const std::string& name, Vec3d eye, Vec3d target, double vertical_degrees) {
    const Vec3d back = normalize(eye - target);
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, back));
    Camera camera;
    camera.name = name;
    camera.to_world = {transpose({{right, cross(back, right), back}}), eye};
    camera.vertical_fov = vertical_degrees * std::numbers::pi / 180;
    scene_.nodes.push_back({name, no_index, camera.to_world, camera.to_world, size_of(scene_.nodes)});
    scene_.cameras.push_back(std::move(camera));
}

void SceneBuilder::add_point_light(const std::string& name, Vec3d position, float watts_per_steradian) {
    Light light;
    light.name = name;
    light.position = position;
    light.intensity = {watts_per_steradian, watts_per_steradian, watts_per_steradian};
    scene_.nodes.push_back({name, no_index, {{}, position}, {{}, position}, size_of(scene_.nodes)});
    scene_.lights.push_back(std::move(light));
}

Material white() {
    Material material;
    material.name = "white";
    material.base_color = {0.8F, 0.8F, 0.8F, 1};
    return material;
}

Material stone() {
    Material material;
    material.name = "stone";
    material.base_color = {0.78F, 0.72F, 0.63F, 1};
    return material;
}

} // namespace spa::samples
