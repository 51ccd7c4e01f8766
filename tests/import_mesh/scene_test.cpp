// SPDX-License-Identifier: Apache-2.0
// read_scene of the formats without a hierarchy of their own.
#include "scratch.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

constexpr const char* vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";

Scene read_scene(const std::string& name, const std::string& content) {
    const Scratch scratch;
    const std::filesystem::path path = scratch.write(name, content);
    import::SceneResult result = import::read_scene(path);
    const import::Result model = import::read_model(path);
    expect_valid(model);
    EXPECT_EQ(result.scene.model.positions, model.model.positions);
    EXPECT_EQ(result.scene.model.normals, model.model.normals);
    EXPECT_EQ(result.scene.model.triangle_materials, model.model.triangle_materials);
    EXPECT_EQ(result.report.warnings, model.report.warnings);
    EXPECT_EQ(result.report.format, model.report.format);
    EXPECT_EQ(result.scene.triangle_nodes.size(), model.model.triangles.size());
    EXPECT_TRUE(result.scene.cameras.empty());
    EXPECT_TRUE(result.scene.lights.empty());
    for (const SceneNode& node : result.scene.nodes) EXPECT_EQ(node.to_world, Affine{});
    return result.scene;
}

// "object/group" for each triangle.
std::vector<std::string> nodes_of_triangles(const Scene& scene) {
    std::vector<std::string> names;
    for (const std::uint32_t index : scene.triangle_nodes) {
        const SceneNode& node = scene.nodes.at(index);
        names.push_back(node.parent == no_index ? node.name
                                                : scene.nodes.at(node.parent).name + "/" + node.name);
    }
    return names;
}

using Names = std::vector<std::string>;

TEST(ObjScene, ObjectsAndGroupsAreNodes) {
    const Scene scene = read_scene(
        "t.obj", std::string(vertices) + "f 1 2 3\no house\nf 1 2 3\nf 1 2 4 3\ng roof\nf 1 2 4\n"
                                         "o tree  of mine \nf 2 3 4\ng roof\nf 1 3 4\no house\nf 1 4 2\n");
    EXPECT_EQ(nodes_of_triangles(scene), (Names{"t", "house", "house", "house", "house/roof", "tree  of mine",
                                                "tree  of mine/roof", "house"}));
    EXPECT_EQ(scene.nodes.size(), 5U);
}

TEST(ObjScene, GroupsWithoutAnObjectAreRoots) {
    const Scene scene =
        read_scene("t.obj", std::string(vertices) + "g a b\nf 1 2 3\ng\nf 1 2 4\ng a b\nf 1 3 4\n");
    EXPECT_EQ(nodes_of_triangles(scene), (Names{"a b", "t", "a b"}));
}

TEST(ObjScene, DroppedAndCutFacesKeepTheOthersInPlace) {
    const Scene scene =
        read_scene("t.obj", std::string(vertices) + "v nan 0 0\no a\nf 1 2 5\nf 1 1 1\no b\nf 1 2 4 3\no c\n"
                                                    "f 1 2 5\no d\nf 1 2 3\no e\n");
    EXPECT_EQ(nodes_of_triangles(scene), (Names{"b", "b", "d"}));
}

TEST(ObjScene, AFileWithoutNamesIsOneNode) {
    const Scene scene = read_scene("some file.v2.obj", std::string(vertices) + "f 1 2 3\n");
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "some file.v2");
    EXPECT_EQ(scene.nodes[0].parent, no_index);
}

TEST(OffScene, IsOneNode) {
    const Scene scene = read_scene("shape.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n");
    EXPECT_EQ(nodes_of_triangles(scene), (Names{"shape", "shape"}));
}

TEST(SceneFile, AMissingOneIsSaid) {
    try {
        (void)import::read_scene("no such folder/scene.glb");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_output);
    }
}

} // namespace
} // namespace spa::test
