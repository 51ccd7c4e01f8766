// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/bench_layers.h"

#include "../../libspa/bake/center.h"
#include "../../libspa/measure/ray_sets.h"
#include "../../libspa/measure/ray_truth.h"
#include "../../libspa/trace/triangle_scene.h"
#include "../../samples/samples.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(NearSilhouette, IsWhatLiesAlongTheSilhouetteOfABall) {
    const Model model = samples::make_sample("sphere", 5);
    const bake::CenteredModel ball = bake::center_model(model, make_part_frame(model, {}, false));
    const trace::TriangleScene scene(ball.positions, model.triangles);
    const RayTruth judge(ball, scene);
    const auto rays = make_rays(RaySet::primary, 40000, 1, {}, {});
    constexpr float width = 0.05F;
    const auto band = near_silhouette(judge, rays, judge.trace(rays), width);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double distance = length(cross(to_double(rays[i].origin), to_double(rays[i].direction)));
        if (std::abs(distance - 1) > width + 0.003) {
            EXPECT_EQ(band[i], 0) << distance;
        } else if (std::abs(distance - 1) < 0.7 * width - 0.003) {
            EXPECT_EQ(band[i], 1) << distance;
        }
    }
}

// A square plate across z, and beside it, from x = 1.04 to 1.06 of its plane, a strip.
Model plate_and_strip() {
    Model model;
    model.materials.emplace_back();
    const auto add = [&](float left, float right) {
        const auto first = std::uint32_t(model.positions.size());
        for (const Vec3f p :
             {Vec3f{left, -1, 0}, Vec3f{right, -1, 0}, Vec3f{right, 1, 0}, Vec3f{left, 1, 0}}) {
            model.positions.push_back(p);
            model.normals.push_back({0, 0, 1});
        }
        model.triangles.push_back({{first, first + 1, first + 2}});
        model.triangles.push_back({{first, first + 2, first + 3}});
        model.triangle_materials.insert(model.triangle_materials.end(), 2, 0);
    };
    add(-1, 1);
    add(1.04F, 1.06F);
    return model;
}

TEST(NearSilhouette, SeesWhatIsNarrowerThanItself) {
    const Model model = plate_and_strip();
    const bake::CenteredModel flat = bake::center_model(model, {{}, Mat3{}, 2});
    const trace::TriangleScene scene(flat.positions, model.triangles);
    const RayTruth judge(flat, scene);
    // In units of the sphere of radius 2, as the rays are. The strip is from 0.52 to 0.53.
    const auto in_band = [&](float x, float width) {
        const std::vector rays{trace::Ray{{x, 0.01F, 1}, 0, {0, 0, -1}, infinity}};
        return near_silhouette(judge, rays, judge.trace(rays), width)[0] != 0;
    };
    EXPECT_FALSE(in_band(0.2F, 0.1F));
    EXPECT_TRUE(in_band(0.45F, 0.1F)) << "the plate's edge, at half the width or all of it";
    EXPECT_TRUE(in_band(0.525F, 0.1F)) << "on the strip";
    // Only a parallel at half of the width meets the strip; one at all of it passes it again.
    EXPECT_TRUE(in_band(0.575F, 0.1F));
    EXPECT_FALSE(in_band(0.65F, 0.1F));
}

TEST(BenchLayers, OptionsAreThoseOfTheReconstruction) {
    const bake::Options one = reconstruction_options(Reconstruction::one_depth, 3, 32);
    EXPECT_TRUE(one.one_depth());
    EXPECT_EQ(one.grid, (Grid{Mapping::octahedral, 33, 33}));
    const bake::Options first = reconstruction_options(Reconstruction::tangents, 1, 32);
    EXPECT_FALSE(first.one_depth());
    EXPECT_EQ(first.layers, 1U);
    EXPECT_FALSE(first.folds);
    const bake::Options folds = reconstruction_options(Reconstruction::folds, 3, 32);
    EXPECT_EQ(folds.layers, 3U);
    EXPECT_TRUE(folds.folds);
}

TEST(BenchLayers, JudgesAtTheUsualSize) {
    EXPECT_EQ(usual_cells(std::vector<std::uint32_t>{64, 128, 256}), 128U);
    EXPECT_EQ(usual_cells(std::vector<std::uint32_t>{512, 64, 192}), 192U);
    EXPECT_EQ(usual_cells(std::vector<std::uint32_t>{32, 64}), 64U);
    EXPECT_EQ(usual_layers(std::vector<std::uint32_t>{3, 2, 1}), 2U);
    EXPECT_EQ(usual_layers(std::vector<std::uint32_t>{1, 4}), 4U);
}

// One depth fills the hole of a torus, and which rays pass that is known.
TEST(BenchLayers, CountsTheRaysThroughAFilledHole) {
    LayersOptions options;
    options.cells = {64};
    options.layers = {1, 2};
    options.rays = 20000;
    options.runs = 2;
    options.view_side = 16;
    unsigned files = 0;
    options.file_bytes = [&](const SphericalMap& map) {
        ++files;
        return map.parts.front().layers.size();
    };
    double last = 0;
    options.progress = [&](double share, const std::string&) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
        return true;
    };
    const Model torus = samples::make_sample("torus", 4);
    const LayersBenchmark benchmark = bench_layers(torus, options);
    EXPECT_TRUE(benchmark.closed());
    ASSERT_EQ(benchmark.rows.size(), 5U);
    EXPECT_EQ(files, 5U);
    const LayerRow* const one = benchmark.find(Reconstruction::one_depth, 1, 64);
    const LayerRow* const tangents = benchmark.find(Reconstruction::tangents, 2, 64);
    ASSERT_NE(one, nullptr);
    ASSERT_NE(tangents, nullptr);
    EXPECT_EQ(benchmark.find(Reconstruction::tangents, 3, 64), nullptr);

    // By geometry: rays through the disc in the ring's plane that closes its hole, clear of the ring.
    const auto rays = make_rays(RaySet::chords, options.rays, options.seed, {}, {});
    const double scale = 1.4; // R of the torus
    std::uint64_t through_disc = 0;
    for (const trace::Ray& ray : rays) {
        const Vec3d o = to_double(ray.origin) * scale, d = to_double(ray.direction);
        const double t = -o.y / d.y;
        const Vec3d p = o + d * t;
        if (std::hypot(p.x, p.z) > 0.6) continue;
        // Clear of the ring along the whole chord.
        bool clear = true;
        for (double s = 0; s < 2 * scale && clear; s += 0.002) {
            const Vec3d q = o + d * s;
            clear = std::hypot(std::hypot(q.x, q.z) - 1, q.y) > 0.4;
        }
        if (clear) ++through_disc;
    }
    const std::uint64_t extra = one->errors.band.extra + one->errors.interior.extra;
    EXPECT_GE(extra, through_disc - 5);
    // What else one depth fills is above and below the disc: not much more.
    EXPECT_LT(extra, 2 * through_disc);
    EXPECT_EQ(one->errors.interior.missed, 0U);
    EXPECT_EQ(tangents->errors.interior.extra, 0U);
    EXPECT_EQ(tangents->errors.interior.missed, 0U);
    EXPECT_EQ(tangents->errors.rays(), options.rays);
    EXPECT_NEAR(tangents->band_width, 4.0 / 64, 1e-12);

    EXPECT_FALSE(one->time_ratio.has_value());
    EXPECT_EQ(benchmark.find(Reconstruction::folds, 1, 64)->time_ratio, 1.0);
    EXPECT_GT(tangents->time_ratio.value(), 0);
    EXPECT_EQ(tangents->ns.runs, 2U);

    EXPECT_EQ(benchmark.view.cells, 64U);
    EXPECT_EQ(benchmark.view.layers, 2U);
    ASSERT_EQ(benchmark.view.rays.size(), 256U);
    EXPECT_EQ(benchmark.view.source.size(), 256U);
    EXPECT_EQ(benchmark.view.one_depth.size(), 256U);
    EXPECT_EQ(benchmark.view.folds.size(), 256U);
}

TEST(BenchLayers, CanBeCancelled) {
    LayersOptions options;
    options.cells = {16};
    options.rays = 10;
    options.progress = [](double, const std::string&) { return false; };
    EXPECT_THROW(bench_layers(samples::make_sample("cube", 0), options), bake::Cancelled);
}

} // namespace
} // namespace spa::measure
