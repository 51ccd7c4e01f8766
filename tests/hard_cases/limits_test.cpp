// SPDX-License-Identifier: Apache-2.0
// The hard cases of where rays begin and end, by number and name.
#include "tracers.h"

#include "../../libspa/trace/trace.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace spa;
using namespace spa::test;
using trace::cull_back;
using trace::Hit;
using trace::HitSide;
using trace::Ray;

const Vec3d aside = normalize(Vec3d{0.3, -0.5, 0.81});

TEST(HardCases, Case11_OriginInTheSphereOutsideTheSolid) {
    const Subject cliff(star(32, cliff_radius)); // its sphere has radius 0.9
    const Ray ray = ray_through({-0.8, 0.1, 0.1}, {-0.3, 0.1, 0.1});
    const Hit hit = cliff.hit(ray);
    ASSERT_TRUE(hit.valid());
    EXPECT_TRUE(hit.front);
    EXPECT_NEAR(length(point_at(ray, hit)), 0.5, 0.01);
    EXPECT_NEAR(length(point_at(ray, cliff.fan(ray))), 0.5, 0.02);
    EXPECT_NEAR(length(point_at(ray, cliff.march(ray))), 0.5, 0.02);
}

TEST(HardCases, Case12_OriginInTheSolid) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(100)) {
        const Ray ray = ray_through(aside * 0.3, aside * 0.3 + u);
        const Hit hit = ball.hit(ray);
        ASSERT_TRUE(hit.valid());
        EXPECT_FALSE(hit.front) << "leaves by a back face";
        EXPECT_NEAR(length(point_at(ray, hit)), 0.75, 0.02);
        EXPECT_FALSE(ball.hit(ray, cull_back).valid());
        EXPECT_TRUE(ball.fan(ray).valid()) << "its first test point, by default";
        const Hit marched = ball.march(ray);
        ASSERT_TRUE(marched.valid());
        EXPECT_FALSE(marched.front);
    }
}

TEST(HardCases, Case13_OriginOnTheSurfaceGoingOut) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(300)) {
        const Ray in = ray_through(u * 2.0, aside * 0.2);
        const Hit hit = ball.hit(in);
        ASSERT_TRUE(hit.valid());
        // The documented offset.
        const Vec3d from = point_at(in, hit) + to_double(hit.normal) * 2e-5;
        Vec3d out = to_double(hit.normal) + normalize(cross(u, aside)) * 0.8;
        // The triangles of a sphere are flat and their edges convex or nearly so.
        if (dot(out, to_double(hit.normal)) > 0) {
            EXPECT_FALSE(ball.hit(ray_through(from, from + out)).valid());
        }
    }
}

TEST(HardCases, Case14_OriginOnTheSurfaceGoingIn) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(300)) {
        const Ray in = ray_through(u * 2.0, aside * 0.2);
        const Hit hit = ball.hit(in);
        ASSERT_TRUE(hit.valid());
        Ray on = in;
        on.origin = to_float(point_at(in, hit) - to_double(hit.normal) * 2e-5);
        const Hit leaves = ball.hit(on);
        ASSERT_TRUE(leaves.valid());
        EXPECT_FALSE(leaves.front);
        EXPECT_GT(length(point_at(on, leaves) - to_double(on.origin)), 0.1) << "the far side";
        EXPECT_FALSE(ball.hit(on, cull_back).valid());
    }
}

TEST(HardCases, Case15_LimitBeforeTheSurface) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const Vec3d& u : directions(200)) {
        Ray ray = ray_through(u * 2.0, aside * 0.1);
        const Hit hit = bumpy.hit(ray);
        ASSERT_TRUE(hit.valid());
        ray.t_max = hit.t - 2e-5F;
        EXPECT_FALSE(bumpy.hit(ray).valid());
        ray.t_max = hit.t;
        EXPECT_TRUE(bumpy.hit(ray).valid()) << "equal is accepted";
        ray.t_max = unlimited;
        for (const Hit& other : {bumpy.fan(ray), bumpy.march(ray)}) {
            ASSERT_TRUE(other.valid());
            Ray shorter = ray;
            shorter.t_max = other.t * 0.98F;
            EXPECT_FALSE(bumpy.march(shorter).valid() && bumpy.fan(shorter).valid());
        }
    }
}

TEST(HardCases, Case16_StartPastTheEntry) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(200)) {
        Ray ray = ray_through(u * 2.0, aside * 0.1);
        ray.t_min = ball.hit(ray).t + 0.05F;
        const Hit next = ball.hit(ray);
        ASSERT_TRUE(next.valid());
        EXPECT_FALSE(next.front);
        EXPECT_GT(next.t, ray.t_min);
        EXPECT_FALSE(ball.march(ray).front);
    }
}

TEST(HardCases, Case17_BehindTheOrigin) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(100)) {
        const Ray ray = ray_through(u * 2.0, u * 3.0);
        EXPECT_FALSE(ball.hit(ray).valid());
        EXPECT_FALSE(ball.fan(ray).valid());
        EXPECT_FALSE(ball.march(ray).valid());
    }
}

TEST(HardCases, Case18_LengthOfTheDirection) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const Vec3d& u : directions(100)) {
        const Ray ray = ray_through(u * 2.0, aside * 0.1);
        const Hit hit = bumpy.hit(ray);
        for (const float scale : {1e-6F, 1e6F}) {
            Ray scaled = ray;
            scaled.direction = ray.direction * scale;
            const Hit same = bumpy.hit(scaled);
            ASSERT_TRUE(same.valid());
            EXPECT_NEAR(double(same.t) * double(scale), hit.t, 2e-6);
            EXPECT_NEAR(double(bumpy.fan(scaled).t) * double(scale), bumpy.fan(ray).t, 2e-2);
            EXPECT_NEAR(double(bumpy.march(scaled).t) * double(scale), bumpy.march(ray).t, 1e-3);
        }
    }
}

TEST(HardCases, Case20_OriginFarAway) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const Vec3d& u : directions(200)) {
        const Ray ray = ray_through(u * 1e4, aside * 0.1);
        const Hit hit = bumpy.hit(ray); // the judge allows a few eps |o|
        ASSERT_TRUE(hit.valid());
        EXPECT_TRUE(bumpy.march(ray).valid());
        EXPECT_TRUE(bumpy.fan(ray).valid());
    }
}

} // namespace
