// SPDX-License-Identifier: Apache-2.0
// Linear steps and secants against analytic spheres and a search in double precision.
#include "random.h"
#include "trace_image.h"

#include "../../libspa/trace/ray.h"
#include "../../shaders/spa_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace spa::test {
namespace {

using shader::SpaHit;
using shader::SpaMarch;
using trace::Ray;

constexpr float infinity = std::numeric_limits<float>::infinity();

bool march(TraceImage& image, const Ray& ray, const SpaMarch& options, std::uint32_t flags, SpaHit& hit) {
    return shader::spa_trace_march(image.open(),
                                   {{ray.origin.x, ray.origin.y, ray.origin.z},
                                    ray.t_min,
                                    {ray.direction.x, ray.direction.y, ray.direction.z},
                                    ray.t_max},
                                   options, flags, hit);
}

Ray random_ray(Random& random, double aim) {
    const Vec3d origin = random.direction() * 2.5;
    return {to_float(origin), 0, to_float(random.direction() * aim - origin), infinity};
}

TEST(TextMarch, FindsASphereWithItsNormalAndBothSides) {
    for (const Grid& grid : all_grids) {
        TraceImage image(grid, [](TexelIndex) { return 0.5; });
        Random random(8);
        SpaMarch options = shader::spa_march_defaults();
        options.secants = 6;
        for (int i = 0; i < 2000; ++i) {
            const Ray ray = random_ray(random, 0.4);
            SpaHit hit;
            ASSERT_TRUE(march(image, ray, options, 0, hit));
            Vec3d p = to_double(ray.origin) + to_double(ray.direction) * double(hit.t);
            EXPECT_NEAR(length(p), 0.5, 1e-5);
            EXPECT_EQ(hit.front, 1U);
            const Vec3d n =
                normalize(Vec3d{double(hit.normal.x), double(hit.normal.y), double(hit.normal.z)});
            EXPECT_NEAR(dot(n, p) / 0.5, 1, 1e-4);
            SpaHit back;
            ASSERT_TRUE(march(image, ray, options, SPA_CULL_FRONT, back));
            EXPECT_EQ(back.front, 0U);
            EXPECT_GT(back.t, hit.t);
            p = to_double(ray.origin) + to_double(ray.direction) * double(back.t);
            EXPECT_NEAR(length(p), 0.5, 1e-5);
            SpaHit any;
            ASSERT_TRUE(march(image, ray, options, SPA_ANY_HIT, any));
            EXPECT_EQ(any.t, hit.t);
            // t_max before and behind the hit, t_min in the solid.
            Ray part = ray;
            part.t_max = hit.t * 0.999F;
            EXPECT_FALSE(march(image, part, options, 0, any));
            part.t_max = hit.t * 1.001F;
            ASSERT_TRUE(march(image, part, options, 0, any));
            EXPECT_NEAR(any.t, hit.t, 1e-4 * hit.t);
            part = ray;
            part.t_min = 0.5F * (hit.t + back.t);
            ASSERT_TRUE(march(image, part, options, 0, any));
            EXPECT_EQ(any.front, 0U);
            EXPECT_NEAR(any.t, back.t, 1e-4 * back.t);
            EXPECT_FALSE(march(image, part, options, SPA_CULL_BACK, any));
        }
    }
}

// Height above the bilinear surface, in double precision.
double height(const TraceImage& image, Vec3d p) {
    const Grid& grid = image.grid();
    const Vec2d position = position_of(grid, p);
    const double x = std::floor(position.x);
    const double y = std::floor(position.y);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double weight = (1 - std::abs(position.x - x - i % 2)) * (1 - std::abs(position.y - y - i / 2));
        sum += weight * image.depth(wrap(grid, std::int64_t(x) + i % 2, std::int64_t(y) + i / 2));
    }
    return length(p) - sum;
}

TEST(TextMarch, HitsLieOnTheSurfaceAndAreTheFirst) {
    for (const Grid& grid : {Grid{Mapping::latlong, 64, 48}, Grid{Mapping::octahedral, 65, 65}}) {
        TraceImage image(grid, [&](TexelIndex t) {
            const Vec3d u = normalize(sample_direction(grid, t));
            return 0.6 + 0.1 * std::sin(3 * u.x) * std::cos(2 * u.y + u.z);
        });
        Random random(9);
        const SpaMarch options{256, 6};
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const Ray ray = random_ray(random, 0.8);
            SpaHit hit;
            const bool found = march(image, ray, options, 0, hit);
            const Vec3d o = to_double(ray.origin);
            const Vec3d d = to_double(ray.direction);
            double first = infinity;
            for (int k = 0; k < 4000 && first > 10; ++k)
                if (height(image, o + d * (k / 2000.0)) < 0) first = k / 2000.0;
            // Between two steps a grazing ray may be missed, and less than a step deep both ways.
            if (!found) {
                EXPECT_TRUE(first > 10 || height(image, o + d * (first + 0.004)) > -0.01);
                continue;
            }
            ++hits;
            EXPECT_NEAR(height(image, o + d * double(hit.t)), 0, 2e-5) << i;
            EXPECT_LT(double(hit.t), first + 0.01);
            const double slope = double(hit.normal.x * ray.direction.x + hit.normal.y * ray.direction.y +
                                        hit.normal.z * ray.direction.z);
            if (first < 10 && height(image, o + d * (double(hit.t) - 0.01)) > 0.005) {
                EXPECT_LT(slope, 0) << i;
            }
        }
        EXPECT_GT(hits, 500);
    }
}

TEST(TextMarch, NothingSlopesToTheCentreBesideAHole) {
    const Grid grid{Mapping::octahedral, 33, 33};
    TraceImage image(grid, [&](TexelIndex t) { return sample_direction(grid, t).x > 0.2 ? 0.0 : 0.7; });
    Random random(10);
    SpaHit hit;
    for (int i = 0; i < 2000; ++i) {
        // Rays in x > 0.5: nothing is there.
        const Vec3d origin{0.5 + 0.4 * random.uniform(), random() * 0.3, 3};
        ASSERT_FALSE(march(image, {to_float(origin), 0, {0.02F, 0, -1}, infinity}, {256, 4}, 0, hit));
    }
    ASSERT_TRUE(march(image, {{-0.3F, 0.1F, 3}, 0, {0, 0, -1}, infinity}, {256, 4}, 0, hit));
}

TEST(TextMarch, WhatIsNoRayMissesAndNothingIsNaN) {
    TraceImage image({Mapping::octahedral, 5, 5}, [](TexelIndex) { return 0.9; });
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray good{{0.1F, 0.2F, 3}, 0, {0, 0, -1}, infinity};
    const SpaMarch options = shader::spa_march_defaults();
    SpaHit hit;
    ASSERT_TRUE(march(image, good, options, 0, hit));
    for (const float bad : {nan, infinity, -infinity}) {
        for (int i = 0; i < 6; ++i) {
            Ray ray = good;
            const std::array<float*, 6> members{&ray.origin.x,    &ray.origin.y,    &ray.origin.z,
                                                &ray.direction.x, &ray.direction.y, &ray.direction.z};
            *members[std::size_t(i)] = bad;
            EXPECT_FALSE(march(image, ray, options, 0, hit)) << bad << " " << i;
        }
    }
    for (const Ray& ray :
         {Ray{good.origin, nan, good.direction, infinity}, Ray{good.origin, 0, good.direction, nan},
          Ray{good.origin, 5, good.direction, 1}, Ray{good.origin, 0, {0, 0, 0}, infinity}})
        EXPECT_FALSE(march(image, ray, options, 0, hit));
    EXPECT_FALSE(march(image, good, {0, 0}, 0, hit)); // one step: over it all
    EXPECT_TRUE(march(image, good, {2, 0xFFFFFFFFU}, 0, hit));
    for (const float scale : {1e-12F, 1e-20F, 1e12F}) {
        for (const float x : {0.0F, 0.1F}) {
            const Ray ray{{x, 0, 3}, 0, {0, 0, -scale}, infinity};
            if (!march(image, ray, options, 0, hit)) continue;
            EXPECT_TRUE(std::isfinite(hit.t + hit.normal.x + hit.normal.y + hit.normal.z));
            EXPECT_TRUE(march(image, ray, {2, 0}, 0, hit));
            EXPECT_TRUE(std::isfinite(hit.t + hit.normal.x + hit.normal.y + hit.normal.z));
        }
    }
}

} // namespace
} // namespace spa::test
