// SPDX-License-Identifier: Apache-2.0
// The hard cases of rays against one map, by number and name.
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

// From outside, and not along the surface.
bool crosses(const std::vector<Event>& events, const Ray& ray) {
    return events.size() == 2 && events[0].t > 0 &&
           (events[1].t - events[0].t) * length(to_double(ray.direction)) > 1e-3;
}

const Vec3d aside = normalize(Vec3d{0.3, -0.5, 0.81});

TEST(HardCases, Case01_RayThroughCenter) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(200)) {
        const Ray ray = ray_through(u * 2.0, {});
        const Hit hit = ball.hit(ray);
        ASSERT_TRUE(hit.valid());
        EXPECT_TRUE(hit.front);
        EXPECT_NEAR(length(point_at(ray, hit)), 0.75, 0.02) << "the sagitta of a cell";
        ASSERT_TRUE(ball.fan(ray).valid());
        EXPECT_NEAR(length(point_at(ray, ball.fan(ray))), 0.75, 0.02);
        ASSERT_TRUE(ball.march(ray).valid());
        EXPECT_NEAR(length(point_at(ray, ball.march(ray))), 0.75, 0.02);
        EXPECT_FALSE(ball.hit({{0, 0, 0}, 0, {0, 0, 0}, unlimited}).valid());
    }
}

TEST(HardCases, Case02_RayNextToCenter) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const Vec3d& u : directions(200)) {
        const Ray through = ray_through(u * 2.0, {});
        Ray beside = through;
        beside.origin = to_float(u * 2.0 + normalize(cross(u, aside)) * 1e-7);
        EXPECT_NEAR(bumpy.hit(through).t, bumpy.hit(beside).t, 1e-5);
        EXPECT_NEAR(bumpy.fan(through).t, bumpy.fan(beside).t, 0.02);
        EXPECT_NEAR(bumpy.march(through).t, bumpy.march(beside).t, 1e-3);
    }
}

TEST(HardCases, Case03_AxisParallelWithZerosOfBothSigns) {
    const Subject bumpy(star(16, bumpy_radius));
    for (const float y : {0.0F, -0.0F, 0.1F, -0.3F}) {
        for (const float z : {0.0F, -0.0F, 0.05F}) {
            float expected = -1;
            for (const float dy : {0.0F, -0.0F}) {
                for (const float dz : {0.0F, -0.0F}) {
                    const Hit hit = bumpy.hit({{2, y, z}, 0, {-1, dy, dz}, unlimited});
                    ASSERT_TRUE(hit.valid());
                    if (expected < 0) expected = hit.t;
                    EXPECT_EQ(hit.t, expected);
                    EXPECT_TRUE(bumpy.fan({{2, y, z}, 0, {-1, dy, dz}, unlimited}).valid());
                    EXPECT_TRUE(bumpy.march({{2, y, z}, 0, {-1, dy, dz}, unlimited}).valid());
                }
            }
        }
    }
}

TEST(HardCases, Case04_RayInCoordinatePlane) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(100)) {
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray = ray_through(u * 3.0, aside * 0.2);
            (axis == 0 ? ray.origin.x : axis == 1 ? ray.origin.y : ray.origin.z) = 0;
            (axis == 0 ? ray.direction.x : axis == 1 ? ray.direction.y : ray.direction.z) = 0;
            const auto events = ball.judge().events(to_double(ray));
            if (!crosses(events, ray)) continue;
            const auto hits = ball.all_hits(ray);
            ASSERT_EQ(hits.size(), 2U);
            EXPECT_TRUE(hits[0].front);
            EXPECT_FALSE(hits[1].front);
        }
    }
}

TEST(HardCases, Case05_RayAlongDiagonals) {
    const Subject ball(star(16, round_radius));
    for (const Vec3d& u : directions(100)) {
        Ray ray = ray_through(u * 3.0, aside * 0.2);
        ray.origin.y = ray.origin.x;
        ray.direction.y = ray.direction.x;
        const auto events = ball.judge().events(to_double(ray));
        if (!crosses(events, ray)) continue;
        EXPECT_EQ(ball.all_hits(ray).size(), 2U);
    }
    // In the planes a + b = k/8 of an octant, along the diagonals of its cells.
    int through = 0;
    for (int k = 1; k < 8; ++k) {
        const Vec3d a{k / 8.0, 0, 1 - k / 8.0};
        const Vec3d b{0, k / 8.0, 1 - k / 8.0};
        const auto hits = ball.all_hits(ray_through(a * 3.0, (a + b) * 0.25));
        EXPECT_EQ(hits.size(), 2U);
        through += hits.size() == 2U ? 1 : 0;
    }
    EXPECT_EQ(through, 7);
}

TEST(HardCases, Case06_RayThroughSample) {
    for (const std::uint32_t cells : {2U, 6U, 16U}) {
        const Subject bumpy(star(cells, bumpy_radius));
        const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
        for (std::uint32_t y = 0; y <= cells; ++y) {
            for (std::uint32_t x = 0; x <= cells; ++x) {
                const Vec3d u = normalize(sample_direction(grid, {x, y}));
                const Vec3d point = u * bumpy_radius(u);
                const Hit hit = bumpy.hit(ray_through(u * 2.0, point));
                ASSERT_TRUE(hit.valid()) << x << " " << y;
                EXPECT_NEAR(hit.t, 1, 1e-5);
            }
        }
    }
}

TEST(HardCases, Case07_CornersAndBordersOfTheOctahedron) {
    const Subject ball(star(64, round_radius));
    const double off = 1e-4;
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0},
                              Vec3d{0, 0, 1}, Vec3d{0, 0, -1}}) {
        const Hit corner = ball.hit(ray_through(axis * 2.0, {}));
        ASSERT_TRUE(corner.valid());
        for (const Vec3d& other : {Vec3d{1, 1, 1}, Vec3d{-1, 1, 1}, Vec3d{1, -1, 1}, Vec3d{1, 1, -1}}) {
            const Vec3d towards = normalize(axis + normalize(other) * off);
            const Hit beside = ball.hit(ray_through(towards * 2.0, {}));
            ASSERT_TRUE(beside.valid());
            EXPECT_NEAR(corner.t, beside.t, 1e-3);
            EXPECT_GT(dot(corner.normal, beside.normal), 0.99F);
        }
    }
    // Over the borders of the octants, z < 0 and the map's own border among them.
    for (const Vec3d& u : directions(300)) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3d near = u;
            (axis == 0 ? near.x : axis == 1 ? near.y : near.z) = off;
            Vec3d across = near;
            (axis == 0 ? across.x : axis == 1 ? across.y : across.z) = -off;
            const Hit one = ball.hit(ray_through(normalize(near) * 2.0, {}));
            const Hit two = ball.hit(ray_through(normalize(across) * 2.0, {}));
            ASSERT_TRUE(one.valid() && two.valid());
            EXPECT_NEAR(one.t, two.t, 1e-3);
            EXPECT_GT(dot(one.normal, two.normal), 0.99F);
        }
    }
}

TEST(HardCases, Case08_PolesAndSeamOfLatlong) {
    const OwnedPart owned =
        baked_part({.sample = "sphere", .level = 3, .cells = 64, .mapping = Mapping::latlong});
    const trace::TraceMap map(owned.part);
    Hit projective;
    EXPECT_FALSE(spa::trace::closest_hit(map, ray_through({2, 0, 0}, {}), 0, projective));
    for (const Vec3d& u : directions(500)) {
        // Around the poles, and on both sides of the seam at -Z.
        for (const Vec3d& near :
             {normalize(Vec3d{u.x * 0.01, 1, u.z * 0.01}), normalize(Vec3d{u.x * 0.01, -1, u.z * 0.01}),
              normalize(Vec3d{u.x * 0.01, u.y, -1})}) {
            const Ray ray = ray_through(near * 2.0, near * 0.5);
            for (const Hit& hit : {fan(map, ray), march(map, ray)}) {
                ASSERT_TRUE(hit.valid());
                EXPECT_NEAR(length(point_at(ray, hit)), 1, 0.02);
            }
        }
    }
    for (const Vec3d& pole : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, -1}}) {
        const Ray ray = ray_through(pole * 2.0, {});
        ASSERT_TRUE(fan(map, ray).valid());
        ASSERT_TRUE(march(map, ray).valid());
    }
}

TEST(HardCases, Case09_TangentToTheSphere) {
    const Subject whole(star(16, [](Vec3d) { return 1.0; }));
    for (const Vec3d& u : directions(100)) {
        const Vec3d along = normalize(cross(u, aside));
        for (int ulps = -4; ulps <= 4; ++ulps) {
            const Vec3d touch = u * (1 + ulps * 0x1p-23);
            const Ray ray = ray_through(touch - along * 2.0, touch);
            const Hit hit = whole.hit(ray);
            const Hit again = whole.hit(ray);
            EXPECT_EQ(hit.t, again.t);
            EXPECT_EQ(whole.fan(ray).t, whole.fan(ray).t);
            EXPECT_EQ(whole.march(ray).t, whole.march(ray).t);
        }
    }
}

TEST(HardCases, Case10_MissesTheSphereButHitsItsBox) {
    const Subject whole(star(16, [](Vec3d) { return 1.0; }));
    for (const double x : {-0.9, 0.9}) {
        for (const double y : {-0.9, 0.9}) {
            const Ray ray = ray_through({x, y, 3}, {x, y, 0});
            EXPECT_FALSE(whole.hit(ray).valid());
            EXPECT_FALSE(whole.fan(ray).valid());
            EXPECT_FALSE(whole.march(ray).valid());
        }
    }
}

TEST(HardCases, Case22_DirectionsWithoutSurface) {
    // Nothing where z > 0.3 |p|_1.
    const Subject bowl(make_part({.cells = 32}, [](Vec3d g) {
        if (g.z > 0.3) return std::vector<MadeInterval>{};
        return std::vector<MadeInterval>{{0.8, 0, normalize(g), {}}};
    }));
    for (const Vec3d& u : directions(300)) {
        // Over the opening, above all that is solid: no spike to the centre.
        const Vec3d over{u.x * 0.15, u.y * 0.15, 0.3};
        const Ray ray = ray_through(over + Vec3d{0.05, 0, 1}, over);
        Ray until = ray;
        until.t_max = 1;
        EXPECT_FALSE(bowl.hit(until).valid());
        EXPECT_FALSE(bowl.march(until).valid());
        EXPECT_FALSE(bowl.fan(until).valid());
        EXPECT_TRUE(bowl.hit(ray).valid()) << "the bottom";
    }
}

TEST(HardCases, Case23_SurfaceOnTheSphere) {
    for (const ElementFormat depth : {ElementFormat::u8, ElementFormat::u16, ElementFormat::f32}) {
        const Subject whole(star(
            16, [](Vec3d) { return 1.0; }, depth));
        const Grid grid{Mapping::octahedral, 17, 17};
        for (std::uint32_t k = 0; k < 17 * 17; ++k) {
            const Vec3d u = normalize(sample_direction(grid, {k % 17, k / 17}));
            const Hit hit = whole.hit(ray_through(u * 2.0, u));
            ASSERT_TRUE(hit.valid()) << "clipped";
            EXPECT_NEAR(hit.t, 1, 1e-5);
            EXPECT_TRUE(whole.march(ray_through(u * 2.0, u * 0.5)).valid());
        }
    }
}

TEST(HardCases, Case36_RaysThatAreNone) {
    const Subject bumpy(star(16, bumpy_radius));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, unlimited, -unlimited}) {
        for (int place = 0; place < 8; ++place) {
            Ray ray = ray_through({2, 0.1, 0.1}, {0, 0.1, 0.1});
            float* const members[8] = {&ray.origin.x,    &ray.origin.y,    &ray.origin.z, &ray.direction.x,
                                       &ray.direction.y, &ray.direction.z, &ray.t_min,    &ray.t_max};
            // t_min = -infinity and t_max = infinity are limits like others.
            if ((place == 6 && bad == -unlimited) || (place == 7 && bad == unlimited)) continue;
            *members[place] = bad;
            EXPECT_FALSE(bumpy.hit(ray).valid()) << place << " " << double(bad);
            EXPECT_FALSE(bumpy.fan(ray).valid());
            EXPECT_FALSE(bumpy.march(ray).valid());
        }
    }
    EXPECT_FALSE(bumpy.hit({{0.1F, 0, 0}, 0, {0, 0, 0}, unlimited}).valid());
    EXPECT_FALSE(bumpy.hit({{2, 0, 0}, 3, {-1, 0, 0}, 1}).valid()) << "t_min > t_max";
}

TEST(HardCases, Case38_SmallestGrid) {
    // Nine samples at distance |g|_2: the octahedron itself.
    const Subject octahedron(make_part({.cells = 2}, [](Vec3d g) {
        return std::vector<MadeInterval>{{length(g), 0, g, {}}};
    }));
    for (const Vec3d& u : directions(500)) {
        const Ray ray = ray_through(u * 2.0, aside * 0.1);
        const Hit hit = octahedron.hit(ray);
        ASSERT_TRUE(hit.valid());
        const Vec3d p = point_at(ray, hit);
        EXPECT_NEAR(std::abs(p.x) + std::abs(p.y) + std::abs(p.z), 1, 1e-6);
        EXPECT_EQ(hit.side, HitSide::outer);
        EXPECT_TRUE(octahedron.march(ray).valid());
        EXPECT_TRUE(octahedron.fan(ray).valid());
    }
}

} // namespace
