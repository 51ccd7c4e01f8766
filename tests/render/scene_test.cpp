// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/error.h"
#include "../../libspa/render/scene_triangles.h"
#include "scenes.h"

#include <gtest/gtest.h>

namespace spa::render {
namespace {

// root draws a square; below it are "a", with "b" below that, and "c".
class SceneGroups : public testing::Test {
protected:
    SceneGroups() {
        const std::uint32_t root = test::add_node(scene, "root");
        a = test::add_node(scene, "a", {}, root);
        b = test::add_node(scene, "b", {}, a);
        c = test::add_node(scene, "c", {}, root);
        for (const std::uint32_t node : {b, root, c, a})
            test::add_model(scene, node,
                            test::square({float(node), 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1, 1}));
        scene.model.materials.back().alpha_mode = AlphaMode::mask; // of a's square
    }

    Scene scene;
    std::uint32_t a = 0, b = 0, c = 0;
    SphericalMap map;
};

TEST_F(SceneGroups, AreThoseOfSubtrees) {
    const MapPlacement placements[] = {{c, &map}, {a, &map}};
    const std::vector<std::uint32_t> objects = objects_of_nodes(scene, placements);
    EXPECT_EQ(objects, (std::vector<std::uint32_t>{0, 2, 2, 1}));

    const SceneTriangles all = group_triangles(scene, objects, 2, true);
    ASSERT_EQ(all.groups.size(), 4U); // root; c; b, opaque; a
    EXPECT_EQ(all.groups[0].object, 0U);
    EXPECT_EQ(all.groups[1].object, 1U);
    EXPECT_EQ(all.groups[2].object, 2U);
    EXPECT_FALSE(all.groups[2].alpha);
    EXPECT_TRUE(all.groups[3].alpha);
    EXPECT_EQ(all.triangles.size(), 8U);
    for (const TriangleGroup& group : all.groups) {
        EXPECT_EQ(group.triangle_count, 2U);
        EXPECT_EQ(group.vertex_count, 4U);
        for (std::uint32_t i = 0; i < group.triangle_count; ++i) {
            for (const std::uint32_t vertex : all.triangles[group.first_triangle + i].vertex) {
                EXPECT_GE(vertex, group.first_vertex);
                EXPECT_LT(vertex, group.first_vertex + group.vertex_count);
            }
        }
    }
    const SceneTriangles rest = group_triangles(scene, objects, 2, false);
    ASSERT_EQ(rest.groups.size(), 1U);
    EXPECT_EQ(rest.positions.size(), 4U);
    EXPECT_EQ(rest.positions.front().x, -1); // of root's square, which is about 0
}

TEST_F(SceneGroups, WantPlacementsThatExistAndDoNotOverlap) {
    const MapPlacement nested[] = {{b, &map}, {a, &map}};
    EXPECT_THROW(objects_of_nodes(scene, nested), Error);
    const MapPlacement twice[] = {{a, &map}, {a, &map}};
    EXPECT_THROW(objects_of_nodes(scene, twice), Error);
    const MapPlacement no_node[] = {{4, &map}};
    EXPECT_THROW(objects_of_nodes(scene, no_node), Error);
    const MapPlacement no_map[] = {{a, nullptr}};
    EXPECT_THROW(objects_of_nodes(scene, no_map), Error);
}

} // namespace
} // namespace spa::render
