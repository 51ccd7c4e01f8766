// SPDX-License-Identifier: Apache-2.0
// Models in pieces, and maps of several parts.
#include "../../libspa/bake/auto_parts.h"
#include "../../libspa/bake/bake_parts.h"
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/partition.h"
#include "../../libspa/mesh/piece_model.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace spa::bake {
namespace {

Options small(std::uint32_t layers = 2) {
    Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 33, 33};
    options.layers = layers;
    return options;
}

Model three_spheres() {
    Model model = test::empty_model();
    test::add_sphere(model, {-4, 0, 0}, 1, 8);
    test::add_sphere(model, {0, 0, 0}, 2, 8);
    test::add_sphere(model, {5, 0, 0}, 0.5F, 8);
    return model;
}

// Every triangle in at least one piece.
std::size_t covered(const Partition& partition) {
    std::set<std::uint32_t> all;
    for (const Piece& piece : partition) all.insert(piece.triangles.begin(), piece.triangles.end());
    return all.size();
}

Scene two_boxes() {
    Scene scene;
    scene.model = test::empty_model();
    test::add_box(scene.model, {-1, -1, -1}, {1, 1, 1});
    const std::size_t first = scene.model.triangles.size();
    test::add_box(scene.model, {9, -1, -1}, {11, 1, 1});
    scene.nodes = {{"root", no_index, {}}, {"left", 0, {}}, {"right", 0, {}}};
    scene.nodes[2].to_world.translation = {10, 0, 0};
    for (std::uint32_t n = 0; n < 3; ++n) scene.nodes[n].source = 7 + n;
    scene.triangle_nodes.assign(first, 1);
    scene.triangle_nodes.resize(scene.model.triangles.size(), 2);
    return scene;
}

// A strip of quads along x from 0 to 1: the first bone lets go of it where the second takes hold.
Scene arm() {
    constexpr std::uint32_t quads = 10;
    Scene scene;
    scene.model = test::empty_model();
    for (std::uint32_t i = 0; i < quads; ++i) {
        const float from = float(i) / quads, to = float(i + 1) / quads;
        test::add_quad(scene.model, {from, 0, 0}, {to, 0, 0}, {to, 0.1F, 0}, {from, 0.1F, 0});
    }
    scene.nodes = {{"upper", no_index, {}}, {"lower", 0, {}}};
    scene.nodes[0].source = 3;
    scene.nodes[1].source = 4;
    scene.nodes[1].to_world.translation = {0.5, 0, 0};
    scene.triangle_nodes.assign(scene.model.triangles.size(), 0);
    Rig& rig = scene.rig;
    rig.bones = {{0, 0, 0, {}}, {1, 0, 1, {}}};
    for (const Vec3f p : scene.model.positions) {
        rig.first.push_back(std::uint32_t(rig.influences.size()));
        const float lower = std::clamp((p.x - 0.44F) / 0.2F, 0.0F, 1.0F);
        if (lower < 1) rig.influences.push_back({0, 1 - lower});
        if (lower > 0) rig.influences.push_back({1, lower});
    }
    rig.first.push_back(std::uint32_t(rig.influences.size()));
    return scene;
}

TEST(Partition, ComponentsAreThePieces) {
    const Model model = three_spheres();
    const Partition partition = divide_by_components(model, 10);
    ASSERT_EQ(partition.size(), 3U);
    EXPECT_EQ(covered(partition), model.triangles.size());
    for (const Piece& piece : partition) EXPECT_EQ(piece.node, -1);
}

TEST(Partition, TheSmallestComponentGoesToItsNearest) {
    const Model model = three_spheres();
    const Partition two = divide_by_components(model, 2);
    ASSERT_EQ(two.size(), 2U);
    // The small sphere is 5 from the middle one and 9 from the other.
    EXPECT_EQ(two[0].triangles.size() * 2, two[1].triangles.size());
    EXPECT_EQ(two[0].triangles.front(), 0U);
    EXPECT_EQ(divide_by_components(model, 1).size(), 1U);
}

TEST(Partition, NodesHoldWhatTheyDraw) {
    const Scene scene = two_boxes();
    const Partition partition = divide_by_nodes(scene, 2);
    ASSERT_EQ(partition.size(), 2U);
    EXPECT_EQ(partition[0].name, "left");
    EXPECT_EQ(partition[0].node, 8);
    EXPECT_EQ(partition[1].node, 9);
    EXPECT_EQ(partition[1].joint, -1);
    // The middle of the right box is its node's origin.
    EXPECT_EQ(transform_point(partition[1].to_node, {10, 0, 0}), (Vec3d{0, 0, 0}));
    EXPECT_THROW(divide_by_nodes(scene, 1), Error);
}

TEST(Partition, ANodeWithoutInverseIsAnError) {
    Scene scene = two_boxes();
    scene.nodes[2].to_world.linear.row[0] = {};
    EXPECT_THROW(divide_by_nodes(scene, 9), Error);
}

TEST(Partition, BonesShareWhereTheSurfaceBends) {
    const Scene scene = arm();
    const Partition partition = divide_by_bones(scene, 2);
    ASSERT_EQ(partition.size(), 2U);
    EXPECT_EQ(covered(partition), scene.model.triangles.size());
    EXPECT_EQ(partition[0].joint, 0);
    EXPECT_EQ(partition[1].joint, 1);
    EXPECT_EQ(partition[1].node, 4);
    // The corners at x = 0.5 have 0.7 of their weight from the upper bone, those at 0.6 have 0.8 from the
    // lower one: what lies between is shared.
    std::vector<std::uint32_t> shared;
    std::set_intersection(partition[0].triangles.begin(), partition[0].triangles.end(),
                          partition[1].triangles.begin(), partition[1].triangles.end(),
                          std::back_inserter(shared));
    EXPECT_EQ(shared, (std::vector<std::uint32_t>{10, 11}));
}

TEST(Partition, PiecesTakeOnlyWhatTheyUse) {
    Model model = three_spheres();
    test::add_random_texture(model, 8, 1);
    Material plain;
    plain.name = "plain";
    model.materials.push_back(plain);
    model.triangle_materials.front() = 1;
    const std::vector<std::uint32_t> first{0}, second{1, 2};
    const Model one = piece_model(model, first), two = piece_model(model, second);
    EXPECT_EQ(one.materials.size(), 1U);
    EXPECT_EQ(one.materials[0].name, "plain");
    EXPECT_TRUE(one.textures.empty());
    EXPECT_EQ(two.textures.size(), 1U);
    EXPECT_EQ(one.positions.size(), 3U);
    for (unsigned k = 0; k < 3; ++k)
        EXPECT_EQ(one.positions[one.triangles[0].vertex[k]], model.positions[model.triangles[0].vertex[k]]);
}

TEST(Partition, OneRingIsWhatTouches) {
    const Scene scene = arm();
    Partition partition(2);
    for (std::uint32_t t = 0; t < 20; ++t) partition[t < 10 ? 0 : 1].triangles.push_back(t);
    overlap_by_one_ring(scene.model, partition);
    // Quads have vertices of their own; those at one place are one. A quad's neighbour has both triangles on
    // the border's vertices.
    EXPECT_EQ(partition[0].triangles.back(), 11U);
    EXPECT_EQ(partition[1].triangles.front(), 8U);
}

TEST(BakeParts, EveryPartIsTheBakeOfItsPiece) {
    const Model model = three_spheres();
    const Partition partition = divide_by_components(model, 10);
    const PartsResult parts = bake_parts(model, partition, small());
    ASSERT_EQ(parts.map.map.parts.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const Result alone = bake_model(piece_model(model, partition[i].triangles), small());
        const Part& a = parts.map.map.parts[i];
        const Part& b = alone.map.map.parts[0];
        EXPECT_EQ(a.center, b.center);
        EXPECT_EQ(a.radius, b.radius);
        const auto pixels = [](const Part& part) { return part.layers[0].outer.depth.bytes; };
        EXPECT_TRUE(std::equal(pixels(a).begin(), pixels(a).end(), pixels(b).begin(), pixels(b).end()));
    }
    const Report whole = sum(parts.reports, partition);
    EXPECT_EQ(whole.triangles, model.triangles.size());
    EXPECT_EQ(whole.components, 3U);
}

TEST(BakeParts, ThePartSaysWhatItFollows) {
    const Scene scene = two_boxes();
    const PartsResult parts = bake_parts(scene.model, divide_by_nodes(scene, 9), small());
    EXPECT_EQ(parts.map.map.parts[1].node, 9);
    EXPECT_EQ(parts.map.map.parts[1].to_node.translation, (Vec3d{-10, 0, 0}));
}

TEST(AutoParts, WhatOneSphereHoldsStaysWhole) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 1, 8);
    EXPECT_EQ(divide_by_need(model, 1, 16).size(), 1U);
    EXPECT_NEAR(held_share(model, 1), 1, 1e-9);
}

TEST(AutoParts, DividesUntilTheSurfaceIsHeld) {
    // Two spheres, one behind the other half the time.
    Model model = three_spheres();
    test::add_sphere(model, {0, 0, 0}, 1.8F, 8, true);
    ASSERT_LT(held_share(model, 1), 0.9);
    EXPECT_GT(held_share(model, 2), held_share(model, 1));
    const Partition partition = divide_by_need(model, 1, 16);
    EXPECT_GT(partition.size(), 1U);
    EXPECT_LE(partition.size(), 16U);
    EXPECT_EQ(covered(partition), model.triangles.size());
    EXPECT_LE(divide_by_need(model, 1, 2).size(), 2U);
    const auto held = [&](const Partition& pieces) {
        double share = 0;
        for (const Piece& piece : pieces)
            share += held_share(piece_model(model, piece.triangles), 1) / double(pieces.size());
        return share;
    };
    EXPECT_GT(held(partition), held_share(model, 1));
}

} // namespace
} // namespace spa::bake
