// SPDX-License-Identifier: Apache-2.0
// Scene::rig: posed at rest it is the model, vertex by vertex, whatever the importer did to the vertices.
#include "scene_builder.h"

#include "../../libspa/core/error.h"
#include "../../libspa/mesh/pose.h"

#include <cmath>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

SceneResult read_rig(const std::filesystem::path& path, import::Limits limits = {}) {
    return import::read_scene(path, limits, {.rig = true});
}

Scene rig_of(const GltfBuilder& builder) {
    const Scratch scratch;
    return read_rig(scratch.write("a.glb", builder.glb())).scene;
}

// With the files beside it.
bool is_larger_than(const std::filesystem::path& file, std::uintmax_t bytes) {
    std::uintmax_t sum = 0;
    for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
        if (entry.is_regular_file()) sum += entry.file_size();
    return sum > bytes;
}

std::vector<Affine> at_rest(const Scene& scene) {
    std::vector<Affine> to_world;
    for (const SceneNode& node : scene.nodes) to_world.push_back(node.to_world);
    return to_world;
}

// What rig.h promises, and that the rest pose is the model that read_model gives.
void expect_rest(const Scene& scene, const Model& model) {
    const Rig& rig = scene.rig;
    const std::size_t vertices = model.positions.size();
    ASSERT_EQ(scene.model.positions, model.positions);
    ASSERT_EQ(rig.positions.size(), vertices);
    ASSERT_EQ(rig.normals.size(), vertices);
    ASSERT_EQ(rig.first.size(), vertices + 1);
    ASSERT_EQ(rig.first.back(), rig.influences.size());
    for (std::size_t v = 0; v < vertices; ++v) {
        double sum = 0;
        for (std::uint32_t i = rig.first[v]; i < rig.first[v + 1]; ++i) {
            ASSERT_LT(rig.influences[i].bone, rig.bones.size());
            sum += double(rig.influences[i].weight);
        }
        ASSERT_NEAR(sum, 1, 1e-5) << v;
    }
    for (const Bone& bone : rig.bones) ASSERT_LT(bone.node, scene.nodes.size());
    for (const SceneNode& node : scene.nodes) {
        const Affine made =
            node.parent == no_index ? node.to_parent : scene.nodes[node.parent].to_world * node.to_parent;
        ASSERT_EQ(made, node.to_world) << node.name;
        ASSERT_NE(node.source, no_index);
    }
    double size = 0;
    for (const Vec3f& p : model.positions) size = std::max(size, length(to_double(p)));
    Model posed = scene.model;
    posed.positions.assign(vertices, {});
    posed.normals.assign(vertices, {});
    pose_vertices(scene, at_rest(scene), posed);
    for (std::size_t v = 0; v < vertices; ++v) {
        ASSERT_LE(length(posed.positions[v] - model.positions[v]), 1e-6 * size) << v;
        ASSERT_LE(length(posed.normals[v] - model.normals[v]), 2e-5) << v;
    }
    if (rig.animations.empty()) return;
    // Without tracks, an animation leaves the nodes where they are.
    EXPECT_EQ(pose_nodes(scene, {}, 1), at_rest(scene));
}

TEST(Rig, OnlyIfWanted) {
    const Scene scene = read_scene_both(triangle()).scene;
    EXPECT_TRUE(scene.rig.empty());
    EXPECT_TRUE(scene.rig.positions.empty());
}

TEST(Rig, RestPoseOfAssets) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    std::size_t read = 0;
    for (const char* folder : {"gltf", "unsupported"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(assets() / folder)) {
            const std::filesystem::path& file = entry.path();
            if ((file.extension() != ".glb" && file.extension() != ".gltf") ||
                is_larger_than(file, 1U << 20U))
                continue;
            SCOPED_TRACE(file);
            SceneResult result;
            try {
                result = read_rig(file);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::unsupported) << error.what();
                continue;
            }
            expect_valid(result);
            expect_rest(result.scene, import::read_model(file).model);
            ++read;
        }
    EXPECT_GT(read, 20U);
}

// Vertex 0 follows joint 0, vertex 1 both, vertex 2 nothing: the node.
GltfBuilder skinned() {
    GltfBuilder builder = triangle();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = builder.add_accessor<float>({1, 0, 0, 0, 1, 3, 0, 0, 0, 0, 0, 0}, "VEC4");
    const int bind = builder.add_accessor<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
        "MAT4");
    builder.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", bind}}};
    builder.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {9, 0, 0}}},
                             {{"children", {2}}, {"translation", {0, 10, 0}}},
                             {{"children", {3}}},
                             {{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}}};
    builder.json["scenes"][0]["nodes"] = {0, 1};
    return builder;
}

TEST(Rig, JointsBecomeBones) {
    const Scene scene = rig_of(skinned());
    const Rig& rig = scene.rig;
    ASSERT_EQ(rig.bones.size(), 3U); // two joints and the node, for the vertex without weights
    EXPECT_EQ(rig.bones[1].skin, 0U);
    EXPECT_EQ(rig.bones[1].joint, 1U);
    EXPECT_EQ(scene.nodes[rig.bones[1].node].source, 3U);
    EXPECT_EQ(rig.bones[1].inverse_bind, (Affine{{}, {-1, 0, 0}}));
    EXPECT_EQ(rig.bones[2].skin, no_index);
    EXPECT_EQ(scene.nodes[rig.bones[2].node].source, 0U);
    EXPECT_EQ(rig.first, (std::vector<std::uint32_t>{0, 1, 3, 4}));
    EXPECT_EQ(rig.influences[1].weight, 0.25F);
    EXPECT_EQ(rig.influences[2].weight, 0.75F);
    EXPECT_EQ(rig.influences[3].bone, 2U);
    EXPECT_EQ(rig.positions[1], (Vec3f{1, 0, 0}));
    const Scratch scratch;
    expect_rest(scene, import_both(skinned()).model);
}

// A joint moves its vertices, by formula: p1 = 1/4 (p + t) + 3/4 (t + (1,0,0) + 2 (p - (1,0,0))).
TEST(Rig, VerticesFollowTheJoints) {
    const Scene scene = rig_of(skinned());
    std::vector<Affine> to_world = at_rest(scene);
    const std::uint32_t upper = scene.rig.bones[0].node, lower = scene.rig.bones[1].node;
    to_world[upper] = {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, {0, 0, 5}}; // a quarter turn
    to_world[lower] = {{}, {7, 0, 0}};
    Model model = scene.model;
    pose_vertices(scene, to_world, model);
    expect_near(model.positions[0], {0, 0, 5});
    expect_near(model.positions[1], {0.75F * 7, 0.25F, 1.25F}); // (1,0,0) turns to (0,1,5), moves to (7,0,0)
    expect_near(model.positions[2], {9, 1, 0});
}

// The joints' nodes may be of no scene: they are posed as read_model does, along their first parents.
TEST(Rig, JointsOutsideTheScene) {
    GltfBuilder builder = skinned();
    builder.json["scenes"][0]["nodes"] = {0};
    const Scene scene = rig_of(builder);
    expect_rest(scene, import_both(builder).model);
    ASSERT_EQ(scene.nodes.size(), 4U);
    EXPECT_EQ(read_scene_both(builder).scene.nodes.size(), 1U);
    builder.json["scenes"][0]["nodes"] = {0, 3}; // without the nodes above it, where joint 1 is not
    EXPECT_EQ(rig_of(builder).nodes.size(), 5U);
    expect_rest(rig_of(builder), import_both(builder).model);
}

// Vertices that go, that are split for flat shading, that are mirrored and whose normals are made anew.
TEST(Rig, StaysInStepWithTheVertices) {
    GltfBuilder builder = skinned();
    builder.json["nodes"][1]["scale"] = {-1, 1, 3};
    expect_rest(rig_of(builder), import_both(builder).model);
    const int unused = builder.add_accessor<std::uint8_t>({0, 1, 2, 1, 1, 2}, "SCALAR");
    builder.json["meshes"][0]["primitives"][0]["indices"] = unused;
    expect_rest(rig_of(builder), import_both(builder).model);
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    expect_rest(rig_of(builder), import_both(builder).model);
    const int normals = builder.add_accessor<float>({0, 0, 0, 0, 0, 1, 0, 1, 0}, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    expect_rest(rig_of(builder), import_both(builder).model);
}

TEST(Rig, WeightsThatCancelAreRefused) {
    GltfBuilder builder = skinned();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] =
        builder.add_accessor<float>({1, 0, 0, 0, 3e38F, -3e38F, 1e-30F, 0, 1, 0, 0, 0}, "VEC4");
    attributes["JOINTS_0"] = builder.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    const Scratch scratch;
    try {
        (void)read_rig(scratch.write("a.glb", builder.glb()));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string_view(error.what()).find("vertex 1 has weights of both signs"),
                  std::string_view::npos)
            << error.what();
    }
}

// Two JOINTS_n and WEIGHTS_n.
TEST(Rig, AllSetsOfWeights) {
    GltfBuilder builder = skinned();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = builder.add_accessor<std::uint8_t>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] = builder.add_accessor<float>({1, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0}, "VEC4");
    const Scene scene = rig_of(builder);
    EXPECT_EQ(scene.rig.bones.size(), 2U);
    EXPECT_EQ(scene.rig.first, (std::vector<std::uint32_t>{0, 2, 4, 5}));
    EXPECT_EQ(scene.rig.influences[1].weight, 0.5F);
    expect_rest(scene, import_both(builder).model);
}

// What takes memory counts before it is taken.
TEST(Rig, CountsForTheLimit) {
    const Scratch scratch;
    const std::filesystem::path file = scratch.write("a.glb", skinned().glb());
    import::Limits limits;
    limits.model_bytes = 3 * 48 + 20;
    EXPECT_NO_THROW((void)import::read_scene(file, limits));
    EXPECT_THROW((void)read_rig(file, limits), Error);
    limits.model_bytes += 3 * (28 + 4 * 8);
    EXPECT_NO_THROW((void)read_rig(file, limits));
}

TEST(Rig, OfOtherFormatsStandsStill) {
    const Scratch scratch;
    const std::filesystem::path file =
        scratch.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no a\nf 1 2 3\no b\nf 1 2 4\n");
    const Scene scene = read_rig(file).scene;
    EXPECT_EQ(scene.rig.bones.size(), 2U);
    EXPECT_EQ(scene.nodes[1].source, 1U);
    expect_rest(scene, import::read_model(file).model);
}

} // namespace
} // namespace spa::test
