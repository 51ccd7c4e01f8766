// SPDX-License-Identifier: Apache-2.0
// One object of a scene as a model: against the mesh that the object was placed from.
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/node_model.h"
#include "../support/object_scene.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

namespace spa {
namespace {

void expect_near(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(length(a[i] - b[i]), 2e-6F) << i;
}

// Whether triangles face the way that their vertices' normals do.
void expect_faces_outwards(const Model& model) {
    for (const Triangle& triangle : model.triangles) {
        const auto [a, b, c] = triangle.vertex;
        const Vec3f normal =
            cross(model.positions[b] - model.positions[a], model.positions[c] - model.positions[a]);
        EXPECT_GT(dot(normal, model.normals[a]), 0);
    }
}

Model ball() {
    Model mesh = test::empty_model();
    test::add_sphere(mesh, {0.2F, 0, 0}, 0.7F, 12);
    return mesh;
}

TEST(NodeModel, IsTheMeshInItsOwnSpace) {
    const Scene scene = test::object_scene();
    for (const std::uint32_t node : {1U, 2U}) { // the second is mirrored and sheared
        const Model model = node_model(scene, node);
        expect_near(model.positions, ball().positions);
        expect_near(model.normals, ball().normals);
        expect_faces_outwards(model);
        EXPECT_EQ(model.triangles.size(), ball().triangles.size());
        ASSERT_EQ(model.materials.size(), 1U) << "those that are used";
        EXPECT_EQ(model.materials[0].base_color.x, 0.9F);
    }
}

TEST(NodeModel, HasWhatLiesBelow) {
    const Scene scene = test::object_scene();
    EXPECT_EQ(nodes_below(scene, 3), (std::vector<bool>{false, false, false, true, true, false}));
    Model crate = test::empty_model();
    test::add_box(crate, {-0.5F, 0.25F, -0.5F}, {0.5F, 1.25F, 0.5F});
    const Model model = node_model(scene, 3); // draws nothing itself
    expect_near(model.positions, crate.positions);
    EXPECT_EQ(model.triangles.size(), 12U);
}

TEST(NodeModel, TexturesAreThoseThatAreUsed) {
    Scene scene = test::object_scene();
    Model& model = scene.model;
    model.uvs.resize(model.positions.size());
    for (std::size_t i = 0; i < model.uvs.size(); ++i) model.uvs[i] = {float(i), 0};
    model.textures = {{"of the floor", {}}, {"of the crumb", {}}};
    model.materials[model.triangle_materials.front()].texture = 0;
    model.materials[model.triangle_materials.back()].texture = 1;
    const Model crumb = node_model(scene, 5);
    ASSERT_EQ(crumb.textures.size(), 1U);
    EXPECT_EQ(crumb.textures[0].name, "of the crumb");
    EXPECT_EQ(crumb.materials[crumb.triangle_materials[0]].texture, 0U);
    ASSERT_EQ(crumb.uvs.size(), crumb.positions.size());
    EXPECT_EQ(crumb.uvs.back().x, float(model.positions.size() - 1));
    EXPECT_TRUE(node_model(scene, 1).uvs.empty()) << "the ball has no texture";
}

std::string refusal(const Scene& scene, std::uint32_t node) {
    try {
        static_cast<void>(node_model(scene, node));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        return error.what();
    }
    return "a model";
}

TEST(NodeModel, WhatIsNoModel) {
    Scene scene = test::object_scene();
    scene.nodes.push_back({"empty", no_index, {}});
    EXPECT_EQ(refusal(scene, 6), "node 6 'empty': neither it nor a node below it draws a triangle");
    scene.nodes[5].to_world.linear.row[1] = {};
    EXPECT_NE(refusal(scene, 5).find("node 5 'crumb': its transform or that of a parent has no inverse"),
              std::string::npos);
    scene.nodes[1].to_world.linear = {{{1e-42, 0, 0}, {0, 1e-42, 0}, {0, 0, 1e-42}}};
    EXPECT_NE(refusal(scene, 1).find("too large in its own space"), std::string::npos);
}

} // namespace
} // namespace spa
