// SPDX-License-Identifier: Apache-2.0
// Instances: transforms, closest hits, occlusion, many rays at once.
#include "function_map.h"
#include "random.h"

#include "../../libspa/core/error.h"
#include "../../libspa/trace/scene.h"
#include "../../libspa/trace/trace.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace spa::test {
namespace {

using namespace spa::trace; // NOLINT(google-build-using-namespace)

constexpr Grid grid{Mapping::octahedral, 65, 65};

Mat3 rotation(Random& random) {
    const Vec3d z = random.direction();
    const Vec3d x = normalize(cross(z, random.direction()));
    return {{x, cross(z, x), z}};
}

// Turned, stretched differently along three axes, sometimes mirrored.
Affine random_transform(Random& random) {
    Affine result;
    const auto stretch = [&] { return std::exp2(1.5 * random()) * (random.bits() % 4 == 0 ? -1 : 1); };
    const Mat3 diagonal{{{stretch(), 0, 0}, {0, stretch(), 0}, {0, 0, stretch()}}};
    const Mat3 turn = rotation(random);
    result.linear = turn * diagonal * rotation(random);
    result.translation = random.vector() * 4.0;
    return result;
}

double bumps(Vec3d u) { return 0.7 + 0.2 * std::sin(4 * u.x + u.y) * std::cos(3 * u.z); }

struct World {
    FunctionMap ball{grid, [](Vec3d) { return 0.8; }};
    FunctionMap bumpy{grid, bumps};
    std::vector<std::unique_ptr<TraceMap>> maps;
    std::vector<const Part*> parts;
    Scene scene;

    explicit World(std::uint32_t instances) {
        Random random(20);
        ball.part().center = {0.3, -0.2, 0.1};
        ball.part().radius = 1.7;
        bumpy.part().frame = random_transform(random).linear;
        bumpy.part().radius = 0.4;
        for (FunctionMap* map : {&ball, &bumpy}) {
            map->set_normals([](Vec3d u) { return u; });
            map->set_colors([](Vec3d u) { return Vec3d{0.5 + 0.5 * u.x, 0.5 + 0.5 * u.y, 0.5 + 0.5 * u.z}; });
            maps.push_back(std::make_unique<TraceMap>(map->part()));
            parts.push_back(&map->part());
        }
        for (std::uint32_t i = 0; i < instances; ++i)
            scene.add(*maps[i % 2], *parts[i % 2], random_transform(random));
    }
};

Ray random_ray(Random& random) {
    const Vec3d origin = random.vector() * 7.0;
    const Vec3d direction = (random.vector() * 5.0 - origin) * std::exp2(3 * random());
    Ray ray{to_float(origin), 0, to_float(direction), std::numeric_limits<float>::infinity()};
    if (random.bits() % 4 == 0) ray.t_min = float(random.uniform() * 0.5 / length(direction));
    if (random.bits() % 4 == 0) ray.t_max = float(random.uniform() * 10 / length(direction));
    return ray;
}

bool same(const Hit& a, const Hit& b) {
    if (!a.valid() && !b.valid()) return true;
    return a.t == b.t && a.normal == b.normal && a.map == b.map && a.layer == b.layer && a.side == b.side &&
           a.front == b.front && a.instance == b.instance;
}

TEST(MapSpace, LeadsThereAndBack) {
    Random random(21);
    for (int i = 0; i < 1000; ++i) {
        Part part;
        part.center = random.vector() * 10.0;
        part.radius = std::exp2(10 * random());
        part.frame = random_transform(random).linear;
        const Affine placed = random_transform(random);
        const MapSpace space = map_space(part, placed);
        const Vec3d q = random.vector();
        // The definition, step by step.
        const Vec3d object = part.center + part.frame * (q * part.radius);
        const Vec3d world = placed.linear * object + placed.translation;
        EXPECT_LT(length(to_world(space, q) - world), 1e-10 * (1 + length(world)));
        EXPECT_LT(length(space.to_map * (world - space.origin) - q), 1e-9);
    }
}

// A sphere under any transform is an ellipsoid, of which everything is known.
TEST(Scene, InstancesOfASphereAreEllipsoids) {
    Random random(22);
    FunctionMap ball(grid, [](Vec3d) { return 0.8; });
    ball.part().center = {1, 2, 3};
    ball.part().radius = 2;
    const TraceMap map(ball.part());
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        Scene scene;
        const Affine placed = random_transform(random);
        ASSERT_EQ(scene.add(map, ball.part(), placed), 0U);
        const MapSpace& space = scene.space(0);
        for (int k = 0; k < 40; ++k) {
            const Vec3d origin = space.origin + random.direction() * (scene.radius(0) * 1.5);
            const Vec3d direction =
                (to_world(space, random.direction() * 0.6) - origin) * std::exp2(5 * random());
            Hit hit;
            const std::uint32_t flags = k % 2 == 0 ? no_flags : cull_front;
            ASSERT_TRUE(scene.closest_hit({to_float(origin), 0, to_float(direction)}, flags, hit));
            ++hits;
            EXPECT_EQ(hit.instance, 0U);
            EXPECT_EQ(hit.front, flags == no_flags);
            const Vec3d q = space.to_map * (origin + direction * double(hit.t) - space.origin);
            EXPECT_NEAR(length(q), 0.8, 2e-3); // the stored surface is made of flat triangles
            // The gradient of |to_map (p - origin)|.
            const Vec3d gradient = normalize(transpose(space.to_map) * normalize(q));
            EXPECT_NEAR(length(to_double(hit.normal)), 1, 1e-6);
            EXPECT_GT(dot(to_double(hit.normal), gradient), 0.97);
            EXPECT_EQ(dot(to_double(hit.normal), direction) < 0, hit.front);
        }
    }
    EXPECT_EQ(hits, 300 * 40);
}

TEST(Scene, TheClosestHitIsThatOfAllInstances) {
    const World world(12);
    Random random(23);
    int several = 0;
    for (int i = 0; i < 20000; ++i) {
        const Ray ray = random_ray(random);
        const std::uint32_t flags = random.bits() % 4;
        Hit expected;
        int hit_by = 0;
        for (std::uint32_t k = 0; k < world.scene.size(); ++k) {
            // Without the culling by spheres.
            const MapSpace& space = world.scene.space(k);
            Hit found;
            const bool any = trace::closest_hit(world.scene.map(k), to_map(space, ray), flags, found);
            Hit of_instance;
            ASSERT_EQ(world.scene.instance_hit(k, ray, flags, of_instance), any);
            if (!any) continue;
            ++hit_by;
            found = to_world(space, found);
            found.instance = k;
            EXPECT_TRUE(same(found, of_instance));
            if (found.t < expected.t) expected = found;
        }
        several += hit_by > 1 ? 1 : 0;
        Hit hit;
        ASSERT_EQ(world.scene.closest_hit(ray, flags, hit), hit_by > 0);
        EXPECT_EQ(world.scene.occluded(ray, flags), hit_by > 0);
        if (hit_by == 0) continue;
        EXPECT_TRUE(same(hit, expected)) << i;
    }
    EXPECT_GT(several, 500);
}

TEST(Scene, ManyRaysHaveTheAnswersOfSingleOnes) {
    const World world(9);
    Random random(24);
    for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(2048), std::size_t(7001)}) {
        for (const std::uint32_t flags : {std::uint32_t(no_flags), std::uint32_t(cull_back)}) {
            std::vector<Ray> rays(count);
            for (Ray& ray : rays) ray = random_ray(random);
            std::vector<Hit> hits(count);
            std::vector<std::uint8_t> blocked(count, 7);
            world.scene.closest_hits(rays, flags, hits);
            world.scene.occluded(rays, flags, blocked);
            std::size_t found = 0;
            for (std::size_t i = 0; i < count; ++i) {
                Hit hit;
                found += world.scene.closest_hit(rays[i], flags, hit) ? 1 : 0;
                ASSERT_TRUE(same(hit, hits[i])) << i;
                ASSERT_EQ(blocked[i], hit.valid() ? 1 : 0) << i;
            }
            if (count > 100) {
                EXPECT_GT(found, count / 8);
            }
        }
    }
}

TEST(Scene, OfEqualInstancesTheFirstIsHit) {
    FunctionMap ball(grid, bumps);
    const TraceMap map(ball.part());
    Scene scene;
    for (int i = 0; i < 3; ++i) scene.add(map, ball.part());
    Random random(25);
    std::vector<Ray> rays(3000);
    for (Ray& ray : rays) {
        const Vec3d origin = random.direction() * 3.0;
        ray = {to_float(origin), 0, to_float(random.direction() * 0.4 - origin)};
    }
    std::vector<Hit> hits(rays.size());
    scene.closest_hits(rays, no_flags, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit hit;
        ASSERT_TRUE(scene.closest_hit(rays[i], no_flags, hit));
        EXPECT_EQ(hit.instance, 0U);
        EXPECT_EQ(hits[i].instance, 0U);
    }
}

TEST(Scene, ShadesInTheWorld) {
    const World world(8);
    Random random(26);
    int shaded = 0;
    for (int i = 0; i < 5000; ++i) {
        const Ray ray = random_ray(random);
        Hit hit;
        if (!world.scene.closest_hit(ray, cull_back, hit)) continue;
        ++shaded;
        const Shade shade = world.scene.shade(hit);
        ASSERT_TRUE(shade.has_color && shade.has_normal);
        const MapSpace& space = world.scene.space(hit.instance);
        const Vec3d p = to_double(ray.origin) + to_double(ray.direction) * double(hit.t);
        const Vec3d u = normalize(space.to_map * (p - space.origin));
        const Vec3d normal = normalize(transpose(space.to_map) * u); // as stored: the direction
        EXPECT_LT(length(to_double(shade.normal) - normal), 2e-2);
        EXPECT_NEAR(linear_to_srgb(shade.color.x), 255 * (0.5 + 0.5 * u.x), 3);
        EXPECT_NEAR(linear_to_srgb(shade.color.y), 255 * (0.5 + 0.5 * u.y), 3);
        EXPECT_NEAR(linear_to_srgb(shade.color.z), 255 * (0.5 + 0.5 * u.z), 3);
    }
    EXPECT_GT(shaded, 500);
}

TEST(Scene, RefusesWhatItCannotPlace) {
    FunctionMap ball(grid, bumps);
    const TraceMap map(ball.part());
    Scene scene;
    Affine flat;
    flat.linear.row[1] = {};
    Affine nan;
    nan.translation.x = std::numeric_limits<double>::quiet_NaN();
    for (const Affine& placed : {flat, nan}) {
        try {
            scene.add(map, ball.part(), placed);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
        }
    }
    FunctionMap latlong({Mapping::latlong, 8, 4}, bumps);
    const TraceMap other(latlong.part());
    try {
        scene.add(other, latlong.part());
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
    }
    EXPECT_EQ(scene.size(), 0U);
    Hit hit;
    EXPECT_FALSE(scene.closest_hit({{0, 0, 3}, 0, {0, 0, -1}}, no_flags, hit));
}

TEST(Scene, WhatIsNoRayMisses) {
    const World world(4);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::array<Ray, 6> rays{{{{nan, 0, 0}, 0, {0, 0, 1}},
                                   {{0, 0, 0}, 0, {0, nan, 1}},
                                   {{0, 0, 0}, 0, {0, 0, 0}},
                                   {{0, infinity, 0}, 0, {0, 0, 1}},
                                   {{0, 0, 0}, nan, {0, 0, 1}},
                                   {{0, 0, 0}, 0, {0, 0, 1}, nan}}};
    std::array<Hit, 6> hits;
    world.scene.closest_hits(rays, no_flags, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit hit;
        EXPECT_FALSE(world.scene.closest_hit(rays[i], no_flags, hit)) << i;
        EXPECT_FALSE(hits[i].valid()) << i;
        EXPECT_FALSE(world.scene.occluded(rays[i], no_flags)) << i;
    }
}

// Moved there, a scene is to the bit what it is put there.
TEST(Scene, MovedIsAsPlaced) {
    Random random(31);
    FunctionMap bumpy{grid, bumps};
    bumpy.part().frame = random_transform(random).linear;
    bumpy.part().center = {0.2, 0.1, -0.3};
    const TraceMap map(bumpy.part());
    Scene placed, moved;
    for (int i = 0; i < 5; ++i) {
        const Affine place = random_transform(random);
        (void)placed.add(map, bumpy.part(), place);
        moved.move(moved.add(map, bumpy.part(), random_transform(random)), place);
    }
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{to_float(random.vector() * 6.0), 0, to_float(random.direction()), 100};
        Hit a, b;
        ASSERT_EQ(placed.closest_hit(ray, 0, a), moved.closest_hit(ray, 0, b)) << i;
        if (!a.valid()) continue;
        ++hits;
        EXPECT_EQ(a.t, b.t);
        EXPECT_EQ(a.instance, b.instance);
        EXPECT_EQ(a.normal, b.normal);
    }
    EXPECT_GT(hits, 50);
    EXPECT_THROW(moved.move(0, {{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {}}), Error);
    EXPECT_EQ(moved.space(0).origin, placed.space(0).origin) << "it stays where it was";
}

} // namespace
} // namespace spa::test
