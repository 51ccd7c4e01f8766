// SPDX-License-Identifier: Apache-2.0
// Scene::rig: posed at rest it is the model, vertex by vertex, whatever the importer did to the vertices.
#include "../../libspa/mesh/pose.h"
#include "scene_builder.h"

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
        const Affine made = node.parent == no_index ? node.to_parent
                                                    : scene.nodes[node.parent].to_world * node.to_parent;
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
    for (const char* file :
         {"gltf/AnimatedMorphSphere/AnimatedMorphSphere.glb", "gltf/BoxInterleaved/BoxInterleaved.gltf",
          "gltf/CesiumMan/CesiumMan.glb", "gltf/CubeScaledInstances/cube_att.gltf", "gltf/Fox/Fox.glb",
          "gltf/MirrorTriangle/one_face_123_mirror.gltf", "gltf/RiggedSimple/RiggedSimple.gltf",
          "gltf/SimpleMorph/SimpleMorph.gltf", "gltf/TriangleWithoutIndices/TriangleWithoutIndices.gltf",
          "gltf/van_mirrored_wheels/van.glb", "gltf/xr_generic-hand/left.glb",
          "unsupported/draco_heart/heart_draco.glb", "unsupported/quantized_fox/Fox_quantized.glb"}) {
        SCOPED_TRACE(file);
        const SceneResult result = read_rig(assets() / file);
        expect_valid(result);
        expect_rest(result.scene, import::read_model(assets() / file).model);
    }
}

} // namespace
} // namespace spa::test
