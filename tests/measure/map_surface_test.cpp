// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/map_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <utility>

namespace spa::measure {
namespace {

double area(const MapSurface& surface) {
    double sum = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3d a = to_double(surface.positions[t.vertex[0]]);
        sum += length(cross(to_double(surface.positions[t.vertex[1]]) - a,
                            to_double(surface.positions[t.vertex[2]]) - a)) /
               2;
    }
    return sum;
}

// Signed volume: positive if all triangles face outwards.
double volume(const MapSurface& surface) {
    double sum = 0;
    for (const Triangle& t : surface.triangles)
        sum +=
            dot(to_double(surface.positions[t.vertex[0]]),
                cross(to_double(surface.positions[t.vertex[1]]), to_double(surface.positions[t.vertex[2]]))) /
            6;
    return sum;
}

class MapSurfaceOf : public testing::TestWithParam<Grid> {};

TEST_P(MapSurfaceOf, ConstantDepthIsAClosedSphere) {
    const Grid grid = GetParam();
    const std::vector<double> depth(std::size_t(grid.width) * grid.height, 0.5);
    MapSurface surface;
    append_surface(grid, depth, Mat3{}, surface);
    EXPECT_EQ(surface.positions.size(), depth.size());
    EXPECT_NEAR(area(surface), std::numbers::pi, 0.01 * std::numbers::pi);
    EXPECT_NEAR(volume(surface), std::numbers::pi / 6, 0.01 * std::numbers::pi / 6);
}

INSTANTIATE_TEST_SUITE_P(Grids, MapSurfaceOf,
                         testing::Values(Grid{Mapping::octahedral, 65, 65}, Grid{Mapping::latlong, 96, 48}));

// The octahedron |x| + |y| + |z| = 1 is flat between the folds, so it is exact at any size if no triangle
// crosses one: its area is 4 sqrt(3), its volume 4/3.
TEST(MapSurface, OfAnOctahedronIsTheOctahedron) {
    const Grid grid{Mapping::octahedral, 9, 9};
    std::vector<double> depth;
    for (std::uint32_t y = 0; y < 9; ++y)
        for (std::uint32_t x = 0; x < 9; ++x) depth.push_back(length(sample_direction(grid, {x, y})));
    MapSurface surface;
    append_surface(grid, depth, Mat3{}, surface);
    EXPECT_NEAR(area(surface), 4 * std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(volume(surface), 4.0 / 3, 1e-6);
}

TEST(MapSurface, ShrinksToWhatIsCovered) {
    const Grid grid{Mapping::octahedral, 5, 5};
    std::vector<double> depth(25, 0);
    MapSurface surface;
    append_surface(grid, depth, Mat3{}, surface);
    EXPECT_TRUE(surface.triangles.empty());
    depth[7] = 1; // one sample alone
    append_surface(grid, depth, Mat3{}, surface);
    ASSERT_FALSE(surface.triangles.empty());
    for (const Triangle& t : surface.triangles)
        for (const std::uint32_t v : t.vertex) EXPECT_EQ(v, 25U + 7U);
}

TEST(MapSurface, GoesThroughTheFrame) {
    const Grid grid{Mapping::octahedral, 3, 3};
    const std::vector<double> depth(9, 1);
    const Mat3 frame{{{2, 0, 0}, {0, 3, 0}, {0, 0, 4}}};
    MapSurface surface;
    append_surface(grid, depth, frame, surface);
    EXPECT_EQ(surface.positions[4], (Vec3f{0, 0, 4}));
    EXPECT_EQ(surface.positions[1], (Vec3f{0, 3, 0}));
    EXPECT_EQ(surface.positions[5], (Vec3f{2, 0, 0}));
}

} // namespace
} // namespace spa::measure
