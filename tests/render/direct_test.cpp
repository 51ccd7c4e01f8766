// SPDX-License-Identifier: Apache-2.0
#include "cpu_render.h"
#include "frame_error.h"
#include "render_test.h"
#include "scenes.h"

#include "../support/shapes.h"

#include <cmath>
#include <numbers>

namespace spa::test {
namespace {

using render::Frame;
using render::Settings;

class DirectLight : public RenderTest {};

Model ball(Vec3f center, float radius, Vec4f color) {
    Model model = empty_model();
    add_sphere(model, center, radius, 16);
    model.materials.front().base_color = color;
    return model;
}

// Everything a triangle can be: smooth and flat, one colour and vertex colours, textures with all wrap modes,
// holes.
Scene mixed_scene() {
    Scene scene;
    add_room(scene);
    const std::uint32_t things = add_node(scene, "things");
    add_model(scene, things, ball({-0.6F, -0.4F, -0.6F}, 0.5F, {0.9F, 0.8F, 0.3F, 1}));
    Model colored = square({1.6F, 0.2F, -1.6F}, {0.5F, 0, 0.1F}, {0, 0.6F, 0}, {1, 1, 1, 1});
    colored.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}};
    add_model(scene, things, colored);

    const Wrap wraps[] = {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
    const AlphaMode modes[] = {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const float x = -1.2F + 1.1F * float(i);
        Model textured = square({x, 1.1F, -1.0F}, {0.5F, 0, 0}, {0, 0.4F, 0.15F}, {0.9F, 0.9F, 0.9F, 1});
        add_random_texture(textured, 5 + i, 7 + i);
        textured.uvs = {{-0.7F, 1.6F}, {1.9F, 1.6F}, {1.9F, -0.8F}, {-0.7F, -0.8F}};
        Material& material = textured.materials.front();
        material.wrap_u = wraps[i];
        material.wrap_v = wraps[(i + 1) % 3];
        material.nearest = i == 1;
        material.alpha_mode = modes[i];
        material.alpha_cutoff = 0.4F;
        std::uint32_t n = 0;
        for (auto& pixel : textured.textures.front().mips.front().pixels)
            pixel[3] = std::uint8_t(i == 0 ? 255 : (n += 83) & 255U);
        add_model(scene, things, textured);
    }
    scene.lights.push_back(point_light({1.5, 3, 3}, {20, 20, 20}));
    Light spot = point_light({-1, 3, 2}, {30, 20, 10});
    spot.kind = LightKind::spot;
    spot.direction = normalize(Vec3d{0.2, -1, -0.8});
    spot.inner_cone = 0.2;
    spot.outer_cone = 0.6;
    scene.lights.push_back(spot);
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = normalize(Vec3d{-0.3, -1, -0.6});
    sun.intensity = {0.5F, 0.6F, 0.8F};
    scene.lights.push_back(sun);
    return scene;
}

TEST_F(DirectLight, IsThatOfARendererOnTheCpu) {
    const Scene scene = mixed_scene();
    Settings settings;
    settings.width = 192;
    settings.height = 108;
    settings.samples = 0;
    settings.camera = camera_at({1.2, 0.9, 3.4}, {0, 0.3, 0}, 0.9);
    const Frame frame = render_triangles(scene, settings);
    const std::vector<CpuPixel> truth = render_on_cpu(scene, settings.camera, 192, 108);

    Frame cpu; // the same as pictures
    std::size_t depths = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        cpu.direct.push_back(to_float(truth[i].direct));
        cpu.normal.push_back(to_float(truth[i].normal));
        cpu.albedo.push_back(to_float(truth[i].albedo));
        const bool same_kind = frame.kind[i] == (truth[i].hit ? 1 : 0);
        const bool same_depth =
            truth[i].hit ? std::abs(double(frame.depth[i]) - truth[i].depth) < 1e-4 * truth[i].depth
                         : std::isinf(frame.depth[i]);
        depths += same_kind && same_depth ? 0 : 1;
        lit += truth[i].direct.x > 0 ? 1 : 0;
    }
    // What differs are pixels on an edge of a triangle, a texel's hole or a shadow.
    EXPECT_GT(lit, truth.size() / 3);
    EXPECT_LT(depths, truth.size() / 1000);
    EXPECT_LT(differing(frame.normal, cpu.normal, 1e-3F, 1e-3F), truth.size() / 1000);
    EXPECT_LT(differing(frame.albedo, cpu.albedo, 1e-3F, 1e-4F), truth.size() / 500);
    EXPECT_LT(differing(frame.direct, cpu.direct, 1e-3F, 1e-4F), truth.size() / 250);
}

TEST_F(DirectLight, OfAPointAboveAFloor) {
    Scene scene;
    const std::uint32_t floor = add_node(scene, "floor");
    add_model(scene, floor, square({0, 0, 0}, {9, 0, 0}, {0, 0, -9}, {0.5F, 0.25F, 1, 1}));
    scene.lights.push_back(point_light({0.5, 2, -0.3}, {8, 8, 4}));
    Settings settings;
    settings.width = 32;
    settings.height = 24;
    settings.samples = 4;
    settings.camera = camera_at({0, 3, 3}, {0, 0, 0}, 0.7);
    const Frame frame = render_triangles(scene, settings);
    for (std::uint32_t y = 0; y < settings.height; ++y) {
        for (std::uint32_t x = 0; x < settings.width; ++x) {
            const double up = std::tan(0.35);
            const Vec3d direction{up * 32 / 24 * ((x + 0.5) / 16 - 1), up * (1 - (y + 0.5) / 12), -1};
            const Vec3d way = normalize(transform_vector(settings.camera.to_world, direction));
            const Vec3d point = Vec3d{0, 3, 3} + way * (3 / -way.y);
            const Vec3d to_light = Vec3d{0.5, 2, -0.3} - point;
            const double irradiance = 8 * to_light.y / std::pow(length(to_light), 3);
            const std::size_t i = y * settings.width + x;
            EXPECT_NEAR(frame.direct[i].x, 0.5 / std::numbers::pi * irradiance, 2e-5);
            EXPECT_NEAR(frame.direct[i].y, 0.25 / std::numbers::pi * irradiance, 2e-5);
            EXPECT_NEAR(frame.direct[i].z, 0.5 / std::numbers::pi * irradiance, 2e-5);
            EXPECT_EQ(frame.indirect[i], Vec3f{}); // there is nothing to send light back
            EXPECT_NEAR(frame.depth[i], 3 / -way.y, 1e-4);
        }
    }
}

} // namespace
} // namespace spa::test
