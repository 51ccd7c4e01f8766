// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/ray_truth.h"

#include "../../libspa/bake/center.h"
#include "../../libspa/measure/ray_sets.h"
#include "../../samples/samples.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

// A sample in normalised space, with its scene.
struct Subject {
    explicit Subject(const char* sample, int level)
        : model(samples::make_sample(sample, level)),
          centered(bake::center_model(model, make_part_frame(model, {}, false))),
          scene(centered.positions, model.triangles), truth(centered, scene) {}
    Model model;
    bake::CenteredModel centered;
    trace::TriangleScene scene;
    RayTruth truth;
};

TEST(RayTruth, MeetsTheSphereWhereItIs) {
    const Subject ball("sphere", 5);
    const auto rays = make_rays(RaySet::primary, 10000, 1, {}, {});
    const auto answers = ball.truth.trace(rays);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3d o = to_double(rays[i].origin), d = to_double(rays[i].direction);
        const double b = -dot(o, d);
        const double inside = b * b - dot(o, o) + 1;
        if (std::abs(inside) < 0.02) continue; // close to the silhouette of a ball of triangles
        ASSERT_EQ(answers[i].hits(), inside > 0) << i;
        if (!answers[i].hits()) continue;
        ++hits;
        EXPECT_NEAR(answers[i].t, b - std::sqrt(inside), 0.01);
        const Vec3d p = o + d * double(answers[i].t);
        EXPECT_NEAR(dot(normalize(p), to_double(answers[i].normal)), 1, 1e-4);
        EXPECT_NEAR(srgb_to_linear(answers[i].color[0]), 0.5 + 0.5 * p.x, 0.01);
    }
    EXPECT_GT(hits, 5000U);
}

TEST(RayTruth, KeepsToTheRaysEnds) {
    const Subject cube("cube", 0);
    const float face = float(0.6 / std::sqrt(3 * 0.36)); // of the normalised cube
    const Vec3f down{0, 0, -2};
    const auto t_of = [&](float t_min, float t_max) {
        return cube.truth.trace(std::vector{trace::Ray{{0.1F, 0.05F, 2}, t_min, down, t_max}})[0].t;
    };
    const float first = (2 - face) / 2, second = (2 + face) / 2;
    constexpr float inf = std::numeric_limits<float>::infinity();
    EXPECT_NEAR(t_of(0, inf), first, 1e-6);
    EXPECT_NEAR(t_of(first + 0.01F, inf), second, 1e-6);
    EXPECT_EQ(t_of(0, first - 0.01F), inf);
    EXPECT_EQ(t_of(second + 0.01F, inf), inf);
}

TEST(RayTruth, BandIsWhatLiesAlongTheSilhouette) {
    const Subject ball("sphere", 5);
    const auto rays = make_rays(RaySet::primary, 40000, 1, {}, {});
    constexpr float width = 0.05F;
    const auto band = ball.truth.silhouette_band(rays, ball.truth.trace(rays), width);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        // The ray's distance from the centre. Two directions across the ray at any angle to the silhouette:
        // those that cross it have at least 1/sqrt(2) of the width.
        const double distance = length(cross(to_double(rays[i].origin), to_double(rays[i].direction)));
        if (std::abs(distance - 1) > width + 0.003) {
            EXPECT_EQ(band[i], 0) << distance;
        } else if (std::abs(distance - 1) < 0.7 * width - 0.003) {
            EXPECT_EQ(band[i], 1) << distance;
        }
    }
}

} // namespace
} // namespace spa::measure
