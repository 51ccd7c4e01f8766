// SPDX-License-Identifier: Apache-2.0
// Rays through maps against rays through the models, where geometry says what must come out.
#include "../../libspa/core/error.h"
#include "../../libspa/measure/map_rays.h"
#include "../../libspa/measure/star_map.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

bake::Options options_of(std::uint32_t cells, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = layers;
    return options;
}

constexpr RayOptions few{.rays = 9'000, .star_cells = 256};

RayFigures rays_of(const Model& model, const bake::Options& bake, RayOptions options = few) {
    const bake::Result baked = bake::bake_model(model, bake);
    options.layers = bake.layers;
    return measure_rays(model, baked.map.map.parts.front(), options);
}

Model torus() {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.35F, 96);
    return model;
}

TEST(MapRays, ThroughASphereAreExact) {
    Model model = test::empty_model();
    test::add_sphere(model, {1, 2, 3}, 2, 96);
    const RayFigures figures = rays_of(model, options_of(128, 1));
    EXPECT_EQ(figures.errors.rays(), few.rays);
    EXPECT_NEAR(figures.band_width, 4.0 / 128, 1e-6);
    EXPECT_EQ(figures.errors.interior.missed, 0U);
    EXPECT_EQ(figures.errors.interior.extra, 0U);
    EXPECT_GT(figures.errors.interior.both, few.rays / 4);
    EXPECT_LT(figures.false_hits(), 1e-3);
    EXPECT_LT(figures.errors.interior_distance.median, 3e-4);
    EXPECT_LT(figures.errors.normal.mean, 0.2);
    EXPECT_EQ(figures.errors.color.count, figures.errors.distance.count);
    EXPECT_EQ(figures.errors.color.max, 0); // all of it is white
}

TEST(MapRays, GoThroughTheHoleOfATorusOfTwoLayers) {
    const RayFigures figures = rays_of(torus(), options_of(128, 2));
    EXPECT_LT(figures.false_hits(), 4e-3);
    EXPECT_LT(double(figures.errors.interior.extra), 1e-3 * double(figures.errors.rays()));
    EXPECT_LT(figures.missed_hits(), 4e-3);
}

TEST(MapRays, OfOneLayerHaveFalseHitsThatNoTexelsMend) {
    const RayFigures figures = rays_of(torus(), options_of(128, 1));
    EXPECT_GT(figures.false_hits(), 0.02);
    EXPECT_GT(figures.errors.interior.extra, 100U);
    EXPECT_GT(double(figures.star_extra), 0.95 * double(figures.extra()));
    // Where few texels are the reason, the star envelope is not.
    const RayFigures coarse = rays_of(torus(), options_of(8, 2));
    EXPECT_GT(coarse.extra() + coarse.missed(), 200U);
    EXPECT_LT(double(coarse.star_extra + coarse.star_missed), 0.1 * double(coarse.extra() + coarse.missed()));
}

TEST(MapRays, AWrongRadiusShows) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 1, 96);
    bake::Result baked = bake::bake_model(model, options_of(64, 1));
    Part& part = baked.map.map.parts.front();
    part.radius *= 1.1;
    const RayFigures larger = measure_rays(model, part, few);
    EXPECT_GT(larger.false_hits(), 0.01);
    EXPECT_LT(larger.star_extra, larger.extra() / 20); // of the model's own radius
    EXPECT_GT(larger.errors.interior_distance.median, 0.09);
    part.radius *= 0.9 / 1.1;
    const RayFigures smaller = measure_rays(model, part, few);
    EXPECT_GT(smaller.missed_hits(), 0.01);
    EXPECT_LT(smaller.star_missed, smaller.missed() / 20);
    EXPECT_EQ(smaller.false_hits(), 0);
}

// The same object stored in a frame that stretches: the same figures but for the texels.
TEST(MapRays, LiveInObjectSpace) {
    Model model = torus();
    for (Vec3f& p : model.positions) p.x *= 3;
    for (Vec3f& n : model.normals) n = normalize(Vec3f{n.x / 3, n.y, n.z});
    bake::Options options = options_of(128, 2);
    options.frame = bake::Frame::affine;
    const RayFigures affine = rays_of(model, options);
    EXPECT_LT(affine.false_hits(), 4e-3);
    EXPECT_LT(affine.missed_hits(), 4e-3);
    EXPECT_LT(affine.errors.interior_distance.median, 1e-3);
    EXPECT_LT(affine.errors.normal.median, 2);
}

TEST(MapRays, DoNotDependOnThreads) {
    RayOptions options = few;
    options.threads = 1;
    const RayFigures one = rays_of(torus(), options_of(32, 2), options);
    options.threads = 3;
    const RayFigures three = rays_of(torus(), options_of(32, 2), options);
    EXPECT_EQ(one.errors.distance.mean, three.errors.distance.mean);
    EXPECT_EQ(one.errors.normal.rms, three.errors.normal.rms);
    EXPECT_EQ(one.errors.color.mean, three.errors.color.mean);
    EXPECT_EQ(one.extra(), three.extra());
    EXPECT_EQ(one.errors.band.missed, three.errors.band.missed);
    EXPECT_EQ(one.star_extra, three.star_extra);
    EXPECT_EQ(one.star_missed, three.star_missed);
}

TEST(MapRays, NeedAnOctahedralMap) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::latlong, 64, 32};
    try {
        rays_of(torus(), options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
    }
}

TEST(MapRays, CanBeCancelled) {
    const bake::Result baked = bake::bake_model(torus(), options_of(16, 1));
    EXPECT_THROW(measure_rays(torus(), baked.map.map.parts.front(), few, [](double) { return false; }),
                 bake::Cancelled);
}

// The star envelope of a map is that map, with more texels.
TEST(StarMap, IsTheSameMapWithMoreTexels) {
    const Model model = torus();
    for (const std::uint32_t layers : {1U, 2U}) {
        bake::Options options = options_of(64, layers);
        options.depth = ElementFormat::f32;
        const bake::Result baked = bake::bake_model(model, options);
        const Part& part = baked.map.map.parts.front();
        const bake::OwnedMap star = star_map(model, part, part.radius, layers, 128, 0, {});
        const Part& fine = star.map.parts.front();
        ASSERT_EQ(fine.layers.size(), part.layers.size());
        EXPECT_EQ(fine.center_inside, part.center_inside);
        for (std::size_t k = 0; k < part.layers.size(); ++k) {
            const ImageView& few_depths = part.layers[k].outer.depth;
            const ImageView& many = fine.layers[k].outer.depth;
            for (std::uint32_t y = 0; y < few_depths.height; ++y) {
                for (std::uint32_t x = 0; x < few_depths.width; ++x) {
                    EXPECT_EQ(decode_depth(few_depths.format, few_depths.at(x, y)),
                              decode_depth(many.format, many.at(2 * x, 2 * y)));
                }
            }
        }
    }
}

} // namespace
} // namespace spa::measure
