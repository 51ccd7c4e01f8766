// SPDX-License-Identifier: Apache-2.0
// Embree's rays and closest points against brute force in double precision.
#include "../../libspa/mesh/closest_point.h"
#include "../../libspa/trace/triangle_scene.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace spa::trace {
namespace {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double operator()() { return double(engine_()) / 4294967296.0 * 2 - 1; }
    Vec3d vector() { return {(*this)(), (*this)(), (*this)()}; }

private:
    std::mt19937 engine_;
};

// The smallest distance over a dense grid of the triangle's points: slow, and no formula in common.
double sampled_distance(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    constexpr int n = 200;
    double best = 1e300;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Vec3d q = a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n);
            best = std::min(best, length(q - p));
        }
    }
    return best;
}

TEST(ClosestPoint, OnATriangleIsTheClosestOfAllItsPoints) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Vec3d a = random.vector();
        const Vec3d b = random.vector();
        const Vec3d c = random.vector();
        const Vec3d p = random.vector() * 2.0;
        const double distance = length(closest_point_on_triangle(p, a, b, c) - p);
        const double sampled = sampled_distance(p, a, b, c);
        EXPECT_LE(distance, sampled + 1e-12);
        EXPECT_GE(distance, sampled - 0.02);
    }
}

TEST(ClosestPoint, OnATriangleOfNoAreaIsThatOnItsEdges) {
    const Vec3d a{0, 0, 0};
    const Vec3d b{2, 0, 0};
    EXPECT_EQ(closest_point_on_triangle({1, 1, 0}, a, b, b), (Vec3d{1, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({1, 1, 0}, a, {1, 0, 0}, b), (Vec3d{1, 0, 0}));
    EXPECT_EQ(closest_point_on_triangle({1, 1, 0}, a, a, a), a);
}

TEST(TriangleScene, ClosestPointsAreThoseOfBruteForce) {
    Model model = test::random_soup(300, 3);
    model.triangles.push_back({{0, 0, 0}}); // a point and a segment
    model.triangles.push_back({{1, 2, 2}});
    const TriangleScene scene(model.positions, model.triangles);
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        const Vec3d p = random.vector() * 2.0;
        double best = 1e300;
        for (const Triangle& t : model.triangles) {
            const Vec3d q = closest_point_on_triangle(p, to_double(model.positions[t.vertex[0]]),
                                                      to_double(model.positions[t.vertex[1]]),
                                                      to_double(model.positions[t.vertex[2]]));
            best = std::min(best, length(q - p));
        }
        const ClosestPoint found = scene.closest_point(p);
        EXPECT_NEAR(found.distance, best, 1e-12);
        EXPECT_NEAR(length(found.point - p), found.distance, 1e-12);
        EXPECT_EQ(scene.closest_point(p, best * 0.5).triangle, no_index);
        EXPECT_TRUE(std::isinf(scene.closest_point(p, best * 0.5).distance));
        EXPECT_NEAR(scene.closest_point(p, best * 1.5 + 1e-6).distance, best, 1e-12);
    }
}

TEST(TriangleScene, OfPointsAndSegmentsAlone) {
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 3, 0}};
    const std::vector<Triangle> triangles{{{0, 1, 1}}, {{2, 2, 2}}};
    const TriangleScene scene(positions, triangles);
    EXPECT_NEAR(scene.closest_point({0.5, 0.25, 0}).distance, 0.25, 1e-12);
    EXPECT_NEAR(scene.closest_point({0, 4, 0}).distance, 1, 1e-12);
}

TEST(TriangleScene, HitsAreThoseOfBruteForce) {
    const Model model = test::random_soup(200, 11);
    const TriangleScene scene(model.positions, model.triangles);
    Random random(13);
    std::vector<TriangleHit> hits;
    for (int i = 0; i < 500; ++i) {
        const Vec3f origin = to_float(random.vector() * 3.0);
        const Vec3f direction = to_float(random.vector());
        std::set<std::uint32_t> expected;
        double nearest = 1e300;
        for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
            const auto corner = [&](unsigned k) {
                return to_double(model.positions[model.triangles[t].vertex[k]]);
            };
            const Vec3d n = cross(corner(1) - corner(0), corner(2) - corner(0));
            const double distance = dot(n, corner(0) - to_double(origin)) / dot(n, to_double(direction));
            const Vec3d p = to_double(origin) + to_double(direction) * distance;
            bool inside = distance > 0;
            for (unsigned k = 0; k < 3; ++k)
                inside = inside && dot(n, cross(corner((k + 1) % 3) - corner(k), p - corner(k))) >= 0;
            if (!inside) continue;
            expected.insert(t);
            nearest = std::min(nearest, distance);
        }
        scene.all_hits(origin, direction, 1e30F, hits);
        std::set<std::uint32_t> found;
        for (const TriangleHit& hit : hits) {
            found.insert(hit.triangle);
            const Triangle& t = model.triangles[hit.triangle];
            const Vec3d a = to_double(model.positions[t.vertex[0]]);
            const Vec3d n = cross(to_double(model.positions[t.vertex[1]]) - a,
                                  to_double(model.positions[t.vertex[2]]) - a);
            EXPECT_EQ(hit.front_facing, dot(n, to_double(direction)) < 0);
        }
        EXPECT_EQ(found, expected) << i;
        TriangleHit hit;
        ASSERT_EQ(scene.closest_hit(origin, direction, 1e30F, hit), !expected.empty());
        if (!expected.empty()) {
            EXPECT_NEAR(double(hit.t), nearest, 1e-4 * nearest);
        }
    }
}

} // namespace
} // namespace spa::trace
