// SPDX-License-Identifier: Apache-2.0
// The library's fan, march and shade on compiled maps: the text's answers, on the images that a part has.
#include "function_map.h"
#include "random.h"

#include "../../libspa/core/error.h"
#include "../../libspa/trace/fan.h"
#include "../../libspa/trace/march.h"
#include "../../libspa/trace/shade.h"
#include "../../shaders/spa_shade.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace spa::test {
namespace {

using namespace spa::trace; // NOLINT(google-build-using-namespace)

constexpr std::array<Grid, 2> grids{{{Mapping::latlong, 96, 64}, {Mapping::octahedral, 65, 65}}};

// Nothing in x > 0.7.
double bumps(Vec3d u) { return u.x > 0.7 ? 0 : 0.7 + 0.2 * std::sin(4 * u.x + u.y) * std::cos(3 * u.z); }

Ray random_ray(Random& random) {
    const Vec3d origin = random.direction() * 3.0;
    return {to_float(origin), 0, to_float(random.direction() * 0.8 - origin)};
}

TEST(TraceLibrary, FanAndMarchGiveTheTextsAnswers) {
    for (const Grid& grid : grids) {
        FunctionMap object(grid, bumps);
        const TraceMap map(object.part());
        Random random(40);
        shader::SpaFan fan = shader::spa_fan_defaults();
        fan.count = 50;
        const shader::SpaMarch steps = shader::spa_march_defaults();
        int fan_hits = 0;
        int march_hits = 0;
        for (int i = 0; i < 3000; ++i) {
            const Ray ray = random_ray(random);
            const shader::SpaRay text{{ray.origin.x, ray.origin.y, ray.origin.z},
                                      ray.t_min,
                                      {ray.direction.x, ray.direction.y, ray.direction.z},
                                      ray.t_max};
            const auto flags = std::uint32_t(i % 4);
            shader::SpaHit expected;
            Hit hit;
            hit.t = 1; // left over
            bool any = shader::spa_trace_fan(map.map(), text, fan, flags, expected);
            ASSERT_EQ(fan_hit(map, ray, fan, flags, hit), any);
            ASSERT_EQ(hit.valid(), any);
            if (any) {
                ++fan_hits;
                EXPECT_EQ(hit.t, expected.t);
                EXPECT_EQ(hit.map.x, expected.map.x);
                EXPECT_EQ(hit.front, expected.front != 0);
                EXPECT_NEAR(length(hit.normal), 1, 1e-6);
            }
            any = shader::spa_trace_march(map.map(), text, steps, flags, expected);
            ASSERT_EQ(march_hit(map, ray, steps, flags, hit), any);
            ASSERT_EQ(hit.valid(), any);
            if (!any) continue;
            ++march_hits;
            EXPECT_EQ(hit.t, expected.t);
            EXPECT_NEAR(length(hit.normal), 1, 1e-6);
            // On the surface, which no latlong or octahedral detail of the text decides: the function.
            const Vec3d p = to_double(ray.origin) + to_double(ray.direction) * double(hit.t);
            const double depth = bumps(normalize(p));
            if (hit.front && depth > 0 && normalize(p).x < 0.6) {
                EXPECT_NEAR(length(p), depth, 0.02) << i;
            }
        }
        EXPECT_GT(fan_hits, 800);
        EXPECT_GT(march_hits, 800);
    }
}

TEST(TraceLibrary, ShadesWithThePartsImages) {
    for (const Grid& grid : grids) {
        FunctionMap object(grid, bumps);
        object.set_colors([](Vec3d u) { return Vec3d{0.5 + 0.5 * u.x, 0.5 + 0.5 * u.y, 0.5 + 0.5 * u.z}; });
        object.set_normals([](Vec3d u) { return normalize(Vec3d{u.x, u.y, u.z - 0.3}); });
        const TraceMap map(object.part());
        Random random(41);
        int shaded = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d u = random.direction();
            if (u.x > 0.6) continue;
            Hit hit;
            if (!march_hit(map, {to_float(u * 2.0), 0, to_float(-u)}, {64, 4}, cull_back, hit)) continue;
            ++shaded;
            const Shade found = shade(map, hit);
            ASSERT_TRUE(found.has_color && found.has_normal);
            EXPECT_NEAR(linear_to_srgb(found.color.x), 255 * (0.5 + 0.5 * u.x), 3);
            EXPECT_NEAR(linear_to_srgb(found.color.y), 255 * (0.5 + 0.5 * u.y), 3);
            EXPECT_NEAR(linear_to_srgb(found.color.z), 255 * (0.5 + 0.5 * u.z), 3);
            EXPECT_NEAR(found.coverage, 1, 1e-6);
            const Vec3d normal = normalize(Vec3d{u.x, u.y, u.z - 0.3});
            EXPECT_LT(length(to_double(found.normal) - normal), 0.02);
        }
        EXPECT_GT(shaded, 1000);
        const TraceMap plain(object.part(), {.layers = 0, .images = false});
        Hit hit;
        ASSERT_TRUE(march_hit(plain, {{-2, 0, 0}, 0, {1, 0, 0}}, {64, 4}, 0, hit));
        EXPECT_FALSE(shade(plain, hit).has_color);
        EXPECT_LT(length(shade(plain, hit).normal - hit.normal), 1e-6F);
    }
}

// Beside a hole the stored normals of the hole's texels, all bits 0, would mean +Z.
TEST(TraceLibrary, NormalsBesideAHoleAreThoseOfTheSurface) {
    for (const ElementFormat format : {ElementFormat::oct8, ElementFormat::oct16, ElementFormat::rgb8}) {
        const Grid grid = grids[1];
        FunctionMap object(grid, bumps);
        std::vector<std::byte> normals(std::size_t(grid.width) * grid.height * element_size(format));
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x)
                if (bumps(normalize(sample_direction(grid, {x, y}))) > 0)
                    encode_normal(format, {1, 0, 0},
                                  normals.data() + (std::size_t(y) * grid.width + x) * element_size(format));
        object.part().layers[0].outer.normal = {normals, grid.width, grid.height, format};
        const TraceMap map(object.part());
        Random random(42);
        int stored = 0;
        for (int i = 0; i < 5000; ++i) {
            // Around x = 0.7, where the hole begins.
            const Vec3d u = normalize(Vec3d{1, 0, 0} + random.direction() * 0.9);
            Hit hit;
            hit.t = 1;
            hit.normal = {0, 1, 0};
            const shader::float2 place =
                shader::spa_place(std::uint32_t(grid.mapping), {float(u.x), float(u.y), float(u.z)});
            hit.map = {place.x, place.y};
            const Shade found = shade(map, hit);
            if (!found.has_normal) {
                EXPECT_EQ(found.normal.y, 1);
                continue;
            }
            ++stored;
            EXPECT_NEAR(found.normal.x, 1, 2e-2);
        }
        EXPECT_GT(stored, 1000);
        EXPECT_LT(stored, 5000);
    }
}

// A prism names its layers with ten bits each.
TEST(TraceLibrary, MapsOfTooManyLayersAreRefused) {
    const std::vector<std::byte> depths(9, std::byte{0});
    Layer layer;
    layer.outer.depth = layer.inner.depth = {depths, 3, 3, ElementFormat::u8};
    Part part;
    part.layers.assign(1025, layer);
    EXPECT_THROW(TraceMap(part, {0, false}), Error);
    EXPECT_NO_THROW(TraceMap(part, {1024, false}));
    part.layers.resize(1024);
    EXPECT_NO_THROW(TraceMap(part, {0, false}));
}

} // namespace
} // namespace spa::test
