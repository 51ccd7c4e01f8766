// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/image_errors.h"
#include "../../libspa/plan/light_paths.h"
#include "../../samples/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace {

using namespace spa;
using namespace spa::plan;

PathOptions few_rays() {
    PathOptions options;
    options.width = 320;
    options.height = 180;
    options.samples = 16;
    options.most_rays = 16384;
    return options;
}

struct Paths {
    explicit Paths(const Scene& its_scene, const PathOptions& options = few_rays())
        : scene(its_scene), objects(find_objects(scene)), unit(scene, objects),
          paths(unit, objects, scene.cameras, options) {}

    [[nodiscard]] std::uint32_t object(std::string_view name) const {
        const auto found = std::find_if(objects.begin(), objects.end(), [&](const SceneObject& object) {
            return scene.nodes[object.node].name == name;
        });
        return std::uint32_t(found - objects.begin());
    }
    [[nodiscard]] Change replaced(std::uint32_t object, std::uint32_t cells) const {
        bake::Options options;
        options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
        const TrialMap map = make_trial_map(object_model(scene, objects[object]), options);
        const StandIn stand_in(unit, map, scene.nodes[objects[object].node].to_world);
        return paths.change(object, &stand_in);
    }

    Scene scene;
    std::vector<SceneObject> objects;
    UnitScene unit;
    LightPaths paths;
};

// All but the triangles of one node.
Scene without(const Scene& scene, std::uint32_t node) {
    Scene rest = scene;
    rest.model.triangles.clear();
    rest.model.triangle_materials.clear();
    rest.triangle_nodes.clear();
    for (std::size_t t = 0; t < scene.model.triangles.size(); ++t) {
        if (scene.triangle_nodes[t] == node) continue;
        rest.model.triangles.push_back(scene.model.triangles[t]);
        rest.model.triangle_materials.push_back(scene.model.triangle_materials[t]);
        rest.triangle_nodes.push_back(scene.triangle_nodes[t]);
    }
    return rest;
}

// The camera sees the floor alone, so that it starts its rays at the same points without the boot.
Scene floor_with_boot() {
    Scene scene = samples::make_scene("corner", 1);
    scene.cameras.front().to_world = {{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0.45, 0.3, 0.45}}; // looks down
    scene.cameras.front().vertical_fov = 0.7;
    return scene;
}

TEST(LightPaths, LeavingOutEqualsASceneWithout) {
    const Paths with(floor_with_boot());
    const std::uint32_t boot = with.object("boot");
    ASSERT_LT(boot, with.objects.size());
    ASSERT_EQ(with.paths.views()[boot].pixel_share, 0);
    const Paths rest(without(with.scene, with.objects[boot].node));
    const std::vector<Vec3f> a = rest.paths.indirect(), b = with.paths.indirect();
    ASSERT_EQ(a.size(), b.size());
    const auto count = std::uint32_t(a.size());
    const double expected = measure::image_errors({count, 1, a}, {count, 1, b}).rel_mse;
    EXPECT_GT(expected, 1e-4);
    EXPECT_NEAR(with.paths.change(boot, nullptr).image_error, expected, expected * 1e-3);
}

TEST(LightPaths, FinerMapsChangeLess) {
    const Paths corner(samples::make_scene("corner", 1));
    const std::uint32_t boot = corner.object("boot");
    const Change coarse = corner.replaced(boot, 8), fine = corner.replaced(boot, 64),
                 finest = corner.replaced(boot, 256), nothing = corner.paths.change(boot, nullptr);
    EXPECT_GT(coarse.image_error, 4 * fine.image_error);
    EXPECT_GT(fine.image_error, finest.image_error);
    EXPECT_LT(finest.image_error, 1e-3);
    EXPECT_GT(nothing.image_error, coarse.image_error);
    EXPECT_GT(coarse.distance.p95, 2 * finest.distance.p95);
    EXPECT_EQ(nothing.missed, nothing.rays);
    EXPECT_GT(finest.rays, 500U);
    EXPECT_LT(finest.missed + finest.extra, finest.rays / 20);
}

// A ball before a wall that faces it: the solid angle of a sphere, and the distance.
TEST(LightPaths, SolidAnglesAreThoseOfASphere) {
    Scene scene = samples::make_scene("wall", 0);
    scene.model = {};
    scene.triangle_nodes.clear();
    scene.model.materials.resize(1);
    scene.nodes = {{"wall", no_index, {}}, {"ball", no_index, {{}, {0, 0, 5}}}};
    scene.model.positions = {{-0.1F, -0.1F, 0}, {0.1F, -0.1F, 0}, {0.1F, 0.1F, 0}, {-0.1F, 0.1F, 0}};
    scene.model.normals.assign(4, {0, 0, 1});
    scene.model.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    scene.triangle_nodes = {0, 0};
    for (const Model ball = samples::make_sample("sphere", 3); const Vec3f p : ball.positions) {
        scene.model.positions.push_back(p + Vec3f{0, 0, 5});
        scene.model.normals.push_back(p);
    }
    for (const Model ball = samples::make_sample("sphere", 3); const Triangle& triangle : ball.triangles) {
        const auto [a, b, c] = triangle.vertex;
        scene.model.triangles.push_back({{a + 4, b + 4, c + 4}});
        scene.triangle_nodes.push_back(1);
    }
    scene.model.triangle_materials.assign(scene.model.triangles.size(), 0);
    Camera camera;
    camera.to_world.translation = {0, 0, 0.2};
    camera.vertical_fov = 0.3;
    scene.cameras = {camera};
    PathOptions options = few_rays();
    options.most_rays = 1U << 16U;
    const Paths paths(scene, options);
    ASSERT_EQ(paths.objects.size(), 2U);
    const ObjectViews ball = paths.paths.views()[1];
    const double solid_angle = 2 * std::numbers::pi * (1 - std::sqrt(1 - 1 / 25.0));
    EXPECT_NEAR(ball.solid_angle_mean, solid_angle, solid_angle * 0.05);
    EXPECT_NEAR(ball.ray_share, 1 / 25.0, 0.003); // of a cosine: its disc's share
    EXPECT_NEAR(ball.distance_median, 4.3, 0.2);
    EXPECT_EQ(ball.pixel_share, 0);
    EXPECT_NEAR(paths.paths.views()[0].pixel_share, 1, 1e-9);
    // From the camera, which is closer to it.
    EXPECT_NEAR(ball.solid_angle_max, 2 * std::numbers::pi * (1 - std::sqrt(1 - 1 / (4.8 * 4.8))), 2e-3);
}

} // namespace
