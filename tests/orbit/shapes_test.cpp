// SPDX-License-Identifier: Apache-2.0
// Shapes whose crossings are known in closed form, and shapes that are hard for a rasteriser.
#include "fixture.h"

#include "../support/shapes.h"

#include <algorithm>
#include <cmath>

namespace spa::test {
namespace {

class OrbitShapes : public OrbitTest {};

double largest_component(Vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Flat faces have no error of tessellation: what is left is arithmetic. Samples of both maps lie exactly on
// edges, diagonals and corners.
TEST_F(OrbitShapes, CubeIsExact) {
    Model model = empty_model();
    add_box(model, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
    bake::CenteredModel cube;
    cube.model = &model;
    cube.positions = model.positions;
    cube.normals = model.normals;
    for (const Grid& grid : {octahedral(64), latlong(128, 96)}) {
        for_each_sample(cast(cube, grid, true), [&](std::size_t s, auto crossings) {
            ASSERT_EQ(crossings.size(), 1U) << name_of(grid) << " sample " << s;
            const Vec3d u = unit_direction(grid, s);
            EXPECT_NEAR(crossings[0].radius, 0.5 / largest_component(u), 1e-7);
            EXPECT_NEAR(dot(to_double(crossings[0].normal), u), largest_component(u), 1e-6);
            EXPECT_TRUE(crossings[0].front_facing);
        });
    }
}

TEST_F(OrbitShapes, OctahedronMeetsTheOctahedralGridInItsEdges) {
    Model model = empty_model();
    model.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    model.normals = model.positions;
    for (const std::uint32_t x : {0U, 1U}) {
        for (const std::uint32_t y : {2U, 3U}) {
            for (const std::uint32_t z : {4U, 5U}) {
                const bool flip = (x + y + z) % 2 == 1;
                model.triangles.push_back({{x, flip ? z : y, flip ? y : z}});
                model.triangle_materials.push_back(0);
            }
        }
    }
    bake::CenteredModel octahedron;
    octahedron.model = &model;
    octahedron.positions = model.positions;
    octahedron.normals = model.normals;
    const Grid grid = octahedral(32);
    for_each_sample(cast(octahedron, grid, true), [&](std::size_t s, auto crossings) {
        ASSERT_EQ(crossings.size(), 1U) << "sample " << s;
        const Vec3d u = unit_direction(grid, s);
        EXPECT_NEAR(crossings[0].radius, 1 / (std::abs(u.x) + std::abs(u.y) + std::abs(u.z)), 1e-7);
    });
}

// Many small triangles, no sample on an edge on purpose: not one gap, not one double hit.
TEST_F(OrbitShapes, SphereIsWatertight) {
    Model model = empty_model();
    const Vec3f center{0.1F, -0.2F, 0.05F};
    constexpr float radius = 0.7F;
    add_sphere(model, center, radius, 200);
    bake::CenteredModel sphere;
    sphere.model = &model;
    sphere.positions = model.positions;
    sphere.normals = model.normals;
    for (const Grid& grid : {octahedral(128), latlong(160, 120)}) {
        for_each_sample(cast(sphere, grid, true), [&](std::size_t s, auto crossings) {
            ASSERT_EQ(crossings.size(), 1U) << name_of(grid) << " sample " << s;
            const Vec3d u = unit_direction(grid, s);
            const Vec3d c = to_double(center);
            const double b = dot(u, c);
            const double expected = b + std::sqrt(b * b - dot(c, c) + double(radius) * radius);
            // The sagitta of a facet, seen at a slant: 0.7 (1 - cos(pi/400 sqrt 2)) / 0.9.
            EXPECT_NEAR(crossings[0].radius, expected, 6e-5);
            const Vec3d n = normalize(u * expected - c);
            EXPECT_LT(length(to_double(crossings[0].normal) - n), 2e-4);
        });
    }
}

TEST_F(OrbitShapes, TorusHasFourCrossingsOrNone) {
    Model model = empty_model();
    constexpr double major = 0.7;
    constexpr double minor = 0.25;
    add_torus(model, float(major), float(minor), 300);
    bake::CenteredModel torus;
    torus.model = &model;
    torus.positions = model.positions;
    torus.normals = model.normals;
    const Grid grid = latlong(96, 72);
    std::size_t met = 0;
    for_each_sample(cast(torus, grid, true), [&](std::size_t s, auto crossings) {
        const Vec3d u = unit_direction(grid, s);
        const double horizontal = std::hypot(u.x, u.z);
        const double discriminant = major * major * horizontal * horizontal - major * major + minor * minor;
        if (std::abs(discriminant) < 1e-3) return; // the silhouette is the tessellation's
        if (discriminant < 0) {
            EXPECT_EQ(crossings.size(), 0U);
            return;
        }
        ++met;
        ASSERT_EQ(crossings.size(), 2U);
        EXPECT_TRUE(crossings[0].front_facing);
        EXPECT_FALSE(crossings[1].front_facing);
        EXPECT_NEAR(crossings[0].radius, major * horizontal + std::sqrt(discriminant), 2e-3);
        EXPECT_NEAR(crossings[1].radius, major * horizontal - std::sqrt(discriminant), 2e-3);
        EXPECT_LT(dot(to_double(crossings[1].normal), u), 0) << "the inner normal looks to the centre";
    });
    EXPECT_GT(met, 1000U);
}

// Triangles around a pole, across the seam, of more than 90 degrees: one tetrahedron has them all.
TEST_F(OrbitShapes, TetrahedronIsClosed) {
    Model model = empty_model();
    model.positions = {{0, 0.9F, 0.1F}, {-0.9F, -0.3F, 0.2F}, {0.8F, -0.4F, 0.3F}, {0.1F, -0.2F, -0.9F}};
    model.normals = model.positions;
    for (const Triangle& t :
         {Triangle{{0, 1, 2}}, Triangle{{0, 2, 3}}, Triangle{{0, 3, 1}}, Triangle{{1, 3, 2}}}) {
        model.triangles.push_back(t);
        model.triangle_materials.push_back(0);
    }
    const bake::CenteredModel tetrahedron = normalized(model);
    for (const Grid& grid : {octahedral(64), latlong(80, 60)}) {
        const bake::CrossingGrid crossings = cast(tetrahedron, grid, true);
        for_each_sample(crossings, [&](std::size_t s, auto list) {
            ASSERT_EQ(list.size(), 1U) << name_of(grid) << " sample " << s;
            EXPECT_TRUE(list[0].front_facing);
        });
        EXPECT_EQ(compare_with_reference(crossings, tetrahedron, true).wrong, 0U);
    }
}

TEST_F(OrbitShapes, FoldedBorderIsEqualToTheBit) {
    const Model model = random_textured_soup(100, 9);
    const Grid grid = octahedral(32);
    const bake::CrossingGrid crossings = cast(normalized(model), grid, true);
    for (std::uint32_t i = 0; i < grid.width; ++i) {
        for (const TexelIndex texel : {TexelIndex{i, 0}, TexelIndex{0, i}}) {
            const TexelIndex same = canonical(grid, texel);
            const std::size_t a = texel.y * grid.width + texel.x;
            const std::size_t b = same.y * grid.width + same.x;
            ASSERT_EQ(crossings.first[a + 1] - crossings.first[a],
                      crossings.first[b + 1] - crossings.first[b]);
            for (std::uint64_t k = 0; k < crossings.first[a + 1] - crossings.first[a]; ++k) {
                EXPECT_TRUE(equal(crossings.crossings[crossings.first[a] + k],
                                  crossings.crossings[crossings.first[b] + k]));
            }
        }
    }
}

TEST_F(OrbitShapes, TrianglesThatNoViewSees) {
    Model model = empty_model();
    // A plane through the centre, a line, a point, and something that is no number.
    model.positions = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {0.5F, 0.5F, 0.5F}, {NAN, 0, 1}};
    model.normals.assign(5, {0, 1, 0});
    for (const Triangle& t :
         {Triangle{{0, 1, 2}}, Triangle{{0, 1, 1}}, Triangle{{3, 3, 3}}, Triangle{{1, 3, 4}}}) {
        model.triangles.push_back(t);
        model.triangle_materials.push_back(0);
    }
    bake::CenteredModel centered;
    centered.model = &model;
    centered.positions = model.positions;
    centered.normals = model.normals;
    for (const bool naive : {false, true}) {
        for (const Grid& grid : {octahedral(16), latlong(16, 9)}) {
            EXPECT_TRUE(cast(centered, grid, true, naive).crossings.empty());
            EXPECT_TRUE(cast(centered, grid, false, naive).crossings.empty());
        }
    }
}

TEST_F(OrbitShapes, NothingIsNothing) {
    Model model = empty_model();
    const Grid grid = octahedral(2);
    bake::CenteredModel centered;
    centered.model = &model;
    const bake::CrossingGrid crossings = cast(centered, grid, false);
    EXPECT_TRUE(crossings.crossings.empty());
    EXPECT_EQ(crossings.first.size(), sample_count(grid) + 1);
}

} // namespace
} // namespace spa::test
