// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/plan/scene_objects.h"
#include "../../samples/samples.h"
#include "../../samples/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

using namespace spa;
using namespace spa::plan;

Scene empty_scene() {
    Scene scene;
    scene.model.materials.resize(2);
    return scene;
}

// `model` in the world as the node's mesh.
std::uint32_t add(Scene& scene, const Model& model, const Affine& to_world, std::uint32_t parent = no_index,
                  std::uint32_t material = 0) {
    const auto node = std::uint32_t(scene.nodes.size()), first = std::uint32_t(scene.model.positions.size());
    scene.nodes.push_back({"node " + std::to_string(node), parent, to_world});
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        scene.model.positions.push_back(to_float(transform_point(to_world, to_double(model.positions[i]))));
        scene.model.normals.push_back(
            to_float(normalize(normal_matrix(to_world.linear) * to_double(model.normals[i]))));
    }
    const bool mirrored = determinant(to_world.linear) < 0;
    for (Triangle triangle : model.triangles) {
        for (std::uint32_t& vertex : triangle.vertex) vertex += first;
        if (mirrored) std::swap(triangle.vertex[1], triangle.vertex[2]);
        scene.model.triangles.push_back(triangle);
        scene.model.triangle_materials.push_back(material);
        scene.triangle_nodes.push_back(node);
    }
    return node;
}

Affine placed(double size, Vec3d at) { return {{{{0, 0, size}, {0, size, 0}, {-size, 0, 0}}}, at}; }

TEST(SceneObjects, AreTopmostNodesThatDraw) {
    Scene scene = empty_scene();
    const Model cube = samples::make_sample("cube", 0);
    scene.nodes.push_back({"group", no_index, {}});
    const std::uint32_t table = add(scene, cube, {}, 0);
    add(scene, cube, placed(0.5, {2, 0, 0}), table); // below it: no object of its own
    const std::uint32_t other = add(scene, cube, placed(0.5, {5, 0, 0}), 0);
    const std::vector<SceneObject> objects = find_objects(scene);
    ASSERT_EQ(objects.size(), 2U);
    EXPECT_EQ(objects[0].node, table);
    EXPECT_EQ(objects[0].triangles.size(), 2 * cube.triangles.size());
    EXPECT_EQ(objects[1].node, other);
    const std::vector<std::uint32_t> of_triangle = object_of_triangles(scene, objects);
    EXPECT_EQ(std::count(of_triangle.begin(), of_triangle.end(), 0U),
              std::ptrdiff_t(2 * cube.triangles.size()));
    EXPECT_EQ(of_triangle.back(), 1U);
}

TEST(SceneObjects, OfOneMeshAreInstances) {
    Scene scene = empty_scene();
    const Model smooth = samples::make_sample("smooth", 1);
    add(scene, smooth, {});
    add(scene, smooth, placed(0.01, {3, -2, 7}));
    add(scene, smooth, placed(-2, {30, 0, 0}));            // mirrored: its triangles turn the other way round
    add(scene, smooth, placed(1, {0, 4, 0}), no_index, 1); // of another material
    Model bent = smooth;
    bent.positions[17].x += 0.01F;
    add(scene, bent, placed(1, {0, 0, 9}));
    const std::vector<SceneObject> objects = find_objects(scene);
    ASSERT_EQ(objects.size(), 5U);
    EXPECT_EQ(objects[0].same_as, no_index);
    EXPECT_EQ(objects[1].same_as, 0U);
    EXPECT_EQ(objects[2].same_as, no_index);
    EXPECT_EQ(objects[3].same_as, no_index);
    EXPECT_EQ(objects[4].same_as, no_index);
}

TEST(SceneObjects, GiveTheirMeshInTheirOwnSpace) {
    Scene scene = empty_scene();
    const Model smooth = samples::make_sample("smooth", 1);
    add(scene, samples::make_sample("cube", 0), {});
    add(scene, smooth, placed(0.2, {1, 2, 3}));
    add(scene, smooth, placed(-0.2, {1, 2, 3}));
    const std::vector<SceneObject> objects = find_objects(scene);
    for (const std::size_t i : {1U, 2U}) {
        const Model model = object_model(scene, objects[i]);
        ASSERT_EQ(model.triangles.size(), smooth.triangles.size());
        ASSERT_EQ(model.positions.size(), smooth.positions.size());
        for (std::size_t t = 0; t < smooth.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = model.triangles[t].vertex[k], w = smooth.triangles[t].vertex[k];
                ASSERT_LE(length(model.positions[v] - smooth.positions[w]), 1e-5F);
                ASSERT_LE(length(model.normals[v] - smooth.normals[w]), 1e-5F);
            }
        EXPECT_NEAR(objects[i].radius, 0.2, 0.05);
        EXPECT_LE(length(objects[i].center - Vec3d{1, 2, 3}), 0.05);
    }
}

TEST(SceneObjects, WithoutInverseAreSaidToHaveNone) {
    Scene scene = empty_scene();
    add(scene, samples::make_sample("cube", 0), {{{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}}, {}});
    const std::vector<SceneObject> objects = find_objects(scene);
    ASSERT_EQ(objects.size(), 1U);
    EXPECT_FALSE(objects[0].invertible);
}

TEST(SceneObjects, OfTheRoomAreManyWithInstances) {
    const Scene scene = samples::make_scene("room", 0);
    const std::vector<SceneObject> objects = find_objects(scene);
    EXPECT_GE(objects.size(), 30U);
    std::size_t instances = 0, triangles = 0;
    for (const SceneObject& object : objects) {
        instances += object.same_as != no_index ? 1 : 0;
        triangles += object.triangles.size();
    }
    EXPECT_EQ(triangles, scene.model.triangles.size());
    EXPECT_GE(instances, 10U); // pebbles and columns
}

} // namespace
