// SPDX-License-Identifier: Apache-2.0
#include "object_scene.h"

#include "shapes.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace spa::test {

std::uint32_t add_object(Scene& scene, const std::string& name, const Model& mesh, const Affine& to_world,
                         std::uint32_t parent) {
    const auto node = std::uint32_t(scene.nodes.size());
    scene.nodes.push_back({name, parent, to_world});
    Model& model = scene.model;
    const auto first = std::uint32_t(model.positions.size());
    const auto material = std::uint32_t(model.materials.size());
    model.materials.insert(model.materials.end(), mesh.materials.begin(), mesh.materials.end());
    const Mat3 of_normals = normal_matrix(to_world.linear);
    for (const Vec3f& position : mesh.positions)
        model.positions.push_back(to_float(transform_point(to_world, to_double(position))));
    for (const Vec3f& normal : mesh.normals)
        model.normals.push_back(to_float(normalize(of_normals * to_double(normal))));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        Triangle triangle = mesh.triangles[i];
        for (std::uint32_t& vertex : triangle.vertex) vertex += first;
        if (determinant(to_world.linear) < 0) std::swap(triangle.vertex[0], triangle.vertex[1]);
        model.triangles.push_back(triangle);
        model.triangle_materials.push_back(material + mesh.triangle_materials[i]);
        scene.triangle_nodes.push_back(node);
    }
    return node;
}

Scene object_scene() {
    Scene scene;
    Model floor = empty_model();
    add_quad(floor, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
    Model ball = empty_model();
    add_sphere(ball, {0.2F, 0, 0}, 0.7F, 12);
    ball.materials[0].base_color = {0.9F, 0.2F, 0.1F, 1};
    Model crate = empty_model(), crumb = empty_model();
    add_box(crate, {-0.5F, 0, -0.5F}, {0.5F, 1, 0.5F});
    add_box(crumb, {0, 0, 0}, {0.05F, 0.05F, 0.05F});
    const double turn = std::sqrt(0.5);
    add_object(scene, "floor", floor, {});
    add_object(scene, "ball", ball, {{{{turn, 0, turn}, {0, 1, 0}, {-turn, 0, turn}}}, {-1.2, 0.8, 0}});
    add_object(scene, "twin", ball, {{{{-0.8, 0.2, 0}, {0, 0.9, 0}, {0, 0, 1.1}}}, {1.2, 0.8, -0.3}});
    const Affine stand{{{{0.5, 0, 0}, {0, 2, 0}, {0, 0, 0.5}}}, {0, 0, -2}};
    const auto above = add_object(scene, "stand", empty_model(), stand);
    add_object(scene, "crate", crate, stand * Affine{{}, {0, 0.25, 0}}, above);
    add_object(scene, "crumb", crumb, {{}, {0.2, 0, 1.5}});
    Camera& camera = scene.cameras.emplace_back();
    camera.name = "front";
    camera.to_world.translation = {0, 1.5, 7};
    camera.vertical_fov = 40 * std::numbers::pi / 180;
    Light& light = scene.lights.emplace_back();
    light.name = "lamp";
    light.position = {1, 5, 3};
    light.intensity = {40, 40, 40};
    return scene;
}

} // namespace spa::test
