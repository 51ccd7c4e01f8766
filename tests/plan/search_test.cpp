// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/error.h"
#include "../../libspa/plan/search.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spa::plan {
namespace {

Model torus() {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.35F, 48);
    return model;
}

Model sphere() {
    Model model = test::empty_model();
    test::add_sphere(model, {1, 2, 3}, 2, 32);
    return model;
}

// Small maps from one place.
SearchRequest request_of(Metric metric, double target) {
    SearchRequest request;
    request.metric = metric;
    request.target = target;
    request.cells = {8, 16, 32, 64};
    request.color_cells = {16};
    request.frames = {bake::Frame::sphere};
    request.centers = {bake::Center::bounds};
    request.measure.surface_samples = 10'000;
    request.measure.rays = 30'000;
    return request;
}

double measured(const Model& model, const SearchRequest& request, const Candidate& candidate) {
    const bake::Options options = options_of(candidate, request.options);
    const bake::Result baked = bake::bake_model(model, options);
    measure::MeasureOptions measure;
    measure.surface_samples = 20'000;
    measure.rays = 30'000;
    measure.layers = options.layers;
    return figure_of(request.metric, measure::measure_map(model, baked.map.map.parts.front(), measure));
}

TEST(Search, TakesTheCheapestThatMeetsTheTarget) {
    const Model model = torus();
    const SearchRequest request = request_of(Metric::p95_dt, 0.02);
    const SearchResult result = search(model, request);
    ASSERT_TRUE(result.met);
    ASSERT_TRUE(result.chosen);
    EXPECT_EQ(result.stopped_by, Limit::none);
    EXPECT_LE(result.error, request.target);
    EXPECT_LE(measured(model, request, *result.chosen), 1.05 * request.target);

    const auto chosen = std::find_if(result.tried.begin(), result.tried.end(),
                                     [&](const Tried& tried) { return tried.candidate == *result.chosen; });
    ASSERT_NE(chosen, result.tried.end());
    // The next cheaper one does not.
    const Tried* cheaper = nullptr;
    for (const Tried& tried : result.tried) {
        if (tried.bytes >= chosen->bytes) continue;
        EXPECT_FALSE(tried.met);
        if (cheaper == nullptr || tried.bytes > cheaper->bytes) cheaper = &tried;
    }
    ASSERT_NE(cheaper, nullptr);
    EXPECT_GT(measured(model, request, cheaper->candidate), 0.95 * request.target);
}

TEST(Search, WritesWhatTheSameOptionsGive) {
    const Model model = torus();
    const SearchRequest request = request_of(Metric::false_hits, 0.02);
    const SearchResult result = search(model, request);
    ASSERT_TRUE(result.met);
    const bake::Result baked = bake::bake_model(model, options_of(*result.chosen, request.options));
    const Part& a = result.baked.map.map.parts.front();
    const Part& b = baked.map.map.parts.front();
    ASSERT_EQ(a.layers.size(), b.layers.size());
    EXPECT_TRUE(std::ranges::equal(a.layers[0].outer.color.bytes, b.layers[0].outer.color.bytes));
    EXPECT_TRUE(std::ranges::equal(a.layers[0].outer.depth.bytes, b.layers[0].outer.depth.bytes));
    EXPECT_TRUE(std::ranges::equal(a.folds, b.folds));
}

TEST(Search, IsTheSameForAnyNumberOfThreads) {
    const Model model = torus();
    SearchRequest request = request_of(Metric::mean_dt, 0.01);
    request.frames = {bake::Frame::sphere, bake::Frame::affine};
    request.options.threads = 1;
    const SearchResult one = search(model, request);
    request.options.threads = 3;
    const SearchResult three = search(model, request);
    ASSERT_EQ(one.tried.size(), three.tried.size());
    for (std::size_t i = 0; i < one.tried.size(); ++i) {
        EXPECT_EQ(one.tried[i].candidate, three.tried[i].candidate);
        EXPECT_EQ(one.tried[i].bytes, three.tried[i].bytes);
        EXPECT_EQ(one.tried[i].error.value, three.tried[i].error.value);
    }
    EXPECT_EQ(one.chosen, three.chosen);
    EXPECT_EQ(one.error, three.error);
    EXPECT_EQ(one.bytes, three.bytes);
}

TEST(Search, DoesNotPayForLayersThatBringNothing) {
    const SearchResult result = search(sphere(), request_of(Metric::p95_dt, 0.02));
    ASSERT_TRUE(result.met);
    EXPECT_EQ(result.chosen->layers, 1U);
    EXPECT_EQ(result.chosen->depth, ElementFormat::u8); // its steps are finer than the target
    EXPECT_LT(result.chosen->cells, 64U);               // and nothing larger is looked at
    for (const Tried& tried : result.tried) EXPECT_LT(tried.candidate.cells, 64U);
}

TEST(Search, TakesTheFrameThatSuitsTheShape) {
    Model model = sphere();
    for (Vec3f& p : model.positions) p.x *= 8;
    SearchRequest request = request_of(Metric::p95_surface, 0.01);
    request.frames = {bake::Frame::sphere, bake::Frame::affine};
    const SearchResult result = search(model, request);
    ASSERT_TRUE(result.met);
    EXPECT_EQ(result.chosen->frame, bake::Frame::affine);
}

TEST(Search, KeepsWhatIsGiven) {
    SearchRequest request = request_of(Metric::p95_dt, 0.05);
    request.cells = {48};
    request.layers = {3};
    request.depths = {ElementFormat::f32};
    const SearchResult result = search(torus(), request);
    ASSERT_TRUE(result.met);
    EXPECT_EQ(result.tried.size(), 1U);
    EXPECT_EQ(result.chosen->cells, 48U);
    EXPECT_EQ(result.chosen->layers, 3U);
    EXPECT_EQ(result.chosen->depth, ElementFormat::f32);
}

TEST(Search, SaysWhatStoppedIt) {
    // One depth fills the hole, however many samples there are.
    SearchRequest request = request_of(Metric::false_hits, 0.002);
    request.layers = {1};
    const SearchResult star = search(torus(), request);
    EXPECT_FALSE(star.met);
    EXPECT_FALSE(star.chosen);
    EXPECT_EQ(star.stopped_by, Limit::shape);

    request = request_of(Metric::p95_dt, 0.001);
    request.cells = {8, 16};
    EXPECT_EQ(search(torus(), request).stopped_by, Limit::cells);

    request = request_of(Metric::p95_dt, 0.005);
    request.max_bytes = 6'000;
    const SearchResult bytes = search(torus(), request);
    EXPECT_EQ(bytes.stopped_by, Limit::max_bytes);
    for (const Tried& tried : bytes.tried) EXPECT_EQ(tried.bytes > 6'000, tried.error.samples == 0);
}

TEST(Search, BestIsTheNearestToTheTarget) {
    SearchRequest request = request_of(Metric::p95_dt, 0.001);
    request.cells = {8, 16};
    request.best = true;
    const SearchResult result = search(torus(), request);
    EXPECT_FALSE(result.met);
    ASSERT_TRUE(result.chosen);
    EXPECT_EQ(result.chosen->cells, 16U);
    EXPECT_EQ(result.stopped_by, Limit::cells);
    EXPECT_GT(result.error, request.target);
    EXPECT_FALSE(result.baked.map.map.parts.empty());
    for (const Tried& tried : result.tried) EXPECT_GE(tried.error.value, 0.9 * result.error);
}

TEST(Search, ColorsTakeNoMoreThanHalfOfTheBytes) {
    Model model = torus();
    test::add_random_texture(model, 32, 3);
    for (std::size_t i = 0; i < model.uvs.size(); ++i)
        model.uvs[i] = {model.positions[i].x * 0.3F + 0.5F, model.positions[i].z * 0.3F + 0.5F};
    SearchRequest request = request_of(Metric::p95_dt, 0.1);
    request.color_cells = {16, 32, 64, 128, 256};
    const SearchResult free = search(model, request);
    ASSERT_TRUE(free.met);
    EXPECT_GE(free.chosen->color_cells, 64U);
    request.max_bytes = 20'000;
    const SearchResult limited = search(model, request);
    ASSERT_TRUE(limited.met);
    EXPECT_LE(limited.bytes, 20'000U);
    EXPECT_GT(free.bytes, 20'000U);
    EXPECT_LT(limited.chosen->color_cells, free.chosen->color_cells);
}

TEST(Search, RefusesWhatCannotBeMeasured) {
    SearchRequest request = request_of(Metric::p95_dt, 0.1);
    request.options.grid.mapping = Mapping::latlong;
    EXPECT_THROW(static_cast<void>(search(torus(), request)), Error);
    EXPECT_THROW(static_cast<void>(search(test::empty_model(), request_of(Metric::p95_dt, 0.1))), Error);
    request.metric = Metric::p95_surface;
    EXPECT_TRUE(search(torus(), request).met);
}

TEST(Search, ObeysItsProgress) {
    EXPECT_THROW(static_cast<void>(search(torus(), request_of(Metric::p95_dt, 0.001),
                                          [calls = 0](double) mutable { return ++calls < 3; })),
                 bake::Cancelled);
}

TEST(Search, AFootprintAllowsATenthOfItsRadius) { EXPECT_NEAR(footprint_tolerance(45), 0.1, 1e-12); }

} // namespace
} // namespace spa::plan
