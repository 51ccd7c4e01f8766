// SPDX-License-Identifier: Apache-2.0
// read_scene: which node every triangle comes from, and where the nodes stand.
#include "scene_builder.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

TEST(SceneNodes, NamesParentsAndTransforms) {
    GltfBuilder builder = triangle();
    builder.json["nodes"] = {{{"name", "leaf"}, {"mesh", 0}, {"translation", {1, 2, 3}}},
                             {{"name", "root"}, {"children", {0}}, {"scale", {2, 4, 8}}},
                             {{"name", "empty"}, {"translation", {5, 0, 0}}}};
    builder.json["scenes"][0]["nodes"] = {1, 2};
    const Scene scene = read_scene_both(builder).scene;
    ASSERT_EQ(scene.nodes.size(), 3U);
    EXPECT_EQ(scene.nodes[0].name, "root");
    EXPECT_EQ(scene.nodes[0].parent, no_index);
    EXPECT_EQ(scene.nodes[1].name, "leaf");
    EXPECT_EQ(scene.nodes[1].parent, 0U);
    EXPECT_EQ(scene.nodes[1].to_world, (Affine{{{{2, 0, 0}, {0, 4, 0}, {0, 0, 8}}}, {2, 8, 24}}));
    EXPECT_EQ(scene.nodes[2].name, "empty");
    EXPECT_EQ(scene.nodes[2].parent, no_index);
    EXPECT_EQ(scene.nodes[2].to_world, (Affine{{}, {5, 0, 0}}));
    EXPECT_EQ(scene.triangle_nodes, std::vector<std::uint32_t>{1});
    EXPECT_EQ(corners(scene.model, 0)[1], (Vec3f{4, 8, 24}));
}

TEST(SceneNodes, EveryTriangleKnowsItsNode) {
    GltfBuilder builder = triangle();
    // The second mesh: a triangle without area, which is dropped, and a good one.
    const int positions =
        builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5}, "VEC3");
    builder.add_mesh({{"POSITION", positions}});
    builder.json["nodes"][0]["name"] = "a";
    builder.json["nodes"][1]["name"] = "b";
    builder.json["nodes"].push_back({{"mesh", 0}, {"name", "c"}, {"translation", {0, 0, 9}}});
    builder.json["scenes"][0]["nodes"] = {1, 0, 2};
    const SceneResult result = read_scene_both(builder);
    const Scene& scene = result.scene;
    EXPECT_EQ(result.report.dropped_degenerate, 1U);
    ASSERT_EQ(scene.triangle_nodes.size(), 3U);
    const auto node_of = [&](std::size_t triangle) {
        return scene.nodes[scene.triangle_nodes[triangle]].name;
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const float z = corners(scene.model, i)[0].z;
        EXPECT_EQ(node_of(i), z == 0 ? "a" : z == 5 ? "b" : "c") << z;
    }
}

TEST(SceneNodes, ANodeBelowTwoParentsIsTwoNodes) {
    GltfBuilder builder = triangle();
    builder.json["nodes"] = {{{"name", "shared"}, {"mesh", 0}},
                             {{"children", {0}}, {"translation", {1, 0, 0}}},
                             {{"children", {0}}, {"translation", {2, 0, 0}}}};
    builder.json["scenes"][0]["nodes"] = {1, 2};
    const Scene scene = read_scene_both(builder).scene;
    ASSERT_EQ(scene.nodes.size(), 4U);
    ASSERT_EQ(scene.triangle_nodes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const SceneNode& node = scene.nodes[scene.triangle_nodes[i]];
        EXPECT_EQ(node.name, "shared");
        EXPECT_EQ(node.to_world.translation.x, double(corners(scene.model, i)[0].x));
        EXPECT_EQ(scene.nodes[node.parent].to_world, node.to_world);
    }
}

TEST(SceneNodes, EveryInstanceIsANode) {
    GltfBuilder builder = triangle();
    const int places = builder.add_accessor<float>({0, 0, 1, 0, 0, 2}, "VEC3");
    builder.json["nodes"] = {
        {{"name", "many"},
         {"mesh", 0},
         {"translation", {0, 0, 10}},
         {"children", {1}},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}},
        {{"name", "child"}, {"mesh", 0}}};
    builder.json["scenes"][0]["nodes"] = {0};
    const Scene scene = read_scene_both(builder).scene;
    ASSERT_EQ(scene.nodes.size(), 4U);
    EXPECT_EQ(scene.nodes[0].name, "") << "what is replaced by name is the instances";
    for (std::uint32_t i = 1; i < 3; ++i) {
        EXPECT_EQ(scene.nodes[i].name, "many");
        EXPECT_EQ(scene.nodes[i].parent, 0U);
        EXPECT_EQ(scene.nodes[i].to_world, (Affine{{}, {0, 0, 10.0 + i}}));
    }
    EXPECT_EQ(scene.nodes[3].name, "child");
    EXPECT_EQ(scene.nodes[3].parent, 0U);
    EXPECT_EQ(scene.triangle_nodes, (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(SceneNodes, OnlyThoseOfTheScene) {
    GltfBuilder builder = triangle();
    builder.json["nodes"].push_back({{"name", "outside"}, {"mesh", 0}});
    const Scene scene = read_scene_both(builder).scene;
    EXPECT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "");
}

TEST(SceneNodes, ATransformThatIsNotFiniteIsRefused) {
    GltfBuilder builder = triangle();
    builder.json["nodes"].push_back({{"scale", {1e200, 1, 1}}, {"children", {2}}});
    builder.json["nodes"].push_back({{"scale", {1e200, 1, 1}}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    const std::string message = scene_refusal(builder);
    EXPECT_NE(message.find("nodes[2]: its transform or that of a parent is not finite"), std::string::npos)
        << message;
}

TEST(SceneNodes, NamesMustNotMultiply) {
    GltfBuilder builder = triangle();
    builder.json["nodes"][0]["name"] = std::string(1 << 16, 'x');
    // Twelve levels of two paths each: 4096 drawings of the one node.
    std::size_t below = 0;
    for (int level = 0; level < 12; ++level) {
        builder.json["nodes"].push_back({{"children", {below}}});
        builder.json["nodes"].push_back({{"children", {below}}});
        builder.json["nodes"].push_back({{"children", {below + 1, below + 2}}});
        below += 3;
    }
    builder.json["scenes"][0]["nodes"] = {below};
    EXPECT_EQ(refusal(builder), "imported");
    const std::string message = scene_refusal(builder);
    EXPECT_NE(message.find("multiply the names"), std::string::npos) << message;
}

TEST(SceneNodes, AllThatAModelIsRefusedForASceneIsToo) {
    GltfBuilder builder = triangle();
    builder.json["accessors"][0]["count"] = 4;
    const auto without_path = [](const std::string& message) {
        return message.substr(message.find("a.glb"));
    };
    EXPECT_EQ(without_path(scene_refusal(builder)), without_path(refusal(builder)));
}

} // namespace
} // namespace spa::test
