// SPDX-License-Identifier: Apache-2.0
#include "frame_error.h"
#include "render_test.h"
#include "scenes.h"

#include "../support/shapes.h"

#include <algorithm>

namespace spa::test {
namespace {

using render::Frame;
using render::Settings;

class Repeat : public RenderTest {
protected:
    void SetUp() override {
        RenderTest::SetUp();
        add_room(scene);
        Model ball = empty_model();
        add_sphere(ball, {0, -0.3F, 0}, 0.7F, 12);
        add_model(scene, add_node(scene, "ball"), ball);
        scene.lights.push_back(point_light({2, 3, 2.5}, {20, 20, 20}));
        settings.width = 61; // not a multiple of a workgroup
        settings.height = 45;
        settings.samples = 12;
        settings.camera = camera_at({1.2, 0.9, 3.4}, {0, -0.1, 0}, 0.7);
    }

    Scene scene;
    Settings settings;
};

TEST_F(Repeat, GivesTheSameBitsWhateverTheBatches) {
    const Frame first = render_triangles(scene, settings);
    settings.batch_seconds = 1e-9; // a few rays each
    render::FrameTimes times;
    const Frame second = render_triangles(scene, settings, &times);
    EXPECT_TRUE(same_bits(first.direct, second.direct));
    EXPECT_TRUE(same_bits(first.indirect, second.indirect));
    EXPECT_TRUE(same_bits(first.normal, second.normal));
    EXPECT_EQ(first.depth, second.depth);
    settings.seed = 2;
    const Frame other = render_triangles(scene, settings);
    EXPECT_TRUE(same_bits(first.direct, other.direct));
    EXPECT_GT(differing(first.indirect, other.indirect, 1e-3F), first.direct.size() / 2);
    EXPECT_NEAR(mean(first.indirect), mean(other.indirect), 0.03 * mean(first.indirect));
}

TEST_F(Repeat, SpreadsSeveralPrimaryRaysOverAPixel) {
    settings.samples = 1;
    const Frame one = render_triangles(scene, settings);
    settings.antialias = 16;
    render::FrameTimes times;
    const Frame many = render_triangles(scene, settings, &times);
    EXPECT_EQ(times.primary_rays, 16U * 61U * 45U);
    EXPECT_NEAR(mean(one.direct), mean(many.direct), 0.01 * mean(one.direct));
    EXPECT_NEAR(mean(one.indirect), mean(many.indirect), 0.03 * mean(one.indirect));
    // White ball before coloured walls: between them are colours that neither has.
    const auto mixed = std::count_if(many.albedo.begin(), many.albedo.end(),
                                     [](Vec3f c) { return c.x > 0.85F && c.y < 0.95F; });
    EXPECT_GT(mixed, 10);
}

TEST_F(Repeat, EndsWhenTold) {
    const render::DeviceScene loaded(*gpu, scene, {}, false);
    settings.batch_seconds = 1e-9;
    int calls = 0;
    double last = 0;
    const Frame none = render::render(*gpu, loaded, settings, nullptr, [&](double share) {
        EXPECT_GT(share, last);
        last = share;
        return ++calls < 3;
    });
    EXPECT_EQ(calls, 3);
    EXPECT_TRUE(none.direct.empty());
    settings.batch_seconds = 0.2;
    const Frame all = render::render(*gpu, loaded, settings, nullptr, [&](double share) {
        last = share;
        return true;
    });
    EXPECT_EQ(last, 1);
    EXPECT_EQ(all.direct.size(), 61U * 45U);
}

TEST_F(Repeat, NeedsNeitherTrianglesNorLights) {
    Scene nothing;
    nothing.model.materials.emplace_back();
    const Frame black = render_triangles(nothing, settings);
    EXPECT_EQ(mean(black.direct), 0);
    EXPECT_EQ(*std::max_element(black.kind.begin(), black.kind.end()), 0);
    scene.lights.clear();
    const Frame dark = render_triangles(scene, settings);
    EXPECT_EQ(mean(dark.direct) + mean(dark.indirect), 0);
    EXPECT_GT(mean(dark.albedo), 0.1);
}

} // namespace
} // namespace spa::test
