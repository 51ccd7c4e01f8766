// SPDX-License-Identifier: Apache-2.0
// The judge of the search against the measurement of a map, whose rays are others.
#include "../../libspa/bake/bake.h"
#include "../../libspa/measure/measure_map.h"
#include "../../libspa/plan/candidate.h"
#include "../../libspa/plan/ray_judge.h"
#include "../../libspa/plan/surface_judge.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spa::plan {
namespace {

Model torus() {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.35F, 64);
    return model;
}

bake::Result bake_torus(const Model& model, std::uint32_t cells, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = grid_of(Mapping::octahedral, cells);
    options.layers = layers;
    return bake::bake_model(model, options);
}

measure::Measurement measure_of(const Model& model, const Part& part) {
    measure::MeasureOptions options;
    options.surface_samples = 20'000;
    options.rays = 60'000;
    options.layers = 2;
    return measure::measure_map(model, part, options);
}

TEST(RayJudge, AgreesWithTheMeasurement) {
    const Model model = torus();
    const bake::Result baked = bake_torus(model, 32, 2);
    const Part& part = baked.map.map.parts.front();
    const measure::Measurement measured = measure_of(model, part);
    for (const Metric metric : metrics()) {
        SCOPED_TRACE(name(metric));
        const double expected = figure_of(metric, measured);
        Estimate estimate;
        if (is_of_rays(metric)) {
            const RayJudge judge(model, part.center, {.metric = metric});
            estimate = judge.judge(part, Judge::never_clear);
            EXPECT_EQ(estimate.samples, RayJudgeOptions{}.rays);
        } else {
            estimate = SurfaceJudge(model, {.metric = metric}).judge(part, Judge::never_clear);
        }
        EXPECT_GT(expected, 0);
        // Both are samples.
        const double slack = std::max((estimate.high - estimate.low) / 2, 0.1 * expected);
        EXPECT_GT(expected, estimate.low - slack);
        EXPECT_LT(expected, estimate.high + slack);
        EXPECT_LT(slack, 0.5 * expected);
    }
}

TEST(RayJudge, TakesFewRaysWhereItIsClear) {
    const Model model = torus();
    const bake::Result baked = bake_torus(model, 16, 2);
    const Part& part = baked.map.map.parts.front();
    const RayJudge judge(model, part.center, {.metric = Metric::p95_dt});
    const Estimate hopeless = judge.judge(part, 1e-5);
    EXPECT_GT(hopeless.low, 1e-5);
    const Estimate easy = judge.judge(part, 1);
    EXPECT_LE(easy.high, 1);
    const Estimate close = judge.judge(part, easy.value);
    EXPECT_EQ(hopeless.samples, easy.samples);
    EXPECT_LT(10 * hopeless.samples, close.samples);
}

TEST(RayJudge, CountsInTheUnitItIsGiven) {
    const Model model = torus();
    const bake::Result baked = bake_torus(model, 16, 2);
    const Part& part = baked.map.map.parts.front();
    const Estimate in_radii = RayJudge(model, part.center, {.metric = Metric::mean_dt}).judge(part, 0);
    const Estimate in_units =
        RayJudge(model, part.center, {.metric = Metric::mean_dt, .unit = part.radius / 4}).judge(part, 0);
    EXPECT_NEAR(in_units.value, 4 * in_radii.value, 1e-6);
}

TEST(SurfaceJudge, GivesUpAtTheFirstPointThatIsTooFar) {
    const Model model = torus();
    const bake::Result baked = bake_torus(model, 16, 1); // the hole is filled
    const SurfaceJudge judge(model, {.metric = Metric::hausdorff});
    const Estimate estimate = judge.judge(baked.map.map.parts.front(), 1e-3);
    EXPECT_GT(estimate.low, 1e-3);
    EXPECT_LT(estimate.samples, 10'000U);
    EXPECT_TRUE(std::isinf(estimate.high));
}

} // namespace
} // namespace spa::plan
