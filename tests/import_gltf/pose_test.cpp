// SPDX-License-Identifier: Apache-2.0
// Morph targets with default weights and skins at rest.
#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

GltfBuilder morphed() {
    GltfBuilder builder = triangle();
    const int up = builder.add_accessor<float>({0, 0, 0, 0, 0, 0, 0, 2, 0}, "VEC3");
    const int side = builder.add_accessor<float>({0, 0, 0, 4, 0, 0, 0, 0, 0}, "VEC3");
    const int tilt = builder.add_accessor<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}},
                                                             {{"POSITION", side}, {"NORMAL", tilt}}};
    return builder;
}

TEST(Pose, MorphWeights) {
    GltfBuilder builder = morphed();
    EXPECT_EQ(corners(import_both(builder).model, 0)[2], (Vec3f{0, 1, 0})); // no weights: all 0
    builder.json["meshes"][0]["weights"] = {0.5, 0};
    EXPECT_EQ(corners(import_both(builder).model, 0)[2], (Vec3f{0, 2, 0}));
    builder.json["nodes"][0]["weights"] = {0, 1}; // of the node before those of the mesh
    const Model model = import_both(builder).model;
    EXPECT_EQ(corners(model, 0)[1], (Vec3f{5, 0, 0}));
    EXPECT_EQ(corners(model, 0)[2], (Vec3f{0, 1, 0}));
    expect_near(model.normals[0], {0.70710678F, 0, 0.70710678F});
}

TEST(Pose, MorphTargetOfAnotherSize) {
    GltfBuilder builder = morphed();
    builder.json["accessors"][2]["count"] = 2;
    EXPECT_NE(refusal(builder).find("targets[0].POSITION"), std::string::npos);
}

// Vertex 0 follows joint 0, vertex 1 joint 1, vertex 2 both, with weights that do not sum up to 1.
GltfBuilder skinned() {
    GltfBuilder builder = triangle();
    const int joints = builder.add_accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    const int weights = builder.add_accessor<float>({1, 0, 0, 0, 2, 0, 0, 0, 0.25, 0.25, 0, 0}, "VEC4");
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    const int bind = builder.add_accessor<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
        "MAT4");
    builder.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", bind}}};
    builder.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {1000, 0, 0}}},
                             {{"children", {2}}, {"translation", {0, 10, 0}}},
                             {{"children", {3}}},
                             {{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}}};
    builder.json["scenes"][0]["nodes"] = {0, 1};
    return builder;
}

TEST(Pose, Skin) {
    const import::Result result = import_both(skinned());
    const auto [a, b, c] = corners(result.model, 0);
    expect_near(a, {0, 10, 0}); // the node's own place does not count
    expect_near(b, {1, 10, 0}); // the centre of joint 1's scaling
    // Half of (0, 11, 0) and half of (1, 10, 0) + 2 ((0, 1, 0) - (1, 0, 0)) = (-1, 12, 0).
    expect_near(c, {-0.5F, 11.5F, 0});
    expect_near(result.model.normals[2], {0, 0, 1});
}

TEST(Pose, MirroringSkinKeepsTheFront) {
    GltfBuilder builder = skinned();
    builder.json["nodes"][1]["scale"] = {-1, 1, 1};
    const Model model = import_both(builder).model;
    const auto [a, b, c] = corners(model, 0);
    expect_near(normalize(cross(b - a, c - a)), {0, 0, 1});
    expect_near(model.normals[0], {0, 0, 1});
}

TEST(Pose, JointOutOfRange) {
    GltfBuilder builder = skinned();
    builder.json["skins"][0]["joints"] = {2};
    EXPECT_NE(refusal(builder).find("vertex 1 follows joint 1, the skin has 1"), std::string::npos);
}

TEST(Pose, SkinWithoutWeightsFollowsTheNode) {
    GltfBuilder builder = skinned();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes.erase("JOINTS_0");
    attributes.erase("WEIGHTS_0");
    const import::Result result = import_both(builder);
    expect_near(corners(result.model, 0)[0], {1000, 0, 0});
    EXPECT_TRUE(has_warning(result.report, "no JOINTS_0 and WEIGHTS_0"));
}

} // namespace
} // namespace spa::test
