// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/trace_bars.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spa::measure {
namespace {

// A method of chords with these figures: nanoseconds of the stream, bytes, mean |dt|, and rays out of 1000
// that miss in the band.
MethodReport method(const std::string& name, Family family, double ns, std::uint64_t bytes, double mean,
                    std::uint64_t missed = 0) {
    MethodReport report;
    report.name = name;
    report.family = family;
    report.bytes = bytes;
    SetErrors errors;
    errors.errors.interior.both = 1000 - missed;
    errors.errors.band.missed = missed;
    errors.errors.distance.mean = mean;
    report.errors.push_back(errors);
    for (const CallKind kind : {CallKind::single, CallKind::stream})
        report.timings.push_back(
            {RaySet::chords, 1, kind, "", spread_of({kind == CallKind::stream ? ns : 3 * ns})});
    return report;
}

MethodReport map(std::uint32_t cells, std::uint32_t layers, double ns, double mean) {
    MethodReport report = method("projective " + std::to_string(cells) + "x" + std::to_string(layers),
                                 Family::projective, ns, 1000, mean, 2);
    report.cells = cells;
    report.layers = layers;
    return report;
}

TraceBenchmark benchmark() {
    TraceBenchmark result;
    result.vertices = 1300000;
    result.methods = {method("fan 10", Family::fan, 300, 1000, 0.1, 30),
                      map(64, 1, 40, 4e-3),
                      map(128, 1, 50, 1e-3),
                      map(128, 2, 60, 1e-3),
                      method("mesh", Family::mesh, 1000, 1000000, 0),
                      method("lod 100", Family::lod, 100, 10000, 1e-2, 20),
                      method("lod 1000", Family::lod, 400, 40000, 1e-4, 5)};
    return result;
}

const Bar& find(const std::vector<Bar>& bars, const std::string& name) {
    const auto found =
        std::find_if(bars.begin(), bars.end(), [&](const Bar& bar) { return bar.name == name; });
    if (found == bars.end()) throw std::runtime_error("no bar " + name);
    return *found;
}

TEST(EqualLod, LiesBetweenTwoStepsInLogarithms) {
    const auto lod = equal_lod(benchmark(), 1e-3, 1);
    ASSERT_TRUE(lod.has_value());
    EXPECT_NEAR(lod->ns, 200, 1e-9);
    EXPECT_NEAR(lod->bytes, 20000, 1e-6);
    EXPECT_NEAR(lod->missed, 0.01, 1e-9);
    EXPECT_NEAR(equal_lod(benchmark(), 1e-2, 1)->ns, 100, 1e-9);
    EXPECT_NEAR(equal_lod(benchmark(), 2e-2, 1)->ns, 100, 1e-9) << "the coarsest is more exact already";
    EXPECT_NEAR(equal_lod(benchmark(), 5e-5, 1)->ns, 1000, 1e-9) << "the model itself";
    EXPECT_FALSE(equal_lod(benchmark(), 1e-3, 2).has_value()) << "not timed with two threads";
}

TEST(TraceBars, CompareWhatTheySay) {
    const auto bars = trace_bars("smooth:6", benchmark());
    EXPECT_NEAR(find(bars, "stream against the mesh").value, 20, 1e-9);
    EXPECT_TRUE(find(bars, "stream against the mesh").reached());
    EXPECT_NEAR(find(bars, "single ray against the mesh").value, 1000.0 / 150, 1e-9);
    const Bar& lod = find(bars, "stream against the equal LOD");
    EXPECT_NEAR(lod.value, 4, 1e-9);
    EXPECT_NEAR(lod.limit, 3, 1e-9);
    EXPECT_NEAR(lod.missed, 0.002, 1e-9);
    EXPECT_NEAR(lod.rival_missed.value(), 0.01, 1e-9);
    EXPECT_NEAR(find(bars, "bytes against the equal LOD").value, 20, 1e-6);
    EXPECT_FALSE(find(bars, "mean distance").reached());
    const Bar& exactness = find(bars, "exactness against the fan of 10");
    EXPECT_NEAR(exactness.value, 25, 1e-9) << "of the size that is worst";
    EXPECT_EQ(exactness.method, "projective 64x1");
    EXPECT_NEAR(find(bars, "missed in the interior").value, 0, 0);
}

TEST(TraceBars, DependOnTheShape) {
    const auto bars = trace_bars("boot:6", benchmark());
    EXPECT_NEAR(find(bars, "stream against the equal LOD").limit, 1.5, 1e-9);
    EXPECT_NEAR(find(bars, "cost of the second layer").value, 1.2, 1e-9);
    EXPECT_THROW(find(bars, "mean distance"), std::runtime_error);
    TraceBenchmark small = benchmark();
    small.vertices = 5000;
    EXPECT_THROW(find(trace_bars("boot:2", small), "stream against the mesh"), std::runtime_error);
    EXPECT_NO_THROW(find(trace_bars("boot:2", small), "cost of the second layer"));
    const auto others = trace_bars("chair.glb", benchmark());
    ASSERT_EQ(others.size(), 1U);
    EXPECT_EQ(others[0].name, "missed in the interior");
}

} // namespace
} // namespace spa::measure
