// SPDX-License-Identifier: Apache-2.0
// The fan trace against an independent implementation of the paper's description, and analytic spheres.
#include "fan_reference.h"
#include "random.h"
#include "trace_image.h"

#include <gtest/gtest.h>

#include <limits>

namespace spa::test {
namespace {

using shader::SpaFan;
using shader::SpaHit;
using trace::Ray;

constexpr float infinity = std::numeric_limits<float>::infinity();

bool fan(TraceImage& image, const Ray& ray, const SpaFan& options, std::uint32_t flags, SpaHit& hit) {
    return shader::spa_trace_fan(image.open(),
                                 {{ray.origin.x, ray.origin.y, ray.origin.z},
                                  ray.t_min,
                                  {ray.direction.x, ray.direction.y, ray.direction.z},
                                  ray.t_max},
                                 options, flags, hit);
}

// A bumpy ball with a step and a hole.
double bumpy(const Grid& grid, TexelIndex texel) {
    const Vec3d u = normalize(sample_direction(grid, texel));
    if (u.x > 0.8) return 0;
    return 0.55 + 0.2 * std::sin(5 * u.x) * std::cos(4 * u.y) + (u.z > 0.3 ? 0.2 : 0);
}

Ray random_ray(Random& random) {
    Ray ray;
    // Some begin in the sphere.
    const double away = random.uniform() < 0.3 ? 0.9 : 2.5;
    const Vec3d origin = random.direction() * away;
    const Vec3d direction = (random.direction() * 0.8 - origin) * std::pow(10, random());
    ray.origin = to_float(origin);
    ray.direction = to_float(direction);
    const double scale = 1 / length(direction);
    if (random.uniform() < 0.3) ray.t_min = float(random.uniform() * scale);
    if (random.uniform() < 0.3) ray.t_max = float(random.uniform() * 3 * scale);
    return ray;
}

TEST(TextFan, IsThePapersForEveryOption) {
    Random random(5);
    int certain = 0;
    int all = 0;
    int hits = 0;
    for (const Grid& grid : {Grid{Mapping::latlong, 40, 30}, Grid{Mapping::octahedral, 33, 33}}) {
        TraceImage image(grid, [&](TexelIndex t) { return bumpy(grid, t); });
        for (int i = 0; i < 60000; ++i) {
            SpaFan options = shader::spa_fan_defaults();
            const std::array<unsigned, 7> counts{0, 1, 2, 3, 5, 10, 50};
            options.count = counts[random.bits() % counts.size()];
            if (i % 3 != 0) { // a third with the defaults
                options.count_rule = random.bits() % 2;
                options.spacing = random.bits() % 2;
                options.ends = random.bits() % 3;
                options.pick = random.bits() % 2;
                options.report = random.bits() % 2;
                options.shading = random.bits() % 3;
                options.start = random.bits() % 2;
                options.filtering = random.bits() % 2;
                options.empty = random.bits() % 2;
            }
            const std::uint32_t flags = i % 2 == 0 ? 0 : random.bits() % 4;
            const Ray ray = random_ray(random);
            const FanAnswer expected = FanReference(image, options)(ray, flags);
            SpaHit hit;
            const bool found = fan(image, ray, options, flags, hit);
            ++all;
            if (!expected.certain) continue;
            ++certain;
            ASSERT_EQ(found, expected.hit) << i;
            if (!found) continue;
            ++hits;
            const double scale = 1 / length(to_double(ray.direction));
            EXPECT_NEAR(double(hit.t), expected.t, 1e-5 * scale) << i;
            EXPECT_GE(hit.t, ray.t_min);
            EXPECT_LE(hit.t, ray.t_max);
            EXPECT_EQ(hit.front != 0, expected.front) << i;
            const Vec2d position = position_of(grid, expected.shading);
            const shader::float2 text =
                shader::spa_position(std::uint32_t(grid.mapping), grid.width, grid.height, hit.map);
            const Vec3d u = direction_at(grid, position);
            const Vec3d v = direction_at(grid, {double(text.x), double(text.y)});
            EXPECT_LT(length(u - v) * std::min(1.0, length(expected.shading)), 2e-5) << i;
            // The normal looks against the ray where it enters, along it where it leaves.
            const double slope = double(hit.normal.x * ray.direction.x + hit.normal.y * ray.direction.y +
                                        hit.normal.z * ray.direction.z);
            EXPECT_TRUE(hit.front != 0 ? slope < 0 : slope > 0) << i;
        }
    }
    EXPECT_GT(certain, all / 2);
    EXPECT_GT(hits, all / 8);
}

// A map of depth 1 everywhere, or no test ray at all: the unit sphere.
TEST(TextFan, WithoutTestRaysIsTheSphere) {
    for (const Grid& grid : all_grids) {
        TraceImage image(grid, [](TexelIndex) { return 0.25; });
        SpaFan options = shader::spa_fan_defaults();
        options.count = 0;
        Random random(6);
        for (int i = 0; i < 2000; ++i) {
            const Vec3d origin = random.direction() * 3.0;
            const Vec3d direction = random.direction() * 0.9 - origin;
            SpaHit hit;
            ASSERT_TRUE(fan(image, {to_float(origin), 0, to_float(direction), infinity}, options, 0, hit));
            EXPECT_NEAR(length(origin + direction * double(hit.t)), 1, 1e-6);
            EXPECT_EQ(hit.front, 1U);
            ASSERT_TRUE(fan(image, {to_float(origin), 0, to_float(direction), infinity}, options,
                            SPA_CULL_FRONT, hit));
            EXPECT_EQ(hit.front, 0U);
            EXPECT_GT(double(hit.t), -dot(origin, direction) / dot(direction, direction));
        }
    }
}

// One test ray against a ball of radius r: a hit exactly if the ray passes the centre no farther away.
TEST(TextFan, WithOneTestRayComparesTheFoot) {
    for (const Grid& grid : all_grids) {
        TraceImage image(grid, [](TexelIndex) { return 0.5; });
        SpaFan options = shader::spa_fan_defaults();
        options.count = 1;
        Random random(7);
        for (int i = 0; i < 2000; ++i) {
            const Vec3d u = random.direction();
            const Vec3d across = normalize(cross(u, random.direction()));
            const double distance = random.uniform();
            if (std::abs(distance - 0.5) < 1e-5) continue;
            const Vec3d origin = across * distance - u * 3.0;
            SpaHit hit;
            ASSERT_EQ(fan(image, {to_float(origin), 0, to_float(u), infinity}, options, 0, hit),
                      distance < 0.5);
            if (distance < 0.5) {
                EXPECT_NEAR(hit.t, 3, 1e-5);
            }
        }
    }
}

TEST(TextFan, RaysThroughAndBesideTheCentreAgree) {
    for (const Grid& grid : all_grids) {
        TraceImage image(grid, [](TexelIndex) { return 0.5; });
        SpaFan options = shader::spa_fan_defaults();
        for (options.spacing = 0; options.spacing < 2; ++options.spacing) {
            for (const unsigned count : {1U, 3U, 10U}) {
                options.count = count;
                SpaHit through;
                SpaHit beside;
                ASSERT_TRUE(fan(image, {{0, 0, 3}, 0, {0, 0, -1}, infinity}, options, 0, through));
                ASSERT_TRUE(fan(image, {{1e-7F, 0, 3}, 0, {0, 0, -1}, infinity}, options, 0, beside));
                EXPECT_EQ(through.t, beside.t);
                EXPECT_NEAR(through.map.x, beside.map.x, 1e-6);
                EXPECT_NEAR(through.map.y, beside.map.y, 1e-6);
            }
        }
    }
}

TEST(TextFan, MapsWithoutSurfaceAreMissedByDefault) {
    TraceImage image({Mapping::octahedral, 5, 5}, [](TexelIndex) { return 0.0; });
    SpaFan options = shader::spa_fan_defaults();
    SpaHit hit;
    for (const float x :
         {0.0F, 0.3F}) // through the centre too, where a distance of 0 is no more than depth 0
        for (options.count = 1; options.count < 12; ++options.count)
            EXPECT_FALSE(fan(image, {{x, 0, 3}, 0, {0, 0, -1}, infinity}, options, 0, hit));
    options.empty = SPA_FAN_EMPTY_IS_SPHERE;
    EXPECT_TRUE(fan(image, {{0.3F, 0, 3}, 0, {0, 0, -1}, infinity}, options, 0, hit));
}

TEST(TextFan, WhatIsNoRayMisses) {
    TraceImage image({Mapping::octahedral, 5, 5}, [](TexelIndex) { return 0.9; });
    const SpaFan options = shader::spa_fan_defaults();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray good{{0.1F, 0.2F, 3}, 0, {0, 0, -1}, infinity};
    SpaHit hit;
    ASSERT_TRUE(fan(image, good, options, 0, hit));
    for (const float bad : {nan, infinity, -infinity}) {
        for (int i = 0; i < 6; ++i) {
            Ray ray = good;
            const std::array<float*, 6> members{&ray.origin.x,    &ray.origin.y,    &ray.origin.z,
                                                &ray.direction.x, &ray.direction.y, &ray.direction.z};
            *members[std::size_t(i)] = bad;
            EXPECT_FALSE(fan(image, ray, options, 0, hit)) << bad << " " << i;
        }
    }
    for (const Ray& ray :
         {Ray{good.origin, nan, good.direction, infinity}, Ray{good.origin, 0, good.direction, nan},
          Ray{good.origin, 5, good.direction, 1}, Ray{good.origin, 0, {0, 0, 0}, infinity}})
        EXPECT_FALSE(fan(image, ray, options, 0, hit));
    // Options out of their range: bounded, and no read outside.
    SpaFan wild = options;
    wild.count = 0xFFFFFFFFU;
    EXPECT_TRUE(fan(image, good, wild, 0, hit));
}

TEST(TextFan, TIsInUnitsOfTheDirection) {
    TraceImage image({Mapping::latlong, 40, 30}, [](TexelIndex) { return 0.6; });
    const SpaFan options = shader::spa_fan_defaults();
    SpaHit unit;
    ASSERT_TRUE(fan(image, {{0.1F, 0.2F, 3}, 0, {0, 0, -1}, infinity}, options, 0, unit));
    for (const float scale : {1e-6F, 1e6F, 1e-12F, 1e12F}) {
        SpaHit hit;
        ASSERT_TRUE(fan(image, {{0.1F, 0.2F, 3}, 0, {0, 0, -scale}, infinity}, options, 0, hit));
        EXPECT_NEAR(hit.t * scale, unit.t, 2e-6);
        EXPECT_TRUE(std::isfinite(hit.normal.x + hit.normal.y + hit.normal.z));
    }
}

} // namespace
} // namespace spa::test
