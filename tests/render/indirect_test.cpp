// SPDX-License-Identifier: Apache-2.0
#include "render_test.h"
#include "scenes.h"

#include <cmath>
#include <numbers>

namespace spa::test {
namespace {

using render::Frame;
using render::Settings;

class IndirectLight : public RenderTest {};

// What the floor sends out at a point because the ceiling, a square of half an edge 1.5 at height 2, is lit:
// by the trapezium rule.
double between_plates(Vec3d point, double albedo_of_floor, double albedo_of_ceiling, double intensity,
                      Vec3d light) {
    constexpr int cells = 300;
    constexpr double half = 1.5;
    constexpr double step = 2 * half / cells;
    double irradiance = 0;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const Vec3d q{-half + (i + 0.5) * step, 2, -half + (j + 0.5) * step};
            const Vec3d from_light = q - light;
            const double of_ceiling = intensity * from_light.y / std::pow(length(from_light), 3);
            const double radiance = albedo_of_ceiling / std::numbers::pi * of_ceiling;
            const double distance = length(q - point);
            irradiance += radiance * (2 / distance) * (2 / distance) / (distance * distance) * step * step;
        }
    }
    return albedo_of_floor / std::numbers::pi * irradiance;
}

TEST_F(IndirectLight, BetweenTwoPlates) {
    Scene scene;
    const std::uint32_t plates = add_node(scene, "plates");
    add_model(scene, plates, square({0, 0, 0}, {9, 0, 0}, {0, 0, -9}, {0.6F, 0.6F, 0.6F, 1}));
    add_model(scene, plates, square({0, 2, 0}, {1.5F, 0, 0}, {0, 0, 1.5F}, {0.5F, 0.5F, 0.5F, 1}));
    const Vec3d light{0.2, 0.8, 0.1};
    scene.lights.push_back(point_light(light, {5, 5, 5}));
    Settings settings;
    settings.width = 24;
    settings.height = 16;
    settings.samples = 1024;
    settings.camera = camera_at({0, 1, 2}, {0, 0, 0.3}, 0.5);
    render::FrameTimes times;
    const Frame frame = render_triangles(scene, settings, &times);
    double sum = 0;
    double expected_sum = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y) {
        for (std::uint32_t x = 0; x < settings.width; ++x) {
            const double up = std::tan(0.25);
            const Vec3d direction{up * 24 / 16 * ((x + 0.5) / 12 - 1), up * (1 - (y + 0.5) / 8), -1};
            const Vec3d way = normalize(transform_vector(settings.camera.to_world, direction));
            const Vec3d point = Vec3d{0, 1, 2} + way * (1 / -way.y);
            const double expected = between_plates(point, 0.6, 0.5, 5, light);
            const double found = frame.indirect[y * settings.width + x].x;
            EXPECT_NEAR(found, expected, 0.03 * expected);
            sum += found;
            expected_sum += expected;
        }
    }
    EXPECT_NEAR(sum, expected_sum, 0.001 * expected_sum);
    EXPECT_EQ(times.primary_rays, 24U * 16U);
    EXPECT_EQ(times.secondary_rays, 24U * 16U * 1024U); // a plane: no direction is below it
    EXPECT_GT(times.shadow_rays, 24U * 16U);
    EXPECT_LE(times.shadow_rays, times.primary_rays + times.secondary_rays);
}

} // namespace
} // namespace spa::test
