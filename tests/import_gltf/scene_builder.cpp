// SPDX-License-Identifier: Apache-2.0
#include "scene_builder.h"

#include "../../libspa/core/error.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace spa::test {

GltfBuilder lit_triangle(const Json& light) {
    GltfBuilder builder = triangle();
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
    builder.json["nodes"].push_back(
        {{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    return builder;
}

GltfBuilder seen_triangle(const Json& perspective) {
    GltfBuilder builder = triangle();
    builder.json["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", perspective}}});
    builder.json["nodes"].push_back({{"name", "view"}, {"camera", 0}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    return builder;
}

namespace {

SceneResult read_scene(const Scratch& scratch, const char* name, const std::string& content) {
    return import::read_scene(scratch.write(name, content));
}

void expect_same(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.triangle_nodes, b.triangle_nodes);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        EXPECT_EQ(a.nodes[i].name, b.nodes[i].name);
        EXPECT_EQ(a.nodes[i].parent, b.nodes[i].parent);
        EXPECT_EQ(a.nodes[i].to_world, b.nodes[i].to_world);
    }
    EXPECT_EQ(a.cameras.size(), b.cameras.size());
    EXPECT_EQ(a.lights.size(), b.lights.size());
}

} // namespace

SceneResult read_scene_both(const GltfBuilder& builder) {
    const import::Result model = import_both(builder);
    const Scratch scratch;
    SceneResult binary = read_scene(scratch, "a.glb", builder.glb());
    const SceneResult text = read_scene(scratch, "a.gltf", builder.text());
    expect_valid(binary);
    expect_same(binary.scene, text.scene);
    EXPECT_EQ(binary.scene.model.positions, model.model.positions);
    EXPECT_EQ(binary.scene.model.normals, model.model.normals);
    EXPECT_EQ(binary.scene.model.triangle_materials, model.model.triangle_materials);
    EXPECT_EQ(binary.report.format, model.report.format);
    EXPECT_EQ(binary.report.files.size(), model.report.files.size());
    for (const std::string& warning : model.report.warnings)
        EXPECT_TRUE(has_warning(binary.report, warning)) << warning;
    return binary;
}

std::string scene_refusal(const GltfBuilder& builder) {
    const Scratch scratch;
    const std::filesystem::path path = scratch.write("a.glb", builder.glb());
    try {
        (void)import::read_scene(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        EXPECT_EQ(std::string_view(error.what()).rfind(path.string(), 0), 0U) << error.what();
        return error.what();
    }
    return "read";
}

void expect_valid(const SceneResult& result) {
    const Scene& scene = result.scene;
    expect_valid(import::Result{scene.model, result.report});
    ASSERT_EQ(scene.triangle_nodes.size(), scene.model.triangles.size());
    for (const std::uint32_t node : scene.triangle_nodes) ASSERT_LT(node, scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        ASSERT_TRUE(scene.nodes[i].parent == no_index || scene.nodes[i].parent < i) << i;
        ASSERT_TRUE(is_finite(scene.nodes[i].to_world)) << i;
    }
    for (const Camera& camera : scene.cameras) {
        ASSERT_TRUE(is_finite(camera.to_world));
        ASSERT_NE(determinant(camera.to_world.linear), 0);
        ASSERT_TRUE(camera.vertical_fov > 0 && camera.vertical_fov < std::numbers::pi);
    }
    for (const Light& light : scene.lights) {
        ASSERT_TRUE(is_finite(light.position) && is_finite(light.intensity));
        ASSERT_NEAR(length(light.direction), 1, 1e-6);
        ASSERT_TRUE(light.intensity.x >= 0 && light.intensity.y >= 0 && light.intensity.z >= 0);
        if (light.kind == LightKind::spot) {
            ASSERT_TRUE(light.inner_cone >= 0 && light.inner_cone < light.outer_cone &&
                        light.outer_cone <= std::numbers::pi / 2);
        }
    }
}

} // namespace spa::test
