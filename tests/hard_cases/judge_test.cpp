// SPDX-License-Identifier: Apache-2.0
// The judge against shapes whose intersections can be written down.
#include "judge.h"
#include "judge_samples.h"
#include "maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace spa;
using namespace spa::test;
using trace::HitSide;

double norm1(Vec3d g) { return std::abs(g.x) + std::abs(g.y) + std::abs(g.z); }

Vec3d random_point(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    const double x = uniform(random);
    const double y = uniform(random);
    return {x, y, uniform(random)};
}

RayD random_ray(std::mt19937_64& random) {
    const Vec3d from = random_point(random, 3);
    return {from, random_point(random, 0.8) - from, 0, 1e3};
}

// |x|/A + |y|/B + |z|/C <= 1: one plane an octant, which the stored surface holds exactly.
struct Octahedron {
    Vec3d axes;
    [[nodiscard]] double depth(Vec3d g) const {
        return length(g) / (std::abs(g.x) / axes.x + std::abs(g.y) / axes.y + std::abs(g.z) / axes.z);
    }
    // Where the ray is inside; false: nowhere.
    [[nodiscard]] bool clip(const RayD& ray, double& lo, double& hi) const {
        lo = -1e30;
        hi = 1e30;
        for (int k = 0; k < 8; ++k) {
            const Vec3d n{(k & 1 ? -1 : 1) / axes.x, (k & 2 ? -1 : 1) / axes.y, (k & 4 ? -1 : 1) / axes.z};
            const double a = 1 - dot(n, ray.origin);
            const double b = -dot(n, ray.direction);
            (b > 0 ? lo : hi) = b > 0 ? std::max(lo, -a / b) : std::min(hi, -a / b);
        }
        return lo <= hi;
    }
};

TEST(Judge, TheGridCoversTheOctahedronOnce) {
    for (const std::uint32_t cells : {2U, 4U, 6U, 10U}) {
        const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
        double area = 0;
        for (std::uint32_t y = 0; y < cells; ++y) {
            for (std::uint32_t x = 0; x < cells; ++x) {
                for (std::uint32_t f = 0; f < 2; ++f) {
                    const GridTriangle t = grid_triangle(cells, x, y, f);
                    const Vec3d a = sample_direction(grid, t.corners[0]);
                    const Vec3d b = sample_direction(grid, t.corners[1]);
                    const Vec3d c = sample_direction(grid, t.corners[2]);
                    EXPECT_NEAR(norm1((a + b + c) * (1.0 / 3)), 1, 1e-12) << "in one octant";
                    area += length(cross(b - a, c - a)) / 2;
                }
            }
        }
        EXPECT_NEAR(area, 8 * std::sqrt(3.0) / 2, 1e-9);
    }
}

TEST(Judge, OctahedronIsExact) {
    const Octahedron shape{{0.9, 0.6, 0.5}};
    std::mt19937_64 random(1);
    for (const std::uint32_t cells : {2U, 6U, 16U}) {
        const OwnedPart owned = make_part({.cells = cells}, [&](Vec3d g) {
            return std::vector<MadeInterval>{{shape.depth(g), 0, g, {}}};
        });
        const Judge judge(owned.part);
        int hits = 0;
        for (int i = 0; i < 20000; ++i) {
            const RayD ray = random_ray(random);
            double lo = 0;
            double hi = 0;
            const bool inside = shape.clip(ray, lo, hi);
            if (std::abs(hi - lo) < 1e-5) continue;
            const auto events = judge.events(ray);
            if (!inside || hi < 0) {
                EXPECT_FALSE(judge.first(ray).has_value());
                continue;
            }
            ++hits;
            const auto first = judge.first(ray);
            ASSERT_TRUE(first.has_value()) << i;
            EXPECT_EQ(first->enters, lo > 0);
            EXPECT_NEAR(first->t, lo > 0 ? lo : hi, 2e-5); // W is rounded to float
            EXPECT_EQ(first->side, HitSide::outer);
            EXPECT_EQ(events.back().enters, false);
            EXPECT_NEAR(events.back().t, hi, 2e-5);
            EXPECT_GT(dot(first->normal, first->enters ? -ray.direction : ray.direction), 0);
        }
        EXPECT_GT(hits, 5000);
    }
}

TEST(Judge, ShellOfTwoLayers) {
    const Octahedron shapes[4] = {
        {{0.9, 0.9, 0.9}}, {{0.7, 0.6, 0.8}}, {{0.5, 0.5, 0.6}}, {{0.2, 0.3, 0.25}}};
    const OwnedPart owned = make_part({.cells = 8, .layers = 2}, [&](Vec3d g) {
        return std::vector<MadeInterval>{{shapes[0].depth(g), shapes[1].depth(g), g, -g},
                                         {shapes[2].depth(g), shapes[3].depth(g), g, -g}};
    });
    const Judge judge(owned.part);
    std::mt19937_64 random(2);
    int deepest = 0;
    for (int i = 0; i < 20000; ++i) {
        const RayD ray = random_ray(random);
        std::vector<double> times;
        bool grazes = false;
        for (const Octahedron& shape : shapes) {
            double lo = 0;
            double hi = 0;
            if (shape.clip(ray, lo, hi)) times.insert(times.end(), {lo, hi});
            grazes = grazes || std::abs(hi - lo) < 1e-4;
        }
        if (grazes) continue;
        std::sort(times.begin(), times.end());
        std::vector<double> seen;
        RayD whole = ray;
        whole.t_min = -1e3;
        for (const Event& event : judge.events(whole)) seen.push_back(event.t);
        ASSERT_EQ(seen.size(), times.size()) << i;
        for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_NEAR(seen[k], times[k], 1e-5);
        if (times.size() == 8) ++deepest;
    }
    EXPECT_GT(deepest, 100);
}

// Chords of a finely sampled sphere lie below it by at most the sagitta of a cell.
TEST(Judge, SphereWithinTheSagitta) {
    const OwnedPart owned = make_part({.cells = 32}, [](Vec3d g) {
        return std::vector<MadeInterval>{{0.75, 0, normalize(g), {}}};
    });
    const Judge judge(owned.part);
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
        const RayD ray = random_ray(random);
        const auto first = judge.first(ray);
        if (!first.has_value()) continue;
        const double r = length(ray.origin + ray.direction * first->t);
        EXPECT_LE(r, 0.75 + 1e-6);
        EXPECT_GE(r, 0.75 * (1 - 0.02));
    }
}

// A cube's faces are planes; the cells across which its edges run are not.
TEST(Judge, CubeFaces) {
    const OwnedPart owned = make_part({.cells = 16}, [](Vec3d g) {
        const double largest = std::max({std::abs(g.x), std::abs(g.y), std::abs(g.z)});
        return std::vector<MadeInterval>{{0.5 * length(g) / largest, 0, g, {}}};
    });
    const Judge judge(owned.part);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    for (int i = 0; i < 5000; ++i) {
        const double y = uniform(random);
        const RayD ray{{2, y, uniform(random)}, {-1, 0, 0}, 0, 1e3};
        const auto first = judge.first(ray);
        ASSERT_TRUE(first.has_value());
        EXPECT_NEAR(first->t, 1.5, 1e-6);
        EXPECT_NEAR(first->normal.x, 1, 1e-6);
    }
}

// One sample stands alone: its region is a third of each of its triangles.
TEST(Judge, LoneSampleStandsInItsRegions) {
    const auto lone = [](bool open) {
        return make_part({.cells = 8, .center_inside = open}, [](Vec3d g) {
            if (g.z < 0.99) return std::vector<MadeInterval>{};
            return std::vector<MadeInterval>{{0.5, 0, {0, 0, 1}, {}}};
        });
    };
    const OwnedPart closed = lone(false);
    const OwnedPart open = lone(true);
    const Judge judge(closed.part);
    const Judge open_judge(open.part);
    const RayD down{{0.01, 0.01, 2}, {0, 0, -1}, 0, 1e3};
    ASSERT_TRUE(judge.first(down).has_value());
    EXPECT_NEAR(judge.first(down)->t, 1.5, 1e-6);
    // The middle of the edge between two samples is 1/8 away on |g|_1 = 1.
    const RayD across{{2, 0.01, 0.3}, {-1, 0, 0}, 0, 1e3};
    const auto wall = judge.first(across);
    ASSERT_TRUE(wall.has_value());
    EXPECT_EQ(wall->side, HitSide::wall);
    EXPECT_TRUE(wall->enters);
    EXPECT_NEAR(2 - wall->t, 0.3 * 0.125 / 0.875, 0.005);
    EXPECT_GT(wall->normal.x, 0.5);
    EXPECT_FALSE(open_judge.first(across).has_value()) << "in and out by open walls";
    const RayD out{{0.01, 0.005, 0.4}, {1, 0, 0}, 0, 1e3};
    const auto left = judge.first(out);
    ASSERT_TRUE(left.has_value());
    EXPECT_FALSE(left->enters);
    EXPECT_FALSE(judge.first(out, trace::cull_back).has_value());
    EXPECT_FALSE(open_judge.first(out).has_value());
    EXPECT_TRUE(judge.near_boundary({0, 0, 0.5}, 1e-6));
    EXPECT_FALSE(judge.near_boundary({0, 0, 0.51}, 1e-3));
}

// Whether a point is in the solid, asked by the definition, is what the events say.
TEST(Judge, EventsAgreeWithPointsInRandomMaps) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> uniform(0, 1);
    int inside = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        const OwnedPart owned = random_part(
            {.cells = 2 * (1 + seed % 5), .layers = 1 + seed % 3, .mixed_share = 0.3, .seed = seed});
        const StoredSamples samples(owned.part, 0);
        const Judge judge(owned.part);
        for (int i = 0; i < 3000; ++i) {
            const Vec3d p = random_point(random, 0.6);
            const double t = 1 + uniform(random);
            const Vec3d direction = random_point(random, 1);
            const RayD ray{p - direction * t, direction, -10, 10};
            // In pure triangles alone: regions have a test of their own.
            bool known = false;
            bool solid = false;
            for (std::uint32_t k = 0; k < 2 * samples.cells() * samples.cells() && !known; ++k) {
                const std::uint32_t x = k / 2 % samples.cells();
                const std::uint32_t y = k / 2 / samples.cells();
                if (samples.marked_mixed(x, y, k % 2)) continue;
                const GridTriangle tri = grid_triangle(samples.cells(), x, y, k % 2);
                const std::size_t count = samples.intervals(tri.corners[0]).size();
                bool pure = true;
                for (const TexelIndex at : tri.corners) {
                    pure = pure && samples.intervals(at).size() == count;
                    for (std::size_t j = 0; pure && j < count; ++j)
                        pure = pure && (samples.intervals(at)[j].inner == 0) ==
                                           (samples.intervals(tri.corners[0])[j].inner == 0);
                }
                const Barycentric lambda(samples.direction(tri.corners[0]), samples.direction(tri.corners[1]),
                                         samples.direction(tri.corners[2]));
                double share[3];
                bool within = pure;
                for (int c = 0; c < 3; ++c) {
                    share[c] = dot(lambda.form[std::size_t(c)], p) / norm1(p);
                    within = within && share[c] > 0;
                }
                if (!within) continue;
                known = true;
                for (std::size_t j = 0; j < count; ++j) {
                    double outer = 0;
                    double inner = 0;
                    for (std::size_t c = 0; c < 3; ++c) {
                        outer += share[c] * samples.intervals(tri.corners[c])[j].outer;
                        inner += share[c] * samples.intervals(tri.corners[c])[j].inner;
                    }
                    const double w = 1 / norm1(p);
                    solid = solid || (w >= outer && (inner == 0 || w <= inner));
                }
            }
            if (!known || norm1(p) < 1 / judge.w_core()) continue;
            bool by_events = false;
            bool close = false;
            for (const Event& event : judge.events(ray)) {
                close = close || std::abs(event.t - t) < 1e-6 || event.core_length > 0;
                if (event.t < t) by_events = event.enters;
            }
            if (close) continue;
            EXPECT_EQ(by_events, solid) << "seed " << seed << " ray " << i;
            inside += solid ? 1 : 0;
        }
    }
    EXPECT_GT(inside, 500);
}

} // namespace
