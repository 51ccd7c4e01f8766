// SPDX-License-Identifier: Apache-2.0
// The hard cases of instances, by number and name.
#include "tracers.h"

#include "../../libspa/trace/scene.h"
#include "../../libspa/trace/trace.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace spa;
using namespace spa::test;

using trace::Hit;
using trace::Ray;

const Vec3d aside = normalize(Vec3d{0.3, -0.5, 0.81});

// Every ray once by the scene, alone and in a stream; equal to the bit.
Hit scene_hit(const trace::Scene& scene, const Ray& ray, std::uint32_t flags = 0) {
    Hit hit;
    const bool found = scene.closest_hit(ray, flags, hit);
    EXPECT_EQ(found, hit.valid());
    const std::vector<Ray> rays(19, ray);
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    scene.closest_hits(rays, flags, hits);
    scene.occluded(rays, flags, blocked);
    EXPECT_EQ(hits.back().t, hit.t);
    EXPECT_EQ(hits.back().instance, hit.instance);
    EXPECT_EQ(hits.back().normal, hit.normal);
    EXPECT_EQ(blocked.back() != 0, found);
    EXPECT_EQ(scene.occluded(ray, flags), found);
    return hit;
}

Affine scaled(double x, double y, double z, Vec3d to = {}) {
    return {{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}, to};
}

TEST(HardCases, Case19_NonUniformAndMirroredInstances) {
    const Subject ball(star(64, round_radius));
    const Affine places[] = {scaled(2, 0.5, 1, {1, 2, 3}),
                             scaled(-1, 1, 1),
                             scaled(1, -3, 0.1, {0, -1, 0}),
                             {{{{1, 0.5, 0}, {0, -1, 0.25}, {0.5, 0, 2}}}, {0.1, 0.2, 0.3}}};
    for (const Affine& place : places) {
        trace::Scene scene;
        scene.add(ball.map(), ball.part(), place);
        for (const Vec3d& u : directions(200)) {
            const Vec3d from = place.linear * (u * 2.0) + place.translation;
            const Vec3d to = place.linear * (aside * 0.1) + place.translation;
            const Ray ray = ray_through(from, to);
            const Hit hit = scene_hit(scene, ray);
            ASSERT_TRUE(hit.valid());
            const Hit alone = ball.hit(ray_through(u * 2.0, aside * 0.1));
            EXPECT_NEAR(hit.t, alone.t, 3e-5) << "t is preserved";
            // The normal of the transformed ball, by the inverse transpose, on the side of the ray.
            const Vec3d normal = normalize(transpose(inverse(place.linear)) * to_double(alone.normal));
            EXPECT_GT(dot(to_double(hit.normal), normal), 0.99);
            EXPECT_LT(dot(to_double(hit.normal), to_double(ray.direction)), 0);
            EXPECT_TRUE(hit.front);
        }
    }
}

TEST(HardCases, Case21_TinyAndHugeParts) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const double size : {1e-6, 1e6}) {
        Part part = bumpy.part();
        part.radius = size;
        trace::Scene scene;
        scene.add(bumpy.map(), part);
        for (const Vec3d& u : directions(200)) {
            const Hit alone = bumpy.hit(ray_through(u * 2.0, aside * 0.1));
            const Hit hit = scene_hit(scene, ray_through(u * (2 * size), aside * (0.1 * size)));
            ASSERT_TRUE(hit.valid());
            EXPECT_NEAR(hit.t, alone.t, 1e-5);
            EXPECT_GT(dot(hit.normal, alone.normal), 0.999F);
        }
    }
}

TEST(HardCases, Case34_OverlappingParts) {
    const Subject ball(star(32, round_radius));
    const Subject bumpy(star(16, bumpy_radius));
    trace::Scene scene;
    scene.add(ball.map(), ball.part(), scaled(1, 1, 1));
    scene.add(bumpy.map(), bumpy.part(), scaled(1, 1, 1, {0.3, 0.1, 0}));
    scene.add(ball.map(), ball.part(), scaled(0.5, 2, 0.5, {-0.2, 0, 0.1}));
    scene.add(ball.map(), ball.part(), scaled(1, 1, 1)); // the first one again
    int of_each[3] = {};
    for (const Vec3d& u : directions(500)) {
        const Ray ray = ray_through(u * 3.0, aside * 0.3);
        const Hit hit = scene_hit(scene, ray);
        Hit nearest;
        for (std::uint32_t i = 0; i < scene.size(); ++i) {
            Hit alone;
            if (scene.instance_hit(i, ray, 0, alone) && alone.t < nearest.t) nearest = alone;
        }
        ASSERT_EQ(hit.valid(), nearest.valid());
        if (!hit.valid()) continue;
        EXPECT_EQ(hit.t, nearest.t);
        ASSERT_LT(hit.instance, 3U) << "of equal ones the first";
        ++of_each[hit.instance];
    }
    for (const int count : of_each) EXPECT_GT(count, 20);
}

TEST(HardCases, Case35_OcclusionAgreesWithClosestHit) {
    const Subject parts[] = {
        Subject(star(16, bumpy_radius)),
        Subject(
            random_part({.cells = 10, .layers = 2, .mixed_share = 0.2, .center_inside = true, .seed = 3}))};
    trace::Scene scene;
    scene.add(parts[0].map(), parts[0].part(), scaled(1, -2, 0.5));
    scene.add(parts[1].map(), parts[1].part(), scaled(0.5, 0.5, 3, {0.4, 0.1, 0}));
    int blocked = 0;
    for (const Vec3d& u : directions(1000)) {
        for (const std::uint32_t flags :
             {0U, std::uint32_t(trace::cull_back), std::uint32_t(trace::cull_front)}) {
            Ray ray = ray_through(u * 1.5, cross(u, aside) * 0.7);
            ray.t_max = 1.2F;
            blocked += scene_hit(scene, ray, flags).valid() ? 1 : 0; // expects that they agree
            for (const Subject& part : parts) (void)part.hit(ray, flags);
        }
    }
    EXPECT_GT(blocked, 500);
    EXPECT_LT(blocked, 2900);
}

} // namespace
