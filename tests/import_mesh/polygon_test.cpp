// SPDX-License-Identifier: Apache-2.0
// A triangulation covers a polygon exactly once if every triangle has the polygon's orientation and their
// areas add up to the polygon's (shoelace) area.
#include "../../formats/import/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace spa::import {
namespace {

using Points = std::vector<Vec2d>;

double shoelace(const Points& points) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2d a = points[i];
        const Vec2d b = points[(i + 1) % points.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum / 2;
}

// The plane through three axes that are not those of the coordinate system, so that each projection is used.
struct Plane {
    Vec3d u, v;
};
constexpr Plane planes[] = {{{1, 0, 0}, {0, 1, 0}},
                            {{0, 1, 0}, {0, 0, 1}},
                            {{0, 0, 1}, {1, 0, 0}},
                            {{0, 1, 0}, {1, 0, 0}},
                            {{0, 0, 1}, {0, 1, 0}},
                            {{1, 0, 0}, {0, 0, 1}},
                            {{0.6, 0.8, 0}, {-0.48, 0.36, 0.8}},
                            {{-0.8, 0, 0.6}, {0.36, 0.8, 0.48}}};

void expect_covered(const Points& points) {
    for (const Plane& plane : planes) {
        std::vector<Vec3f> corners;
        for (const Vec2d& p : points)
            corners.push_back(to_float(plane.u * p.x + plane.v * p.y + Vec3d{3, -2, 5}));
        std::vector<std::array<std::uint32_t, 3>> triangles;
        EXPECT_TRUE(triangulate_polygon(corners, triangles));
        ASSERT_EQ(triangles.size(), points.size() - 2);
        const double polygon = shoelace(points);
        double sum = 0;
        for (const auto& t : triangles) {
            const double triangle = shoelace({points[t[0]], points[t[1]], points[t[2]]});
            EXPECT_GE(triangle * polygon, -1e-6 * std::abs(polygon));
            sum += std::abs(triangle);
        }
        EXPECT_NEAR(sum, std::abs(polygon), 1e-5 * std::abs(polygon));
    }
}

Points reversed(const Points& points) { return {points.rbegin(), points.rend()}; }

TEST(Polygon, ConcaveQuadFromEveryFirstCorner) {
    Points arrow{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};
    for (int i = 0; i < 4; ++i) {
        expect_covered(arrow);
        expect_covered(reversed(arrow));
        std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    }
}

TEST(Polygon, Comb) {
    for (const int teeth : {2, 3, 50, 500}) {
        Points comb;
        for (int i = 0; i < teeth; ++i) {
            comb.push_back({double(i), 0});
            comb.push_back({i + 0.5, 10});
        }
        comb.push_back({double(teeth), 0});
        comb.push_back({double(teeth), -1});
        comb.push_back({0, -1});
        expect_covered(comb);
        expect_covered(reversed(comb));
    }
}

TEST(Polygon, Spiral) {
    Points spiral;
    constexpr int n = 200;
    for (int i = 0; i <= n; ++i) {
        const double angle = 6 * std::numbers::pi * i / n;
        spiral.push_back({(2 + angle) * std::cos(angle), (2 + angle) * std::sin(angle)});
    }
    for (int i = n; i >= 0; --i) {
        const double angle = 6 * std::numbers::pi * i / n;
        spiral.push_back({(1 + angle) * std::cos(angle), (1 + angle) * std::sin(angle)});
    }
    expect_covered(spiral);
}

TEST(Polygon, RandomStars) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1);
    for (int round = 0; round < 50; ++round) {
        const int n = 4 + round;
        Points star;
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            const double r = radius(random);
            star.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        expect_covered(star);
    }
}

TEST(Polygon, HoleJoinedByADoubleEdge) {
    expect_covered({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}});
}

TEST(Polygon, StraightCorners) {
    expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {1, 1}, {0, 3}, {0, 1.5}});
}

TEST(Polygon, WhatIsNotSimpleLosesNothingAndIsReported) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const std::vector<Vec3f> bow_tie{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
    EXPECT_FALSE(triangulate_polygon(bow_tie, triangles));
    EXPECT_EQ(triangles.size(), 2U);
    triangles.clear();
    const std::vector<Vec3f> point(7, Vec3f{1, 2, 3});
    EXPECT_FALSE(triangulate_polygon(point, triangles));
    EXPECT_EQ(triangles.size(), 5U);
}

// Random corners cross themselves everywhere; quadratic or cubic time would never end.
TEST(Polygon, HugeTangleEnds) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<Vec3f> tangle(300'000);
    for (Vec3f& p : tangle) p = {uniform(random), uniform(random), uniform(random)};
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EXPECT_FALSE(triangulate_polygon(tangle, triangles));
    EXPECT_EQ(triangles.size(), tangle.size() - 2);
}

} // namespace
} // namespace spa::import
