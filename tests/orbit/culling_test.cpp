// SPDX-License-Identifier: Apache-2.0
#include "fixture.h"

#include "../../libspa/bake/orbit_culling.h"

#include <cmath>
#include <random>

namespace spa::test {
namespace {

using bake::DirectionBound;
using bake::ViewTree;

std::vector<Vec3f> directions(const Grid& grid) {
    std::vector<Vec3f> result;
    for (std::size_t s = 0; s < sample_count(grid); ++s) result.push_back(to_float(unit_direction(grid, s)));
    return result;
}

ViewTree tree_of(const Grid& grid) {
    ViewTree tree(directions(grid), grid.width, grid.height);
    tree.set_wanted(std::vector<std::uint8_t>(sample_count(grid), 1));
    return tree;
}

// Whether the ray along u meets the triangle.
bool meets(const std::array<Vec3d, 3>& p, Vec3d u) {
    const double d = dot(p[0], cross(p[1], p[2]));
    const auto side = [&](std::size_t i, std::size_t j) {
        return dot(cross(p[i], p[j]), u) * (d < 0 ? -1 : 1);
    };
    return side(0, 1) >= 0 && side(1, 2) >= 0 && side(2, 0) >= 0;
}

std::array<Vec3d, 3> random_triangle(std::mt19937& random, double size, double thinness) {
    const auto uniform = [&] { return double(random()) / 2147483648.0 - 1; };
    const auto vector = [&] { return Vec3d{uniform(), uniform(), uniform()}; };
    const Vec3d a = vector();
    const Vec3d along = vector() * size;
    return {a, a + along, a + along * 0.5 + vector() * (size * thinness)};
}

TEST(Culling, NoViewThatMeetsATriangleIsLeftOut) {
    std::mt19937 random(5);
    for (const Grid& grid : {octahedral(32), latlong(48, 31)}) {
        const ViewTree tree = tree_of(grid);
        for (int i = 0; i < 1500; ++i) {
            const double size = std::pow(10.0, -3.0 * (i % 11) / 10 + 0.7);
            const auto triangle = random_triangle(random, size, i % 3 == 0 ? 0.001 : 1);
            std::vector<bool> candidate(sample_count(grid), false);
            tree.visit(bake::bound_directions(triangle), 1, [&](std::uint32_t v) {
                EXPECT_FALSE(candidate[v]) << "twice";
                candidate[v] = true;
            });
            for (std::size_t s = 0; s < sample_count(grid); ++s) {
                if (meets(triangle, unit_direction(grid, s))) {
                    ASSERT_TRUE(candidate[s]) << name_of(grid) << " triangle " << i << " sample " << s;
                }
            }
        }
    }
}

// Bounds that are too wide would be slow, not wrong.
TEST(Culling, FewViewsAreDrawnInVain) {
    std::mt19937 random(6);
    const Grid grid = latlong(256, 192);
    const ViewTree tree = tree_of(grid);
    for (const double thinness : {1.0, 0.001}) {
        std::size_t candidates = 0;
        std::size_t met = 0;
        std::size_t triangles = 0;
        while (triangles < 300) {
            const auto triangle = random_triangle(random, 0.3, thinness);
            if (length(triangle[0]) < 0.7) continue;
            ++triangles;
            tree.visit(bake::bound_directions(triangle), 1, [&](std::uint32_t v) {
                ++candidates;
                if (meets(triangle, unit_direction(grid, v))) ++met;
            });
        }
        // Needles are thinner than the distance between views: few meet any.
        if (thinness < 1)
            EXPECT_LT(candidates, 300U * 4);
        else
            EXPECT_LT(candidates, 6 * met);
    }
}

TEST(Culling, OnlyWantedViewsAreVisited) {
    const Grid grid = octahedral(16);
    ViewTree tree(directions(grid), grid.width, grid.height);
    const DirectionBound all = bake::bound_directions({Vec3d{1, 0, 0}, Vec3d{-1, 0.1, 0}, Vec3d{0, 0, 1}});
    const auto count = [&](std::uint8_t mask) {
        std::size_t n = 0;
        tree.visit(all, mask, [&](std::uint32_t) { ++n; });
        return n;
    };
    EXPECT_EQ(count(3), 0U);
    std::vector<std::uint8_t> wanted(sample_count(grid), 0);
    wanted[7] = 1;
    wanted[200] = 2;
    tree.set_wanted(wanted);
    EXPECT_EQ(count(1), 1U);
    EXPECT_EQ(count(2), 1U);
    EXPECT_EQ(count(3), 2U);
}

} // namespace
} // namespace spa::test
