// SPDX-License-Identifier: Apache-2.0
// The text's directions, positions and wrapping against libspa/core/direction_map.
#include "random.h"
#include "trace_image.h"

#include "../../shaders/spa_direction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spa::test {
namespace {

using shader::float2;
using shader::float3;

constexpr double pi = std::numbers::pi;

float2 text_position(const Grid& grid, Vec3d direction) {
    const auto mapping = std::uint32_t(grid.mapping);
    const float2 place =
        shader::spa_place(mapping, {float(direction.x), float(direction.y), float(direction.z)});
    EXPECT_TRUE(place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1);
    return shader::spa_position(mapping, grid.width, grid.height, place);
}

// How far two positions are apart on the sphere, in radian.
double angle_between(const Grid& grid, float2 a, Vec2d b) {
    const Vec3d u = direction_at(grid, {double(a.x), double(a.y)});
    const Vec3d v = direction_at(grid, b);
    return std::atan2(length(cross(u, v)), dot(u, v));
}

TEST(TextDirection, ArcTangentIsExactToAFewRoundings) {
    Random random(1);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const auto y = float(random());
        const auto x = float(random());
        const double error = std::abs(double(shader::spa_atan2(y, x)) - std::atan2(double(y), double(x)));
        worst = std::max(worst, error);
    }
    EXPECT_LT(worst, 3e-7);
    EXPECT_EQ(shader::spa_atan2(0, 0), 0);
    EXPECT_EQ(shader::spa_atan2(0, 1), 0);
    EXPECT_NEAR(double(shader::spa_atan2(1, 0)), pi / 2, 1e-7);
    EXPECT_NEAR(double(shader::spa_atan2(0, -1)), pi, 1e-7);
}

TEST(TextDirection, SineIsExactToAFewRoundings) {
    for (int i = -1000; i <= 1000; ++i) {
        const auto angle = float(pi / 2 * i / 1000);
        EXPECT_NEAR(double(shader::spa_sin(angle)), std::sin(double(angle)), 2e-7) << angle;
    }
}

TEST(TextDirection, PositionsAreThoseOfTheCore) {
    for (const Grid& grid : all_grids) {
        Random random(2);
        for (int i = 0; i < 20000; ++i) {
            // Of any length.
            const Vec3d direction = to_double(to_float(random.direction() * std::pow(10, 6 * random())));
            const float2 position = text_position(grid, direction);
            EXPECT_LT(angle_between(grid, position, position_of(grid, direction)), 1e-6) << i;
        }
    }
}

TEST(TextDirection, EverySampleIsNearestToItsOwnDirection) {
    for (const Grid& grid : all_grids) {
        for (std::uint32_t y = 0; y < grid.height; ++y) {
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const Vec3f u = to_float(normalize(sample_direction(grid, {x, y})));
                const auto mapping = std::uint32_t(grid.mapping);
                const std::uint32_t index = shader::spa_nearest(mapping, grid.width, grid.height,
                                                                shader::spa_place(mapping, {u.x, u.y, u.z}));
                ASSERT_LT(index, grid.width * grid.height);
                EXPECT_EQ(canonical(grid, {index % grid.width, index / grid.width}), canonical(grid, {x, y}))
                    << name(grid.mapping) << " " << x << " " << y;
            }
        }
    }
}

TEST(TextDirection, PolesSeamsAndBorders) {
    for (const Grid& grid : all_grids) {
        for (int i = 0; i < 27; ++i) {
            const Vec3d direction{double(i % 3) - 1, double(i / 3 % 3) - 1, double(i / 9) - 1};
            if (direction == Vec3d{}) continue;
            for (const double zero : {0.0, -0.0}) {
                const Vec3d d{direction.x == 0 ? zero : direction.x, direction.y == 0 ? zero : direction.y,
                              direction.z == 0 ? zero : direction.z};
                EXPECT_LT(angle_between(grid, text_position(grid, d), position_of(grid, d)), 1e-6)
                    << name(grid.mapping) << " " << d.x << " " << d.y << " " << d.z;
            }
        }
    }
    // The latlong seam belongs to the left border, as in the core.
    const Grid latlong{Mapping::latlong, 64, 48};
    EXPECT_EQ(text_position(latlong, {0, 0, -1}).x, -0.5F);
    EXPECT_EQ(text_position(latlong, {-0.0, 0, -1}).x, -0.5F);
}

TEST(TextDirection, WrappingIsThatOfTheCore) {
    for (const Grid& grid : all_grids) {
        for (int y = -1; y <= int(grid.height); ++y) {
            for (int x = -1; x <= int(grid.width); ++x) {
                const TexelIndex expected = wrap(grid, x, y);
                EXPECT_EQ(shader::spa_wrapped(std::uint32_t(grid.mapping), grid.width, grid.height, x, y),
                          expected.y * grid.width + expected.x)
                    << name(grid.mapping) << " " << x << " " << y;
            }
        }
    }
}

TEST(TextDirection, NothingLeadsOutOfTheMap) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const Grid& grid : all_grids) {
        const auto mapping = std::uint32_t(grid.mapping);
        for (const float2 place : {float2{nan, 0.5F}, float2{0.5F, nan}, float2{infinity, -infinity},
                                   float2{-3, 7}, float2{1, 1}, float2{0, 0}}) {
            EXPECT_LT(shader::spa_nearest(mapping, grid.width, grid.height, place), grid.width * grid.height);
            const shader::SpaFour four = shader::spa_four(mapping, grid.width, grid.height, place);
            for (const std::uint32_t index : {four.index0, four.index1, four.index2, four.index3})
                EXPECT_LT(index, grid.width * grid.height);
            EXPECT_NEAR(four.weight0 + four.weight1 + four.weight2 + four.weight3, 1, 1e-6);
        }
        for (const float3 direction : {float3{0, 0, 0}, float3{nan, 1, 1}, float3{infinity, 0, 0},
                                       float3{1e-38F, 0, 0}, float3{3e38F, 3e38F, 0}}) {
            const float2 place = shader::spa_place(mapping, direction);
            EXPECT_EQ(place.x, 0.5F);
            EXPECT_EQ(place.y, 0.5F);
        }
        for (const int x : {-1000, 1000})
            EXPECT_LT(shader::spa_wrapped(mapping, grid.width, grid.height, x, -x), grid.width * grid.height);
    }
}

// On both sides of every seam, pole and border the same samples are blended, so what they blend is
// continuous.
TEST(TextDirection, BlendingIsContinuous) {
    for (const Grid& grid : all_grids) {
        Random random(3);
        std::vector<double> values(std::size_t(grid.width) * grid.height);
        for (double& value : values) value = random();
        const auto value_of = [&](std::uint32_t index) {
            const TexelIndex texel = canonical(grid, {index % grid.width, index / grid.width});
            return values[texel.y * grid.width + texel.x];
        };
        const auto blend = [&](Vec3d u) {
            const auto mapping = std::uint32_t(grid.mapping);
            const shader::SpaFour four =
                shader::spa_four(mapping, grid.width, grid.height,
                                 shader::spa_place(mapping, {float(u.x), float(u.y), float(u.z)}));
            return value_of(four.index0) * double(four.weight0) +
                   value_of(four.index1) * double(four.weight1) +
                   value_of(four.index2) * double(four.weight2) +
                   value_of(four.index3) * double(four.weight3);
        };
        for (int i = 0; i < 20000; ++i) {
            Vec3d u = random.direction();
            // Three quarters across z = 0, across the seam, across the planes in which the border lies.
            if (i % 4 == 1) u.x = 1e-7 * random();
            if (i % 4 == 2) u.y = 1e-7 * random();
            if (i % 4 == 3) u.z = 1e-7 * random();
            u = normalize(u);
            // At the latlong poles all columns meet: there it is continuous for even widths alone, and
            // steep.
            if (grid.mapping == Mapping::latlong && (grid.width % 2 == 1 || std::hypot(u.x, u.z) < 0.05))
                continue;
            const Vec3d v = normalize(u + random.vector() * 3e-7);
            EXPECT_NEAR(blend(u), blend(v), 1e-3) << name(grid.mapping) << grid.width << " " << i;
        }
    }
}

} // namespace
} // namespace spa::test
