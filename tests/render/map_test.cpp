// SPDX-License-Identifier: Apache-2.0
#include "frame_error.h"
#include "render_test.h"
#include "scenes.h"

#include "../../libspa/bake/bake.h"
#include "../../samples/samples.h"
#include "../../shaders/spa_method.h"
#include "../support/shapes.h"

#include <cmath>

namespace spa::test {
namespace {

using render::Backend;
using render::Frame;
using render::Geometry;
using render::Settings;

class Maps : public RenderTest {
protected:
    void make(const char* sample, std::uint32_t cells, std::uint32_t layers) {
        make(samples::make_sample(sample, 3), cells, layers);
    }
    // An object in the room, turned, mirrored and scaled, under a light.
    void make(const Model& model, std::uint32_t cells, std::uint32_t layers) {
        add_room(scene);
        Affine to_world;
        to_world.linear = {{{0.6, 0, 0.5}, {0, 0.8, 0}, {0.5, 0, -0.6}}};
        to_world.translation = {0.1, -0.1, 0.2};
        object = add_node(scene, "object", to_world);
        add_model(scene, object, model);
        scene.lights.push_back(point_light({2, 3, 2.5}, {20, 20, 20}));
        bake::Options options;
        options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
        options.layers = layers;
        baked = bake::bake_model(model, options);
        settings.width = 128;
        settings.height = 96;
        settings.samples = 16;
        settings.camera = camera_at({1.2, 0.9, 3.4}, {0, -0.1, 0}, 0.7);
    }
    [[nodiscard]] std::unique_ptr<render::DeviceScene> load(bool keep_replaced = true,
                                                            bool holes = false) const {
        const render::MapPlacement placement{object, &baked.map.map, 0, holes};
        return std::make_unique<render::DeviceScene>(*gpu, scene, std::span(&placement, 1), keep_replaced);
    }
    Frame frame(const render::DeviceScene& loaded, Geometry primary, Geometry others) {
        settings.primary = primary;
        settings.shadow = settings.secondary = others;
        return render::render(*gpu, loaded, settings);
    }

    Scene scene;
    std::uint32_t object = 0;
    bake::Result baked;
    Settings settings;
};

TEST_F(Maps, LookLikeTheirTriangles) {
    make("sphere", 64, 1);
    const auto loaded = load();
    const Frame triangles = frame(*loaded, Geometry::triangles, Geometry::triangles);
    const Frame mixed = frame(*loaded, Geometry::triangles, Geometry::maps);
    const Frame maps = frame(*loaded, Geometry::maps, Geometry::maps);
    const std::size_t pixels = triangles.direct.size();

    // The same primary hits: what differs is the border of the shadow and what secondary rays see.
    EXPECT_TRUE(same_bits(triangles.albedo, mixed.albedo));
    EXPECT_LT(differing(triangles.direct, mixed.direct, 0.01F, 0.002F), pixels / 200);
    EXPECT_NEAR(mean(mixed.indirect), mean(triangles.indirect), 0.005 * mean(triangles.indirect));
    EXPECT_LT(root_mean_square(mixed.indirect, triangles.indirect), 0.06 * mean(triangles.indirect));

    std::size_t on_map = 0;
    std::size_t far = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (maps.kind[i] < 2) continue;
        ++on_map;
        far += triangles.kind[i] == 1 && std::abs(maps.depth[i] - triangles.depth[i]) < 0.01F ? 0 : 1;
    }
    EXPECT_GT(on_map, pixels / 20);
    EXPECT_LT(far, on_map / 20);
    EXPECT_LT(differing(triangles.normal, maps.normal, 0.02F, 0.02F), pixels / 100);
    EXPECT_LT(differing(triangles.albedo, maps.albedo, 0.05F, 0.05F), pixels / 100);
    EXPECT_LT(differing(triangles.direct, maps.direct, 0.05F, 0.02F), pixels / 50);
    EXPECT_NEAR(mean(maps.indirect), mean(triangles.indirect), 0.01 * mean(triangles.indirect));
}

// What the object's triangles lie inside of would be black, what they lie outside of would let light through.
TEST_F(Maps, DoNotShadowTheirOwnTriangles) {
    make("torus", 64, 2);
    const auto loaded = load();
    const Frame triangles = frame(*loaded, Geometry::triangles, Geometry::triangles);
    const Frame mixed = frame(*loaded, Geometry::triangles, Geometry::maps);
    EXPECT_LT(differing(triangles.direct, mixed.direct, 0.01F, 0.002F), triangles.direct.size() / 200);
    EXPECT_LT(root_mean_square(mixed.indirect, triangles.indirect), 0.06 * mean(triangles.indirect));
}

TEST_F(Maps, AndTrianglesAreTheSameByPipelineAndByQuery) {
    if (!has_queries) GTEST_SKIP() << "this device has no ray queries";
    make("torus", 64, 2);
    for (std::uint32_t i = 0; i < 2; ++i) { // with holes, so that any-hit shaders run
        Material& material = scene.model.materials[i];
        material.alpha_mode = AlphaMode::blend;
        material.base_color.w = i == 0 ? 0.6F : 0.4F;
    }
    const auto loaded = load();
    for (const Geometry primary : {Geometry::maps, Geometry::triangles}) {
        settings.backend = Backend::query;
        const Frame query = frame(*loaded, primary, Geometry::maps);
        settings.backend = Backend::pipeline;
        const Frame pipeline = frame(*loaded, primary, Geometry::maps);
        const std::size_t few = query.direct.size() / 2000;
        EXPECT_LE(differing(query.direct, pipeline.direct, 1e-5F), few);
        EXPECT_LE(differing(query.normal, pipeline.normal, 1e-5F, 1e-5F), few);
        EXPECT_LE(differing(query.albedo, pipeline.albedo, 1e-5F), few);
        EXPECT_LE(differing(query.indirect, pipeline.indirect, 1e-4F), query.direct.size() / 500);
        EXPECT_EQ(query.kind, pipeline.kind);
    }
}

// Moved on the device, all is as if it had been uploaded where it stands.
TEST_F(Maps, ArePosedAsIfTheyWereLoadedSo) {
    make("torus", 32, 1);
    settings.samples = 2;
    const Scene at_first = scene;
    const auto posed = load();
    // The room stays, so that the scene is of the same size: rays start as far from surfaces.
    for (std::size_t t = 0; t < scene.model.triangles.size(); ++t)
        for (const std::uint32_t v : scene.model.triangles[t].vertex)
            if (scene.triangle_nodes[t] == object)
                scene.model.positions[v] = at_first.model.positions[v] + Vec3f{0.05F, 0.1F, 0};
    Affine part = scene.nodes[object].to_world;
    part.translation = part.translation + Vec3d{0.2, 0.1, 0};
    scene.nodes[object].to_world = part;
    const auto loaded = load();
    EXPECT_NE(frame(*posed, Geometry::maps, Geometry::maps).depth,
              frame(*loaded, Geometry::maps, Geometry::maps).depth);
    // Once by the node and once by the part's own transform, which goes before.
    for (const bool by_part : {false, true}) {
        Scene target = scene;
        render::MapPlacement placement{object, &baked.map.map, 0};
        if (by_part) {
            target.nodes[object].to_world = at_first.nodes[object].to_world;
            placement.parts = {part};
        }
        posed->pose(*gpu, target, std::span(&placement, 1));
        for (const Geometry primary : {Geometry::maps, Geometry::triangles}) {
            const Frame a = frame(*posed, primary, Geometry::maps),
                        b = frame(*loaded, primary, Geometry::maps);
            EXPECT_EQ(a.depth, b.depth);
            EXPECT_EQ(a.direct, b.direct);
            EXPECT_EQ(a.indirect, b.indirect);
        }
    }
    const render::MapPlacement wrong{object, &baked.map.map, 0, false, false, {part, part}};
    EXPECT_THROW(posed->pose(*gpu, scene, std::span(&wrong, 1)), Error);
}

// Two placements share a map, one node is dropped between them: each moves by its own place.
TEST_F(Maps, ArePosedWhereTheyShareOne) {
    make("torus", 32, 1);
    settings.samples = 2;
    const std::uint32_t gone = add_node(scene, "gone", scene.nodes[object].to_world);
    const std::uint32_t twin = add_node(scene, "twin", scene.nodes[object].to_world);
    std::vector<render::MapPlacement> placements(3);
    placements[0].node = gone;
    placements[0].dropped = true;
    placements[1].node = object;
    placements[2].node = twin;
    placements[1].map = placements[2].map = &baked.map.map;
    render::DeviceScene posed(*gpu, scene, placements, true);
    scene.nodes[object].to_world.translation = Vec3d{-0.5, -0.2, 0.1};
    scene.nodes[twin].to_world.translation = Vec3d{0.5, 0.2, 0};
    const render::DeviceScene loaded(*gpu, scene, placements, true);
    EXPECT_EQ(posed.memory().maps, loaded.memory().maps);
    EXPECT_NE(frame(posed, Geometry::maps, Geometry::maps).depth,
              frame(loaded, Geometry::maps, Geometry::maps).depth);
    posed.pose(*gpu, scene, placements);
    const Frame a = frame(posed, Geometry::maps, Geometry::maps),
                b = frame(loaded, Geometry::maps, Geometry::maps);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.indirect, b.indirect);
}

// A ball with a transparent band, so that light falls through it and its inside is seen.
TEST_F(Maps, HaveHolesWhereTheyAreAskedFor) {
    Model ball = empty_model();
    add_sphere(ball, {}, 1, 48);
    for (const Vec3f& p : ball.positions)
        ball.colors.push_back({1, 0.8F, 0.6F, std::abs(p.y) < 0.35F ? 0.1F : 1.0F});
    ball.materials.front().alpha_mode = AlphaMode::blend;
    make(ball, 128, 1);
    const auto loaded = load(true, true);
    const Frame triangles = frame(*loaded, Geometry::triangles, Geometry::triangles);
    const Frame solid = frame(*load(), Geometry::maps, Geometry::maps);
    const std::size_t pixels = triangles.direct.size();
    EXPECT_GT(differing(triangles.direct, solid.direct, 0.05F, 0.02F), pixels / 20);
    for (const Backend backend : {Backend::query, Backend::pipeline}) {
        if (backend == Backend::query && !has_queries) continue;
        settings.backend = backend;
        const Frame maps = frame(*loaded, Geometry::maps, Geometry::maps);
        EXPECT_LT(differing(triangles.direct, maps.direct, 0.05F, 0.02F), pixels / 50);
        EXPECT_LT(differing(triangles.albedo, maps.albedo, 0.05F, 0.05F), pixels / 50);
        EXPECT_NEAR(mean(maps.indirect), mean(triangles.indirect), 0.02 * mean(triangles.indirect));
    }
}

TEST_F(Maps, AreTracedAsAskedFor) {
    make("torus", 64, 2);
    settings.samples = 1;
    const auto loaded = load(false);
    const Frame projective = frame(*loaded, Geometry::maps, Geometry::maps);
    settings.tracing.tracer = SPA_FAN;
    const Frame fan = frame(*loaded, Geometry::maps, Geometry::maps);
    EXPECT_GT(differing(projective.direct, fan.direct, 0.01F), projective.direct.size() / 100);
    EXPECT_THROW(frame(*loaded, Geometry::triangles, Geometry::maps), Error);
    EXPECT_EQ(loaded->memory().replaced_triangles, 0U);
    EXPECT_EQ(loaded->memory().replaced_structures, 0U);
    EXPECT_GT(loaded->memory().maps, 64U * 64U);
    EXPECT_GT(loaded->memory().map_structures, 0U);
}

} // namespace
} // namespace spa::test
