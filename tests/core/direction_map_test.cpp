// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/direction_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace spa {
namespace {

const std::vector<Grid> grids{{Mapping::octahedral, 3, 3},   {Mapping::octahedral, 5, 5},
                              {Mapping::octahedral, 65, 65}, {Mapping::octahedral, 99, 99},
                              {Mapping::latlong, 1, 1},      {Mapping::latlong, 7, 5},
                              {Mapping::latlong, 64, 32},    {Mapping::latlong, 640, 480}};

template <class Visit>
void each_texel(const Grid& grid, Visit&& visit) {
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) visit(TexelIndex{x, y});
    }
}

TEST(DirectionMap, KnownDirectionsOfTheOctahedralMap) {
    const Grid grid{Mapping::octahedral, 5, 5};
    EXPECT_EQ(sample_direction(grid, {2, 2}), (Vec3d{0, 0, 1}));
    EXPECT_EQ(sample_direction(grid, {4, 2}), (Vec3d{1, 0, 0}));
    EXPECT_EQ(sample_direction(grid, {2, 0}), (Vec3d{0, 1, 0}));
    EXPECT_EQ(sample_direction(grid, {0, 2}), (Vec3d{-1, 0, 0}));
    EXPECT_EQ(sample_direction(grid, {2, 4}), (Vec3d{0, -1, 0}));
    for (const TexelIndex corner : {TexelIndex{0, 0}, TexelIndex{4, 0}, TexelIndex{0, 4}, TexelIndex{4, 4}}) {
        EXPECT_EQ(sample_direction(grid, corner), (Vec3d{0, 0, -1}));
    }
}

TEST(DirectionMap, KnownDirectionsOfTheLatlongMap) {
    const Grid grid{Mapping::latlong, 4, 2};
    const double h = std::numbers::sqrt2 / 2;
    const Vec3d u = direction_at(grid, {1.5, -0.5});
    EXPECT_NEAR(u.y, 1, 1e-15);
    const Vec3d front = direction_at(grid, {1.5, 0.5});
    EXPECT_NEAR(front.z, 1, 1e-15);
    const Vec3d right = direction_at(grid, {2.5, 0.5});
    EXPECT_NEAR(right.x, 1, 1e-15);
    const Vec3d up_front_right = direction_at(grid, {2, 0});
    EXPECT_NEAR(up_front_right.y, h, 1e-15);
    EXPECT_NEAR(up_front_right.x, h * h, 1e-15);
    EXPECT_NEAR(up_front_right.z, h * h, 1e-15);
}

TEST(DirectionMap, SamplesHaveTheNormTheyPromise) {
    for (const Grid& grid : grids) {
        each_texel(grid, [&](TexelIndex t) {
            const Vec3d g = sample_direction(grid, t);
            const double norm = grid.mapping == Mapping::octahedral
                                    ? std::abs(g.x) + std::abs(g.y) + std::abs(g.z)
                                    : length(g);
            ASSERT_NEAR(norm, 1, 1e-14);
        });
    }
}

TEST(DirectionMap, PositionIsTheInverseOfDirection) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (const Grid& grid : grids) {
        for (int i = 0; i < 2000; ++i) {
            const Vec3d u = normalize(Vec3d{normal(random), normal(random), normal(random)});
            const Vec2d p = position_of(grid, u * 3.0);
            const Vec3d back = direction_at(grid, p);
            ASSERT_NEAR(length(back - u), 0, 1e-12);
        }
    }
}

TEST(DirectionMap, IdentifiedBorderSamplesAreBitEqual) {
    for (const Grid& grid : grids) {
        each_texel(grid, [&](TexelIndex t) {
            ASSERT_EQ(sample_direction(grid, t), sample_direction(grid, canonical(grid, t)));
            ASSERT_EQ(canonical(grid, canonical(grid, t)), canonical(grid, t));
        });
    }
    const Grid grid{Mapping::octahedral, 9, 9};
    EXPECT_EQ(canonical(grid, {8, 6}), (TexelIndex{8, 2}));
    EXPECT_EQ(canonical(grid, {6, 0}), (TexelIndex{2, 0}));
    EXPECT_EQ(canonical(grid, {8, 8}), (TexelIndex{0, 0}));
}

// A step over the border must land near where it left: the direction to the wrapped neighbour is never
// farther than a few cells.
TEST(DirectionMap, WrapIsContinuous) {
    for (const Grid& grid : {Grid{Mapping::octahedral, 65, 65}, Grid{Mapping::latlong, 64, 32}}) {
        const std::int64_t w = grid.width;
        const std::int64_t h = grid.height;
        for (std::int64_t y = -1; y <= h; ++y) {
            for (std::int64_t x = -1; x <= w; ++x) {
                const TexelIndex to = wrap(grid, x, y);
                ASSERT_LT(to.x, grid.width);
                ASSERT_LT(to.y, grid.height);
                const TexelIndex from{std::uint32_t(std::clamp<std::int64_t>(x, 0, w - 1)),
                                      std::uint32_t(std::clamp<std::int64_t>(y, 0, h - 1))};
                const Vec3d a = normalize(sample_direction(grid, from));
                const Vec3d b = normalize(sample_direction(grid, to));
                ASSERT_LT(std::acos(std::min(1.0, dot(a, b))), 0.35) << x << "," << y;
            }
        }
    }
}

TEST(DirectionMap, SolidAnglesSumToTheSphere) {
    for (const Grid& grid : {Grid{Mapping::latlong, 37, 21}, Grid{Mapping::octahedral, 257, 257}}) {
        double sum = 0;
        each_texel(grid, [&](TexelIndex t) { sum += solid_angle(grid, t); });
        EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-3);
    }
}

TEST(DirectionMap, Validity) {
    EXPECT_TRUE(is_valid({Mapping::octahedral, 3, 3}));
    EXPECT_FALSE(is_valid({Mapping::octahedral, 1, 1}));
    EXPECT_FALSE(is_valid({Mapping::octahedral, 4, 4}));
    EXPECT_FALSE(is_valid({Mapping::octahedral, 5, 7}));
    EXPECT_FALSE(is_valid({Mapping::latlong, 0, 7}));
}

} // namespace
} // namespace spa
